//! H-14: how far along w an object is (`spec/hardened/H-14.md#requirements-motions`). What it sweeps over: `theorem::rectangle`.

use super::times::braked;
use crate::claim::{Theorem, Wrong};
use crate::hardened::h14_fail_safe::motions::{Motion, Named};
use crate::input::scene::Object;
use crate::numbers::real::Real;
use crate::numbers::real::formula::{Formula, at_most, given, less, same};
use crate::theorem::base::home;
use crate::theorem::rectangle::vector;

/// The theorems of this file.
pub const THEOREMS: &[Theorem] = &[
    Theorem {
        id: "r_b_is_at_most_what_an_object_goes_on_and_does_not_fall",
        statement: "H-14: s <= t implies r_b(s) <= r_b(t), and r_b(t) <= abs(w) t",
        domain: "all s, t >= 0, w, a_tyre > 0",
        claim: || grows(|t| t),
        wrong: Wrong {
            statement: "r_b(t) <= abs(w) t / 2",
            claim: || grows(|t| t / Real::from_integer(2)),
        },
    },
    Theorem {
        id: "an_object_that_brakes_from_any_time_on_is_between_r_b_and_going_on",
        statement: "H-14: an object that goes on at abs(w) for any time, and then brakes with at most a_tyre to a stop, is \
                    at each time t between r_b(t) and abs(w) t along w",
        domain: "all times >= 0, w, a_tyre > 0",
        claim: || between(&Real::from_integer(1)),
        wrong: Wrong {
            statement: "brakes with at most 2 a_tyre",
            claim: || between(&Real::from_integer(2)),
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
    let w = vector("w");
    Motion { object, age: Real::zero(), speed: w.length(), w, named: Named::default() }
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
    let brakes = Real::variable("brakes");
    given(less(&Real::zero(), &brakes));
    given(at_most(&brakes, &(share * &a_tyre)));
    let t = &before + &braking;
    let way = &motion.speed * before + braked(&motion.speed, &brakes, &braking);
    Formula::All(vec![at_most(&motion.r_b(&a_tyre, &t), &way), at_most(&way, &(&motion.speed * t))])
}
