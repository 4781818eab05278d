//! H-04: the CAV can always stop within what was checked. Standing objects; the CAV brakes at a_b at
//! the latest tau after the last accepted cycle and until then accelerates by at most a_max.

use crate::cycle::Profile;
use crate::distance::{arc_lengths, points_within, s_b, s_stop};
use crate::real::Real;
use crate::real::formula::{Formula, at_most, equal, given, less};
use crate::theorem::base::{any_cav, home};
use crate::theorem::rectangle::vector;
use crate::theorem::{Mutant, Theorem, Wrong};

const DOMAIN: &str = "all speeds >= 0, tau, a_max >= 0, a_b > 0; standing objects; a trajectory that \
                      starts at the CAV, is followed and reaches s_stop (F-26)";

/// The theorems of this file.
pub const THEOREMS: &[Theorem] = &[
    Theorem {
        id: "an_accepted_cycle_makes_the_stop_invariant_true",
        statement: "s_b(v) <= s_stop(v), so that position + s_b(v) <= position + s_stop(v), up to \
                    where points are examined",
        domain: DOMAIN,
        claim: || {
            let Vehicle { v, tau, a_max, a_b } = Vehicle::new();
            at_most(&s_b(&v, &a_b), &s_stop(&v, &tau, &a_max, &a_b))
        },
        wrong: Wrong {
            statement: "s_b(v + 1) <= s_stop(v)",
            claim: || {
                let Vehicle { v, tau, a_max, a_b } = Vehicle::new();
                at_most(&s_b(&(&v + Real::from_integer(1)), &a_b), &s_stop(&v, &tau, &a_max, &a_b))
            },
        },
        mutant: Mutant {
            file: "model/src/distance.rs",
            from: "+ s_b(&(v_now + a_max * tau), a_b)",
            to: "",
        },
    },
    Theorem {
        id: "until_the_next_cycle_the_stop_invariant_is_kept",
        statement: "after t <= tau at an acceleration a <= a_max: distance driven + s_b(v + a t) <= \
                    s_stop(v)",
        domain: DOMAIN,
        claim: || {
            let vehicle = Vehicle::new();
            let (t, a) = reaction(&vehicle);
            given(at_most(&t, &vehicle.tau));
            kept(&vehicle, &t, &a)
        },
        wrong: Wrong {
            statement: "after any time",
            claim: || {
                let vehicle = Vehicle::new();
                let (t, a) = reaction(&vehicle);
                kept(&vehicle, &t, &a)
            },
        },
        mutant: Mutant { file: "model/src/distance.rs", from: "v_now * tau + a_max", to: "a_max" },
    },
    Theorem {
        id: "braking_keeps_the_stop_invariant",
        statement: "braking at a_b for t: distance driven + s_b(v - a_b t) = s_b(v), down to standstill",
        domain: DOMAIN,
        claim: || braking(&Real::from_integer(1)),
        wrong: Wrong { statement: "braking at half of a_b", claim: || braking(&Real::ratio(1, 2)) },
        mutant: Mutant {
            file: "model/src/distance.rs",
            from: "v.square() / (Real::from_integer(2) * a_b)",
            to: "v.square() / (Real::from_integer(3) * a_b)",
        },
    },
    Theorem {
        id: "the_points_examined_reach_beyond_s_stop",
        statement: "H-04: the last point examined is the last of the trajectory, or its arc length is \
                    above both s and s_stop",
        domain: "trajectories of up to 3 points anywhere, all s >= 0, speeds, tau, a_max >= 0, a_b > 0",
        claim: || reach(Profile::Hardened),
        wrong: Wrong { statement: "also in the paper profile", claim: || reach(Profile::Paper) },
        mutant: Mutant {
            file: "model/src/distance.rs",
            from: "let count = within(&s.max(&s_stop).clone()) + 1;",
            to: "let count = within(&s.max(&s_stop).clone());",
        },
    },
];

struct Vehicle {
    v: Real,
    tau: Real,
    a_max: Real,
    a_b: Real,
}

impl Vehicle {
    fn new() -> Self {
        let [v, tau, a_max, a_b] = ["v", "tau", "a_max", "a_b"].map(Real::variable);
        given(less(&Real::zero(), &a_b));
        for number in [&v, &tau, &a_max] {
            given(at_most(&Real::zero(), number));
        }
        Self { v, tau, a_max, a_b }
    }
}

/// A time and an acceleration that the vehicle can have had for it.
fn reaction(vehicle: &Vehicle) -> (Real, Real) {
    let [t, a] = ["t", "a"].map(Real::variable);
    given(at_most(&Real::zero(), &t));
    given(at_most(&a, &vehicle.a_max));
    given(at_most(&Real::zero(), &(&vehicle.v + &a * &t)));
    (t, a)
}

/// Distance driven in the time t at the acceleration a, m.
fn driven(v: &Real, a: &Real, t: &Real) -> Real {
    v * t + a * t.square() / Real::from_integer(2)
}

fn kept(vehicle: &Vehicle, t: &Real, a: &Real) -> Formula {
    let Vehicle { v, tau, a_max, a_b } = vehicle;
    let then = driven(v, a, t) + s_b(&(v + a * t), a_b);
    at_most(&then, &s_stop(v, tau, a_max, a_b))
}

fn braking(share: &Real) -> Formula {
    let Vehicle { v, a_b, .. } = Vehicle::new();
    let t = Real::variable("t");
    let a = -(share * &a_b);
    given(at_most(&Real::zero(), &t));
    given(at_most(&Real::zero(), &(&v + &a * &t)));
    equal(&(driven(&v, &a, &t) + s_b(&(&v + &a * &t), &a_b)), &s_b(&v, &a_b))
}

fn reach(profile: Profile) -> Formula {
    let Vehicle { v, tau, a_max, a_b } = Vehicle::new();
    let s = Real::variable("s");
    given(at_most(&Real::zero(), &s));
    let mut scene = any_cav(profile);
    scene.ego.v_now = v.clone();
    (scene.parameters.tau, scene.parameters.a_max) = (tau.clone(), a_max.clone());
    scene.parameters.a_b = a_b.clone();
    let trajectory = ["0", "1", "2"].map(|name| {
        let mut point = home(&Real::from_integer(1));
        point.pose.origin = vector(name);
        point
    });
    let examined = points_within(&scene, &trajectory, &s).len();
    if examined == trajectory.len() {
        return Formula::Known(true);
    }
    let arc = &arc_lengths(&trajectory)[examined - 1];
    Formula::All(vec![less(&s, arc), less(&s_stop(&v, &tau, &a_max, &a_b), arc)])
}
