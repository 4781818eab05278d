//! The distances (`spec/3-stages.md#distances`), F-04, F-05, and the distance of RSS.

use crate::claim::{Theorem, Wrong};
use crate::numbers::real::Real;
use crate::numbers::real::formula::{Formula, at_most, equal, given, iff, implies, less, not};
use crate::stages::distances::{s_b, s_cav, s_follow, s_valid};

const DOMAIN: &str = "all speeds >= 0, a_b > 0, safety_time >= 0";
/// The theorems of this file.
pub const THEOREMS: &[Theorem] = &[
    Theorem {
        id: "s_b_grows_with_v",
        statement: "v <= w implies s_b(v) <= s_b(w)",
        domain: DOMAIN,
        claim: || any(|it| at_most(&it.s_b(&it.v), &it.s_b(&it.w))),
        wrong: Wrong {
            statement: "s_b(v) + 1 <= s_b(w)",
            claim: || any(|it| at_most(&(it.s_b(&it.v) + Real::from_integer(1)), &it.s_b(&it.w))),
        },
    },
    Theorem {
        id: "s_follow_grows_with_v_now",
        statement: "v <= w implies s_follow(v, v_lead) <= s_follow(w, v_lead)",
        domain: DOMAIN,
        claim: || any(|it| at_most(&it.follow(&it.v, &it.u), &it.follow(&it.w, &it.u))),
        wrong: Wrong {
            statement: "s_follow(w, v_lead) <= s_follow(v, v_lead)",
            claim: || any(|it| at_most(&it.follow(&it.w, &it.u), &it.follow(&it.v, &it.u))),
        },
    },
    Theorem {
        id: "s_follow_falls_with_v_lead",
        statement: "v <= w implies s_follow(v_now, w) <= s_follow(v_now, v)",
        domain: DOMAIN,
        claim: || any(|it| at_most(&it.follow(&it.u, &it.w), &it.follow(&it.u, &it.v))),
        wrong: Wrong {
            statement: "s_follow(v_now, w) < s_follow(v_now, v)",
            claim: || any(|it| less(&it.follow(&it.u, &it.w), &it.follow(&it.u, &it.v))),
        },
    },
    Theorem {
        id: "s_valid_grows_with_v_now",
        statement: "v <= w implies s_valid(v) <= s_valid(w), with a leading vehicle and without",
        domain: DOMAIN,
        claim: || {
            any(|it| {
                let grows = |lead| at_most(&it.valid(&it.v, lead), &it.valid(&it.w, lead));
                Formula::All(vec![grows(Some(&it.u)), grows(None)])
            })
        },
        wrong: Wrong {
            statement: "a leading vehicle never makes s_valid shorter",
            claim: || any(|it| at_most(&it.valid(&it.v, None), &it.valid(&it.v, Some(&it.u)))),
        },
    },
    Theorem {
        id: "s_follow_is_never_below_s_cav",
        statement: "s_CAV <= s_follow",
        domain: DOMAIN,
        claim: || any(|it| at_most(&it.s_cav(), &it.follow(&it.v, &it.u))),
        wrong: Wrong {
            statement: "s_b(v_now) <= s_follow",
            claim: || any(|it| at_most(&it.s_b(&it.v), &it.follow(&it.v, &it.u))),
        },
    },
    Theorem {
        id: "s_cav_is_below_s_b_exactly_above_the_speed_of_F-04",
        statement: "F-04: s_CAV < s_b exactly when v_now > 2 a_b safety_time",
        domain: DOMAIN,
        claim: || any(|it| iff(&less(&it.s_cav(), &it.s_b(&it.v)), &it.is_above(2))),
        wrong: Wrong {
            statement: "exactly when v_now > a_b safety_time",
            claim: || any(|it| iff(&less(&it.s_cav(), &it.s_b(&it.v)), &it.is_above(1))),
        },
    },
    Theorem {
        id: "a_leading_vehicle_shortens_the_horizon_exactly_as_F-05_says",
        statement: "F-05: for v_lead <= v_now, s_follow < s_b exactly when s_b(v_lead) > s_CAV; for \
                    v_lead > v_now exactly when v_now > 2 a_b safety_time",
        domain: DOMAIN,
        claim: || {
            any(|it| {
                let [shorter, fast_lead] = it.shortened();
                let slower = at_most(&it.u, &it.v);
                Formula::All(vec![
                    implies(slower.clone(), iff(&shorter, &fast_lead)),
                    implies(not(slower), iff(&shorter, &it.is_above(2))),
                ])
            })
        },
        wrong: Wrong {
            statement: "whatever v_lead, exactly when s_b(v_lead) > s_CAV",
            claim: || {
                any(|it| {
                    let [shorter, fast_lead] = it.shortened();
                    iff(&shorter, &fast_lead)
                })
            },
        },
    },
    Theorem {
        id: "s_follow_is_the_RSS_distance_for_equal_braking",
        statement: "s_follow >= d_RSS with response time safety_time, no acceleration and equal \
                    braking; equal when v_now >= v_lead",
        domain: DOMAIN,
        claim: || {
            any(|it| {
                let (ours, rss) = it.and_rss();
                let slower_lead = at_most(&it.u, &it.v);
                Formula::All(vec![at_most(&rss, &ours), implies(slower_lead, equal(&ours, &rss))])
            })
        },
        wrong: Wrong {
            statement: "equal also when v_now < v_lead",
            claim: || {
                any(|it| {
                    let (ours, rss) = it.and_rss();
                    equal(&ours, &rss)
                })
            },
        },
    },
    Theorem {
        id: "s_follow_is_below_the_RSS_distance_for_unequal_braking",
        statement: "v_now = v_lead = 20 m/s, response time 1 s, CAV brakes at 4 m/s^2, lead at 8: \
                    d_RSS = 45 m, s_follow = 36 m",
        domain: "these numbers",
        claim: || unequal_braking(45, 36),
        wrong: Wrong { statement: "s_follow = 45 m", claim: || unequal_braking(45, 45) },
    },
];

type Order = fn(&Real, &Real) -> Formula;

/// Speeds v and w and another u, a_b, safety_time.
struct Speeds {
    v: Real,
    w: Real,
    u: Real,
    a_b: Real,
    time: Real,
}

impl Speeds {
    fn new(order: Order) -> Self {
        let [v, w, u, a_b, time] = ["v", "w", "u", "a_b", "safety_time"].map(Real::variable);
        given(less(&Real::zero(), &a_b));
        for number in [&v, &u, &time] {
            given(at_most(&Real::zero(), number));
        }
        given(order(&v, &w));
        Self { v, w, u, a_b, time }
    }

    fn s_b(&self, v: &Real) -> Real {
        s_b(v, &self.a_b)
    }

    fn s_cav(&self) -> Real {
        s_cav(&self.time, &self.v)
    }

    fn follow(&self, v: &Real, lead: &Real) -> Real {
        s_follow(v, lead, &self.a_b, &self.time)
    }

    fn valid(&self, v: &Real, lead: Option<&Real>) -> Real {
        s_valid(v, lead, &self.a_b, &self.time)
    }

    /// v is above so many times a_b safety_time.
    fn is_above(&self, times: i128) -> Formula {
        less(&(Real::from_integer(times) * &self.a_b * &self.time), &self.v)
    }

    /// s_follow < s_b, and s_CAV < s_b(v_lead).
    fn shortened(&self) -> [Formula; 2] {
        let shorter = less(&self.follow(&self.v, &self.u), &self.s_b(&self.v));
        [shorter, less(&self.s_cav(), &self.s_b(&self.u))]
    }

    /// s_follow, and the distance of RSS.
    fn and_rss(&self) -> (Real, Real) {
        let Self { v, u, a_b, time, .. } = self;
        (self.follow(v, u), rss(v, u, time, a_b, a_b))
    }
}

/// Of speeds v <= w.
fn any(claim: fn(&Speeds) -> Formula) -> Formula {
    claim(&Speeds::new(at_most))
}

/// The longitudinal distance of RSS without acceleration during the response time
/// (Shalev-Shwartz, Shammah, Shashua 2017, lemma 2), m.
fn rss(v_rear: &Real, v_front: &Real, response: &Real, b_rear: &Real, b_front: &Real) -> Real {
    let two = Real::from_integer(2);
    let stops = v_rear * response + v_rear.square() / (&two * b_rear);
    (stops - v_front.square() / (two * b_front)).max(Real::zero())
}

fn unequal_braking(d_rss: i128, ours: i128) -> Formula {
    let [v, response, rear, front] = [20, 1, 4, 8].map(Real::from_integer);
    Formula::All(vec![
        equal(&rss(&v, &v, &response, &rear, &front), &Real::from_integer(d_rss)),
        equal(&s_follow(&v, &v, &front, &Real::ratio(9, 5)), &Real::from_integer(ours)),
    ])
}
