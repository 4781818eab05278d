//! H-04: the CAV can always stop within what was checked. Standing objects; the CAV brakes at a_b at
//! the latest tau after the last accepted cycle and until then accelerates by at most a_max. How the
//! theorems make an induction over cycles is written in `findings/F-04.md`.

use crate::hardened::h04_horizon::{Places, e, s_stop, s_stop_along, ways};
use crate::hardened::h13_moving::places;
use crate::input::cycle::Profile;
use crate::input::scene::{Point, Scene};
use crate::numbers::real::Real;
use crate::numbers::real::formula::{Formula, at_most, equal, given, less};
use crate::numbers::vector::{Frame, Vector};
use crate::services::configuration::Configuration;
use crate::stages::distances::s_b;
use crate::stages::horizon::places_examined;
use crate::theorem::base::{any_cav, home};
use crate::theorem::rectangle::vector;
use crate::theorem::{Theorem, Wrong};

const DOMAIN: &str = "all e, speeds, tau, a_max >= 0, a_b > 0; standing objects; the CAV is e along the \
                      trajectory, which it follows";

/// The theorems of this file.
pub const THEOREMS: &[Theorem] = &[
    Theorem {
        id: "s_stop_is_beyond_where_the_CAV_stands",
        statement: "e + s_b(v) <= s_stop(e, v)",
        domain: DOMAIN,
        claim: || {
            let Vehicle { e, v, tau, a_max, a_b } = Vehicle::new();
            at_most(&(&e + s_b(&v, &a_b)), &s_stop(&e, &v, &tau, &a_max, &a_b))
        },
        wrong: Wrong {
            statement: "e + s_b(v + 1) <= s_stop(e, v)",
            claim: || {
                let Vehicle { e, v, tau, a_max, a_b } = Vehicle::new();
                let braking = s_b(&(&v + Real::from_integer(1)), &a_b);
                at_most(&(&e + braking), &s_stop(&e, &v, &tau, &a_max, &a_b))
            },
        },
    },
    Theorem {
        id: "until_the_next_cycle_the_stop_invariant_is_kept",
        statement: "after t <= tau at an acceleration a <= a_max: e + distance driven + s_b(v + a t) \
                    <= s_stop(e, v)",
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
    },
    Theorem {
        id: "braking_keeps_the_stop_invariant",
        statement: "braking at a_b for t: distance driven + s_b(v - a_b t) = s_b(v), down to standstill",
        domain: DOMAIN,
        claim: || braking(&Real::from_integer(1)),
        wrong: Wrong { statement: "braking at half of a_b", claim: || braking(&Real::ratio(1, 2)) },
    },
    Theorem {
        id: "the_CAV_is_at_most_e_along_the_trajectory",
        statement: "H-04: (p - first point) . first heading <= e",
        domain: "all positions, first headings of length 1",
        claim: || along_first_heading(&Real::from_integer(1)),
        wrong: Wrong { statement: "<= e / 2", claim: || along_first_heading(&Real::ratio(1, 2)) },
    },
    Theorem {
        id: "the_places_examined_reach_s_stop",
        statement: "H-04: along a trajectory and straight on behind its end, also in MotRemote, the last place \
                    examined is not before s_stop; a point that is not examined is behind s",
        domain: "3 points anywhere, all headings along x, that end at most 1/2 m before s_stop, all \
                 s >= 0, speeds, tau, a_max >= 0, a_b > 0, L >= 1/4 m; center_offset = 0",
        claim: || reach(Profile::Hardened, any_s, places_examined),
        wrong: Wrong {
            statement: "also in the paper profile",
            claim: || reach(Profile::Paper, any_s, places_examined),
        },
    },
    Theorem {
        id: "motion_is_examined_tau_motion_before_the_last_moment",
        statement: "H-13: as the places examined reach s_stop, those examined for motion do, and when the \
                    last one is not the last point, it is behind s_stop + tau_motion v_now",
        domain: "as the_places_examined_reach_s_stop, all tau_motion >= 0",
        claim: || {
            reach(Profile::Hardened, tau_motion_farther, |scene, points, _| places(scene, points))
        },
        wrong: Wrong {
            statement: "those of stage iv are, too (s = 0)",
            claim: || {
                reach(Profile::Hardened, tau_motion_farther, |scene, points, _| {
                    places_examined(scene, points, &Real::zero())
                })
            },
        },
    },
];

struct Vehicle {
    e: Real,
    v: Real,
    tau: Real,
    a_max: Real,
    a_b: Real,
}

impl Vehicle {
    fn new() -> Self {
        let [e, v, tau, a_max, a_b] = ["e", "v", "tau", "a_max", "a_b"].map(Real::variable);
        given(less(&Real::zero(), &a_b));
        for number in [&e, &v, &tau, &a_max] {
            given(at_most(&Real::zero(), number));
        }
        Self { e, v, tau, a_max, a_b }
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
    let Vehicle { e, v, tau, a_max, a_b } = vehicle;
    let then = e + driven(v, a, t) + s_b(&(v + a * t), a_b);
    at_most(&then, &s_stop(e, v, tau, a_max, a_b))
}

fn braking(share: &Real) -> Formula {
    let Vehicle { v, a_b, .. } = Vehicle::new();
    let t = Real::variable("t");
    let a = -(share * &a_b);
    given(at_most(&Real::zero(), &t));
    given(at_most(&Real::zero(), &(&v + &a * &t)));
    equal(&(driven(&v, &a, &t) + s_b(&(&v + &a * &t), &a_b)), &s_b(&v, &a_b))
}

/// Any horizon of a stage, and s_stop.
fn any_s(scene: &Scene, trajectory: &[Point]) -> [Real; 2] {
    let s = Real::variable("s");
    given(at_most(&Real::zero(), &s));
    [s, s_stop_along(scene, trajectory)]
}

/// s_stop + tau_motion v_now, m, twice.
fn tau_motion_farther(scene: &Scene, trajectory: &[Point]) -> [Real; 2] {
    let way = &scene.parameters.tau_motion * &scene.ego.v_now;
    let s = s_stop_along(scene, trajectory) + way;
    [s.clone(), s]
}

fn along_first_heading(share: &Real) -> Formula {
    let mut scene = any_cav(Profile::Hardened);
    scene.ego.position = vector("p");
    let [x, y] = Real::unit("first");
    let mut first = home(&Real::from_integer(1));
    first.pose = Frame { origin: vector("first"), direction: Vector { x, y } };
    let driven = &scene.ego.position - &first.pose.origin;
    let along = driven.dot(&first.pose.direction);
    at_most(&along, &(share * e(&scene, &[first])))
}

/// How far all points are examined, and how far the last one of them is at least.
type Horizon = fn(&Scene, &[Point]) -> [Real; 2];
type Examined = for<'a> fn(&'a Scene, &'a [Point], &Real) -> Places<'a>;

fn reach(profile: Profile, horizon: Horizon, examined: Examined) -> Formula {
    let Vehicle { v, tau, a_max, a_b, .. } = Vehicle::new();
    let tau_motion = Real::variable("tau_motion");
    given(at_most(&Real::zero(), &tau_motion));
    let mut scene = any_cav(profile);
    scene.configuration = Configuration::MotRemote;
    given(at_most(&Real::ratio(1, 4), &scene.ego.length));
    scene.ego.v_now = v;
    scene.parameters.tau_motion = tau_motion;
    (scene.parameters.tau, scene.parameters.a_max, scene.parameters.a_b) = (tau, a_max, a_b);
    let trajectory = ["0", "1", "2"].map(|name| {
        let mut point = home(&Real::from_integer(1));
        point.pose.origin = vector(name);
        point
    });
    let (arcs, s_stop) = (ways(&trajectory), s_stop_along(&scene, &trajectory));
    let end = &arcs[trajectory.len() - 1];
    given(at_most(&(&s_stop - end), &Real::ratio(1, 2)));
    let [s, t] = horizon(&scene, &trajectory);
    let examined: Vec<Point> = examined(&scene, &trajectory, &s).iter().collect();
    if examined.len() < trajectory.len() {
        let [last, next] = [examined.len() - 1, examined.len()].map(|i| &arcs[i]);
        return Formula::All(vec![less(&s_stop, last), less(&t, last), less(&s, next)]);
    }
    let last = &examined[examined.len() - 1].pose.origin;
    let beyond = (last - &trajectory[trajectory.len() - 1].pose.origin).length();
    at_most(&s_stop, &(end + beyond))
}
