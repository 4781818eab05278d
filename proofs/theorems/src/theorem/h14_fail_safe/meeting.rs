//! H-14: how far along w an object is (`spec/hardened/H-14.md#requirements-motions`). What it sweeps over: `theorem::rectangle`.

use super::times::{braked, driven};
use crate::claim::{Theorem, Wrong};
use crate::hardened::h14_fail_safe::motions::{Motion, Named, w_least};
use crate::input::scene::Object;
use crate::numbers::real::Real;
use crate::numbers::real::formula::{Formula, at_most, given, implies, less, same};
use crate::theorem::base::home;
use crate::theorem::rectangle::vector;

/// The theorems of this file.
pub const THEOREMS: &[Theorem] = &[
    Theorem {
        id: "r_b_is_at_most_what_an_object_goes_on_and_does_not_fall",
        statement: "H-14.24: s <= t implies r_b(s) <= r_b(t), and r_b(t) <= abs(w) t",
        domain: "all s, t >= 0, w, 0 <= w_least <= abs(w), a_tyre > 0",
        claim: || grows(|t| t),
        wrong: Wrong {
            statement: "r_b(t) <= abs(w) t / 2",
            claim: || grows(|t| t / Real::from_integer(2)),
        },
    },
    Theorem {
        id: "an_object_that_brakes_from_any_time_on_is_between_r_b_and_going_on",
        statement: "H-14.24: an object that goes on at a speed from w_least to abs(w) for any time, and then brakes with \
                    at most a_tyre to a stop, is at each time t between r_b(t) and abs(w) t along w",
        domain: "all times >= 0, w, 0 <= w_least <= abs(w), a_tyre > 0",
        claim: || between(&Real::from_integer(1)),
        wrong: Wrong {
            statement: "brakes with at most 2 a_tyre",
            claim: || between(&Real::from_integer(2)),
        },
    },
    Theorem {
        id: "no_object_is_slower_than_w_least",
        statement: "H-14.24, H-04.2: the way of a vehicle in t is at most its speed after it times t plus a_tyre t^2 / 2: so \
                    at t = 0, and still after any time of an acceleration of at least -a_tyre; so it is not slower than \
                    w_least of its mean over dt = t",
        domain: "all times, speeds >= 0, a_tyre > 0",
        claim: || slower(&Real::from_integer(1)),
        wrong: Wrong {
            statement: "of an acceleration of at least -2 a_tyre",
            claim: || slower(&Real::from_integer(2)),
        },
    },
    Theorem {
        id: "an_object_that_goes_on_is_moved_by_w_t",
        statement: "H-14: r w / abs(w) = w t for r = abs(w) t",
        domain: "all t, w",
        claim: || {
            let (motion, t) = (motion(), Real::variable("t"));
            same(&motion.moved_by(&(&motion.speed * &t)), &motion.w.scaled(&t))
        },
        wrong: Wrong {
            statement: "for r = t",
            claim: || {
                let (motion, t) = (motion(), Real::variable("t"));
                same(&motion.moved_by(&t), &motion.w.scaled(&t))
            },
        },
    },
];

/// Any motion.
fn motion() -> Motion {
    let [length, width] = ["length", "width"].map(Real::variable);
    let object = Object { frame: home(&Real::from_integer(1)).pose, length, width };
    let (w, w_least) = (vector("w"), Real::variable("w_least"));
    let speed = w.length();
    given(at_most(&Real::zero(), &w_least));
    given(at_most(&w_least, &speed));
    Motion { object, age: Real::zero(), w_least, speed, w, named: Named::default() }
}

fn a_tyre() -> Real {
    let a_tyre = Real::variable("a_tyre");
    given(less(&Real::zero(), &a_tyre));
    a_tyre
}

fn time(name: &str) -> Real {
    let time = Real::variable(name);
    given(at_most(&Real::zero(), &time));
    time
}

fn grows(share: fn(Real) -> Real) -> Formula {
    let (motion, a_tyre, [s, t]) = (motion(), a_tyre(), ["s", "t"].map(time));
    given(at_most(&s, &t));
    let r_b = motion.r_b(&a_tyre, &t);
    Formula::All(vec![
        at_most(&motion.r_b(&a_tyre, &s), &r_b),
        at_most(&r_b, &share(&motion.speed * &t)),
    ])
}

fn between(share: &Real) -> Formula {
    let (motion, a_tyre, [before, braking]) = (motion(), a_tyre(), ["before", "braking"].map(time));
    let [brakes, speed] = ["brakes", "speed"].map(Real::variable);
    given(less(&Real::zero(), &brakes));
    given(at_most(&brakes, &(share * &a_tyre)));
    given(at_most(&motion.w_least, &speed));
    given(at_most(&speed, &motion.speed));
    let t = &before + &braking;
    let way = &speed * before + braked(&speed, &brakes, &braking);
    Formula::All(vec![at_most(&motion.r_b(&a_tyre, &t), &way), at_most(&way, &(&motion.speed * t))])
}

/// What its way in t and its speed after it keep, is kept by a piece with any acceleration, and bounds its speed.
fn slower(share: &Real) -> Formula {
    let (a_tyre, [t, dt, way, speed]) = (a_tyre(), ["t", "dt", "way", "speed"].map(time));
    let a = Real::variable("a");
    given(at_most(&-(share * &a_tyre), &a));
    let kept = |way: &Real, speed: &Real, t: &Real| at_most(way, &driven(speed, &a_tyre, t));
    let after = &speed + &a * &dt;
    given(at_most(&Real::zero(), &after));
    let step = implies(
        kept(&way, &speed, &t),
        kept(&(&way + driven(&speed, &a, &dt)), &after, &(&t + &dt)),
    );
    let mean = || w_least(&(&way / &t), &a_tyre, &t);
    let bound = implies(
        Formula::All(vec![less(&Real::zero(), &t), kept(&way, &speed, &t)]),
        at_most(&mean(), &speed),
    );
    Formula::All(vec![kept(&Real::zero(), &speed, &Real::zero()), step, bound])
}
