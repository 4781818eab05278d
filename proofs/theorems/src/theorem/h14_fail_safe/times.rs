//! H-14: whatever the CAV does until it brakes, with at most a_tyre, it has driven as
//! far as a place of its path between `first` and `last`
//! (`spec/hardened/H-14.md#requirements-windows`). The way of a CAV is made of pieces of any
//! acceleration that it can have; what holds of all of them is kept by each, an induction that is
//! not part of the theorems. Nor is it that a CAV that brakes harder after that is nowhere sooner.

use crate::claim::{Theorem, Wrong};
use crate::hardened::h14_fail_safe::times::{Driving, Window, a_tyre, window};
use crate::input::cycle::Profile;
use crate::numbers::real::Real;
use crate::numbers::real::formula::{Formula, at_most, equal, given, less, not};
use crate::stages::distances::s_b;
use crate::theorem::base::any_cav;

const DOMAIN: &str = "all v, tau >= 0, a_max, a_b > 0";

/// The theorems of this file.
pub const THEOREMS: &[Theorem] = &[
    Theorem {
        id: "first_is_when_a_CAV_that_speeds_up_for_tau_is_there",
        statement: "H-14: speeding up with a_max for tau and then braking with a_b the CAV is at first(f) at f, \
                    and first(f) <= T",
        domain: "all 0 <= f <= s_stop, v, tau >= 0, a_max, a_b > 0",
        claim: || is_there_first(Cav::s_stop),
        wrong: Wrong {
            statement: "also 1 m behind s_stop",
            claim: || is_there_first(|cav| cav.s_stop() + Real::from_integer(1)),
        },
    },
    Theorem {
        id: "a_tyre_is_at_least_what_tyres_hold",
        statement: "H-14: a_tyre is at least 11.5 m/s^2 and at least a_b, and one of the two",
        domain: "all a_b > 0",
        claim: || {
            let Cav { a_b, .. } = Cav::any();
            let (a, held) = (a_tyre(&a_b), Real::ratio(23, 2));
            let is_one = not(Formula::All(vec![less(&held, &a), less(&a_b, &a)]));
            Formula::All(vec![at_most(&held, &a), at_most(&a_b, &a), is_one])
        },
        wrong: Wrong {
            statement: "at most 11.5 m/s^2",
            claim: || at_most(&a_tyre(&Cav::any().a_b), &Real::ratio(23, 2)),
        },
    },
    Theorem {
        id: "last_is_when_a_CAV_that_brakes_at_once_is_there",
        statement: "H-14: braking at once with a_tyre the CAV is at last(f) at f, and last(f) <= T",
        domain: "all 0 <= f <= s_tyre(v), v, tau >= 0, a_max, a_b > 0",
        claim: || is_there_last(Cav::s_tyre),
        wrong: Wrong {
            statement: "also between s_tyre(v) and s_stop",
            claim: || is_there_last(Cav::s_stop),
        },
    },
    Theorem {
        id: "first_does_not_fall",
        statement: "H-14: f <= g implies first(f) <= first(g)",
        domain: "all 0 <= f <= g, v, tau >= 0, a_max, a_b > 0",
        claim: || in_order(Cav::first, Cav::first),
        wrong: Wrong {
            statement: "f <= g implies first(f) <= last(g)",
            claim: || in_order(Cav::first, Cav::last),
        },
    },
    Theorem {
        id: "last_does_not_fall",
        statement: "H-14: f <= g implies last(f) <= last(g)",
        domain: "all 0 <= f <= g, v, tau >= 0, a_max, a_b > 0",
        claim: || in_order(Cav::last, Cav::last),
        wrong: Wrong {
            statement: "f <= g implies last(f) <= first(g)",
            claim: || in_order(Cav::last, Cav::first),
        },
    },
    Theorem {
        id: "first_is_not_after_last",
        statement: "H-14: first(f) <= last(f) for f < s_tyre(v)",
        domain: "all 0 <= f < s_tyre(v), v, tau >= 0, a_max, a_b > 0",
        claim: || first_and_last(at_most),
        wrong: Wrong { statement: "first(f) < last(f)", claim: || first_and_last(less) },
    },
    Theorem {
        id: "what_a_CAV_can_have_done_is_kept_by_any_acceleration",
        statement: "H-14: speed and way are at most those of speeding up with a_max, at least those of braking \
                    with a_tyre, and they still are after any time of an acceleration from -a_tyre to a_max",
        domain: "all times, v >= 0, a_max, a_b > 0; the CAV does not go backwards",
        claim: || pieces(&Real::from_integer(1)),
        wrong: Wrong {
            statement: "of an acceleration up to 2 a_max",
            claim: || pieces(&Real::from_integer(2)),
        },
    },
    Theorem {
        id: "no_CAV_is_anywhere_before_first",
        statement: "H-14: whatever it did until some t <= tau, braking with a_b from then on the CAV is at no way f \
                    before first(f)",
        domain: DOMAIN,
        claim: || before_first(done_before_tau()),
        wrong: Wrong { statement: "until any t", claim: || before_first(done()) },
    },
    Theorem {
        id: "no_CAV_is_anywhere_after_last",
        statement: "H-14: whatever it does, braking with at most a_tyre, while the CAV is at a way f < s_tyre(v) it \
                    is not after last(f)",
        domain: DOMAIN,
        claim: || after_last(Cav::s_tyre),
        wrong: Wrong { statement: "f < s_stop", claim: || after_last(Cav::s_stop) },
    },
    Theorem {
        id: "until_the_next_cycle_the_stop_invariant_is_kept",
        statement: "H-14: whatever it did until some t <= tau, way + s_b(speed) <= s_stop; equal after speeding up \
                    with a_max for tau",
        domain: DOMAIN,
        claim: || {
            let (cav, done) = done_before_tau();
            let Done { way, u, .. } = cav.fastest(&cav.tau);
            let farthest = equal(&(way + s_b(&u, &cav.a_b)), &cav.s_stop());
            Formula::All(vec![kept(&cav, &done), farthest])
        },
        wrong: Wrong {
            statement: "until any t",
            claim: || {
                let (cav, done) = done();
                kept(&cav, &done)
            },
        },
    },
    Theorem {
        id: "the_fastest_CAV_keeps_the_stop_invariant",
        statement: "H-14: speeding up with a_max for tau and then braking with a_b, way + s_b(speed) <= s_stop at each time",
        domain: "all times, v, tau >= 0, a_max, a_b > 0",
        claim: || {
            let (cav, t) = (Cav::any(), way("t"));
            kept(&cav, &cav.fastest(&t))
        },
        wrong: Wrong {
            statement: "with s_b(v) in place of s_b(speed)",
            claim: || {
                let (cav, t) = (Cav::any(), way("t"));
                kept(&cav, &Done { u: cav.v.clone(), ..cav.fastest(&t) })
            },
        },
    },
    Theorem {
        id: "braking_keeps_the_stop_invariant",
        statement: "braking at a_b for t: distance driven + s_b(v - a_b t) = s_b(v), down to standstill",
        domain: DOMAIN,
        claim: || braking(&Real::from_integer(1)),
        wrong: Wrong { statement: "braking at half of a_b", claim: || braking(&Real::ratio(1, 2)) },
    },
    Theorem {
        id: "the_window_of_a_place_holds_when_the_CAV_is_there_and_at_its_neighbours",
        statement: "H-14: where the progress f of the CAV is at least the least around a place, and it has driven g, from f \
                    to the length at the place after it, first(f) and, where it surely goes on, last(g) are in the window \
                    of the place; so between two places the CAV is examined at both",
        domain: "all f <= g, lengths, v, tau >= 0, a_max, a_b > 0; the place one of more after it; exact reading",
        claim: || in_window(&Real::zero()),
        wrong: Wrong {
            statement: "to 1 m behind that",
            claim: || in_window(&Real::from_integer(1)),
        },
    },
];

/// v, tau, a_max and a_b.
pub struct Cav {
    /// m/s.
    pub v: Real,
    /// s.
    pub tau: Real,
    /// m/s^2.
    pub a_max: Real,
    /// m/s^2.
    pub a_b: Real,
}

impl Cav {
    /// Any that H-14 may be about.
    pub fn any() -> Self {
        let [v, tau, a_max, a_b] = ["v", "tau", "a_max", "a_b"].map(Real::variable);
        for number in [&a_max, &a_b] {
            given(less(&Real::zero(), number));
        }
        for number in [&v, &tau] {
            given(at_most(&Real::zero(), number));
        }
        Self { v, tau, a_max, a_b }
    }

    /// As the rule takes it.
    pub fn driving(&self) -> Driving<'_> {
        let Self { v, tau, a_max, a_b } = self;
        Driving { v, tau, a_max, a_b }
    }

    fn first(&self, f: &Real) -> Real {
        self.driving().first(f)
    }

    fn last(&self, f: &Real) -> Real {
        self.driving().last(f)
    }

    fn s_stop(&self) -> Real {
        self.driving().s_stop()
    }

    fn s_tyre(&self) -> Real {
        self.driving().s_tyre(&self.v)
    }

    /// Speeding up with a_max for tau, then braking with a_b to a stop.
    pub fn fastest(&self, t: &Real) -> Done {
        let Self { v, tau, a_max, a_b } = self;
        if t <= tau {
            return Done { t: t.clone(), way: driven(v, a_max, t), u: v + a_max * t };
        }
        let v_tau = self.driving().v_tau();
        let braking = t - tau;
        let u = (&v_tau - a_b * &braking).max(Real::zero());
        Done { t: t.clone(), way: self.driving().s_tau() + braked(&v_tau, a_b, &braking), u }
    }
}

/// Distance driven in the time t at the acceleration a, m.
pub fn driven(v: &Real, a: &Real, t: &Real) -> Real {
    v * t + a * t.square() / Real::from_integer(2)
}

/// Distance driven in the time t of braking with a to a stop, m.
pub fn braked(v: &Real, a: &Real, t: &Real) -> Real {
    if a * t <= *v { driven(v, &-a, t) } else { s_b(v, a) }
}

fn way(name: &str) -> Real {
    let way = Real::variable(name);
    given(at_most(&Real::zero(), &way));
    way
}

/// A CAV that drives in this way is at f, up to `end`, at the time that this is for f, and not after T.
fn is_there(
    end: fn(&Cav) -> Real,
    time: fn(&Cav, &Real) -> Real,
    driven: fn(&Cav, &Real) -> Real,
) -> Formula {
    let (cav, f) = (Cav::any(), way("f"));
    given(at_most(&f, &end(&cav)));
    let time = time(&cav, &f);
    Formula::All(vec![equal(&driven(&cav, &time), &f), at_most(&time, &cav.driving().t_stop())])
}

fn is_there_first(end: fn(&Cav) -> Real) -> Formula {
    is_there(end, Cav::first, |cav, t| cav.fastest(t).way)
}

fn is_there_last(end: fn(&Cav) -> Real) -> Formula {
    is_there(end, Cav::last, |cav, t| braked(&cav.v, &a_tyre(&cav.a_b), t))
}

fn in_order(a: fn(&Cav, &Real) -> Real, b: fn(&Cav, &Real) -> Real) -> Formula {
    let (cav, [f, g]) = (Cav::any(), ["f", "g"].map(way));
    given(at_most(&f, &g));
    at_most(&a(&cav, &f), &b(&cav, &g))
}

fn first_and_last(order: fn(&Real, &Real) -> Formula) -> Formula {
    let (cav, f) = (Cav::any(), way("f"));
    given(less(&f, &cav.s_tyre()));
    order(&cav.first(&f), &cav.last(&f))
}

/// What a CAV has done: at time t its way, and its speed u.
pub struct Done {
    t: Real,
    /// m.
    pub way: Real,
    /// m/s.
    pub u: Real,
}

/// Any that what every piece of its way keeps holds of.
fn done() -> (Cav, Done) {
    let cav = Cav::any();
    let [t, way, u] = ["t", "way", "u"].map(Real::variable);
    given(at_most(&Real::zero(), &t));
    let done = Done { t, way, u };
    given(can_be(&cav, &done));
    (cav, done)
}

/// The same at a time up to tau.
fn done_before_tau() -> (Cav, Done) {
    let (cav, done) = done();
    given(at_most(&done.t, &cav.tau));
    (cav, done)
}

/// Speed and way are at most those of speeding up with a_max, at least those of braking with a_tyre.
fn can_be(cav: &Cav, Done { t, way, u }: &Done) -> Formula {
    let a_tyre = a_tyre(&cav.a_b);
    Formula::All(vec![
        at_most(&Real::zero(), u),
        at_most(&(&cav.v - &a_tyre * t), u),
        at_most(u, &(&cav.v + &cav.a_max * t)),
        at_most(&braked(&cav.v, &a_tyre, t), way),
        at_most(way, &driven(&cav.v, &cav.a_max, t)),
    ])
}

/// A piece of its way.
fn after(Done { t, way, u }: &Done, a: &Real, dt: &Real) -> Done {
    given(at_most(&Real::zero(), dt));
    let after = Done { t: t + dt, way: way + driven(u, a, dt), u: u + a * dt };
    given(at_most(&Real::zero(), &after.u));
    after
}

fn pieces(share: &Real) -> Formula {
    let (cav, done) = done();
    let [a, dt] = ["a", "dt"].map(Real::variable);
    given(at_most(&-&a_tyre(&cav.a_b), &a));
    given(at_most(&a, &(share * &cav.a_max)));
    can_be(&cav, &after(&done, &a, &dt))
}

fn before_first((cav, done): (Cav, Done)) -> Formula {
    let Done { t, way, .. } = after(&done, &-&cav.a_b, &Real::variable("dt"));
    at_most(&cav.first(&way), &t)
}

fn after_last(end: fn(&Cav) -> Real) -> Formula {
    let (cav, Done { t, way, .. }) = done();
    given(less(&way, &end(&cav)));
    at_most(&t, &cav.last(&way))
}

/// Way + s_b(speed) <= s_stop.
pub fn kept(cav: &Cav, Done { way, u, .. }: &Done) -> Formula {
    at_most(&(way + s_b(u, &cav.a_b)), &cav.s_stop())
}

fn braking(share: &Real) -> Formula {
    let Cav { v, a_b, .. } = Cav::any();
    let t = Real::variable("t");
    let a = -(share * &a_b);
    given(at_most(&Real::zero(), &t));
    given(at_most(&Real::zero(), &(&v + &a * &t)));
    equal(&(driven(&v, &a, &t) + s_b(&(&v + &a * &t), &a_b)), &s_b(&v, &a_b))
}

fn in_window(beyond: &Real) -> Formula {
    let cav = Cav::any();
    let driving = cav.driving();
    let [least, f, g, after] = ["least", "f", "g", "after"].map(way);
    given(at_most(&least, &f));
    given(at_most(&f, &g));
    given(at_most(&g, &(&after + beyond)));
    let reads = any_cav(Profile::HARDENED).reads;
    let Window { begin, end } = window(&reads, &driving, &least, Some(&after));
    let begins = at_most(&begin, &cav.first(&f));
    let ends = end.map_or(Formula::Known(true), |end| {
        Formula::All(vec![less(&g, &cav.s_tyre()), at_most(&cav.last(&g), &end)])
    });
    Formula::All(vec![begins, ends])
}
