//! The distances (`spec/3-stages.md#distances`), F-04, F-05, and the distance of RSS.

use crate::numbers::real::Real;
use crate::numbers::real::formula::{Formula, at_most, equal, given, iff, implies, less, not};
use crate::stages::distances::{s_b, s_cav, s_follow, s_valid};
use crate::theorem::{Theorem, Wrong};

const DOMAIN: &str = "all speeds >= 0, a_b > 0, safety_time >= 0";

/// The theorems of this file.
pub const THEOREMS: &[Theorem] = &[
    Theorem {
        id: "s_b_grows_with_v",
        statement: "v <= w implies s_b(v) <= s_b(w)",
        domain: DOMAIN,
        claim: || s_b_grows(&Real::zero()),
        wrong: Wrong { statement: "s_b(v) + 1 <= s_b(w)", claim: || s_b_grows(&Real::ratio(1, 1)) },
    },
    Theorem {
        id: "s_follow_grows_with_v_now",
        statement: "v <= w implies s_follow(v, v_lead) <= s_follow(w, v_lead)",
        domain: DOMAIN,
        claim: || {
            let Speeds { v, w, u, a_b, time } = Speeds::new();
            at_most(&s_follow(&v, &u, &a_b, &time), &s_follow(&w, &u, &a_b, &time))
        },
        wrong: Wrong {
            statement: "s_follow(w, v_lead) <= s_follow(v, v_lead)",
            claim: || {
                let Speeds { v, w, u, a_b, time } = Speeds::new();
                at_most(&s_follow(&w, &u, &a_b, &time), &s_follow(&v, &u, &a_b, &time))
            },
        },
    },
    Theorem {
        id: "s_follow_falls_with_v_lead",
        statement: "v <= w implies s_follow(v_now, w) <= s_follow(v_now, v)",
        domain: DOMAIN,
        claim: || {
            let Speeds { v, w, u, a_b, time } = Speeds::new();
            at_most(&s_follow(&u, &w, &a_b, &time), &s_follow(&u, &v, &a_b, &time))
        },
        wrong: Wrong {
            statement: "s_follow(v_now, w) < s_follow(v_now, v)",
            claim: || {
                let Speeds { v, w, u, a_b, time } = Speeds::new();
                less(&s_follow(&u, &w, &a_b, &time), &s_follow(&u, &v, &a_b, &time))
            },
        },
    },
    Theorem {
        id: "s_valid_grows_with_v_now",
        statement: "v <= w implies s_valid(v) <= s_valid(w), with a leading vehicle and without",
        domain: DOMAIN,
        claim: || {
            let Speeds { v, w, u, a_b, time } = Speeds::new();
            let grows = |lead: Option<&Real>| {
                at_most(&s_valid(&v, lead, &a_b, &time), &s_valid(&w, lead, &a_b, &time))
            };
            Formula::All(vec![grows(Some(&u)), grows(None)])
        },
        wrong: Wrong {
            statement: "a leading vehicle never makes s_valid shorter",
            claim: || {
                let Speeds { v, u, a_b, time, .. } = Speeds::new();
                at_most(&s_valid(&v, None, &a_b, &time), &s_valid(&v, Some(&u), &a_b, &time))
            },
        },
    },
    Theorem {
        id: "s_follow_is_never_below_s_cav",
        statement: "s_CAV <= s_follow",
        domain: DOMAIN,
        claim: || {
            let Speeds { v, u, a_b, time, .. } = Speeds::new();
            at_most(&s_cav(&time, &v), &s_follow(&v, &u, &a_b, &time))
        },
        wrong: Wrong {
            statement: "s_b(v_now) <= s_follow",
            claim: || {
                let Speeds { v, u, a_b, time, .. } = Speeds::new();
                at_most(&s_b(&v, &a_b), &s_follow(&v, &u, &a_b, &time))
            },
        },
    },
    Theorem {
        id: "s_cav_is_below_s_b_exactly_above_the_speed_of_F-04",
        statement: "F-04: s_CAV < s_b exactly when v_now > 2 a_b safety_time",
        domain: DOMAIN,
        claim: || f_04(2),
        wrong: Wrong { statement: "exactly when v_now > a_b safety_time", claim: || f_04(1) },
    },
    Theorem {
        id: "a_leading_vehicle_shortens_the_horizon_exactly_as_F-05_says",
        statement: "F-05: for v_lead <= v_now, s_follow < s_b exactly when s_b(v_lead) > s_CAV; for \
                    v_lead > v_now exactly when v_now > 2 a_b safety_time",
        domain: DOMAIN,
        claim: || {
            let Speeds { v, u, a_b, time, .. } = Speeds::new();
            let shorter = less(&s_follow(&v, &u, &a_b, &time), &s_b(&v, &a_b));
            let fast_lead = less(&s_cav(&time, &v), &s_b(&u, &a_b));
            let fast = less(&(Real::from_integer(2) * &a_b * &time), &v);
            let slower = at_most(&u, &v);
            Formula::All(vec![
                implies(slower.clone(), iff(&shorter, &fast_lead)),
                implies(not(slower), iff(&shorter, &fast)),
            ])
        },
        wrong: Wrong {
            statement: "whatever v_lead, exactly when s_b(v_lead) > s_CAV",
            claim: || {
                let Speeds { v, u, a_b, time, .. } = Speeds::new();
                let shorter = less(&s_follow(&v, &u, &a_b, &time), &s_b(&v, &a_b));
                iff(&shorter, &less(&s_cav(&time, &v), &s_b(&u, &a_b)))
            },
        },
    },
    Theorem {
        id: "s_follow_is_the_RSS_distance_for_equal_braking",
        statement: "s_follow >= d_RSS with response time safety_time, no acceleration and equal \
                    braking; equal when v_now >= v_lead",
        domain: DOMAIN,
        claim: || {
            let Speeds { v, u, a_b, time, .. } = Speeds::new();
            let (ours, rss) = (s_follow(&v, &u, &a_b, &time), rss(&v, &u, &time, &a_b, &a_b));
            let slower_lead = at_most(&u, &v);
            Formula::All(vec![at_most(&rss, &ours), implies(slower_lead, equal(&ours, &rss))])
        },
        wrong: Wrong {
            statement: "equal also when v_now < v_lead",
            claim: || {
                let Speeds { v, u, a_b, time, .. } = Speeds::new();
                equal(&s_follow(&v, &u, &a_b, &time), &rss(&v, &u, &time, &a_b, &a_b))
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

/// Speeds v <= w and another u, a_b, safety_time.
struct Speeds {
    v: Real,
    w: Real,
    u: Real,
    a_b: Real,
    time: Real,
}

impl Speeds {
    fn new() -> Self {
        let [v, w, u, a_b, time] = ["v", "w", "u", "a_b", "safety_time"].map(Real::variable);
        given(less(&Real::zero(), &a_b));
        for number in [&v, &u, &time] {
            given(at_most(&Real::zero(), number));
        }
        given(at_most(&v, &w));
        Self { v, w, u, a_b, time }
    }
}

fn s_b_grows(by: &Real) -> Formula {
    let Speeds { v, w, a_b, .. } = Speeds::new();
    at_most(&(s_b(&v, &a_b) + by), &s_b(&w, &a_b))
}

fn f_04(factor: i128) -> Formula {
    let Speeds { v, a_b, time, .. } = Speeds::new();
    let limit = Real::from_integer(factor) * &a_b * &time;
    iff(&less(&s_cav(&time, &v), &s_b(&v, &a_b)), &less(&limit, &v))
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
