//! H-11: how far aside a trajectory that keeps it can be, and that a vehicle keeps it.

use crate::claim::{Theorem, Wrong};
use crate::hardened::h11_steps::slide_failure;
use crate::input::cycle::Profile;
use crate::input::scene::Point;
use crate::numbers::real::Real;
use crate::numbers::real::formula::{Formula, at_most, given};
use crate::numbers::vector::{Frame, Vector};
use crate::theorem::base::{NOW_NS, any_cav, home};
use crate::theorem::rectangle::vector;

/// The theorems of this file.
pub const THEOREMS: &[Theorem] = &[
    Theorem {
        id: "a_trajectory_of_one_heading_goes_aside_by_a_tenth_of_its_way_and_5_cm_and_1_cm_per_second",
        statement: "H-11, F-35: headings equal, D from the first point to the last one: abs(D x h) <= 0.1 D . h + 0.05 + \
                    0.01 t, the constants as doubles",
        domain: "three points 100 ms apart with headings along x, all places, L, W",
        claim: || one_heading(0.1),
        wrong: Wrong { statement: "by a twentieth of it", claim: || one_heading(0.05) },
    },
    Theorem {
        id: "turns_to_and_fro_do_not_add_up",
        statement: "H-11, F-41: a turn by 0.05 rad to the left and back, and again: abs(D y) <= 0.13 D x + 0.06 for the way D \
                    from the first point to the last one, D x >= 0",
        domain: "five points 1 ms apart, headings along x and turned by 1/20, all places, L, W",
        claim: || to_and_fro(4),
        wrong: Wrong {
            statement: "after the first turn, too, before it is turned back",
            claim: || to_and_fro(1),
        },
    },
    Theorem {
        id: "a_vehicle_with_one_reference_does_not_slide",
        statement: "H-11: the rear axle goes along the middle of two headings from point to point, the reference is anywhere \
                    from there to L/2 ahead: the rule slide passes",
        domain: "three points 100 ms apart, all headings, L, steps",
        claim: || one_reference(&Real::ratio(1, 2)),
        wrong: Wrong { statement: "to L ahead", claim: || one_reference(&Real::from_integer(1)) },
    },
];

/// A point at a multiple of a time step.
fn point(index: usize, step_ns: i64, origin: Vector, direction: Vector) -> Point {
    let t_ns = NOW_NS + step_ns * i64::try_from(index).expect("a few points");
    Point { t_ns, pose: Frame { origin, direction } }
}

/// A trajectory of three points along x that the rule slide lets pass.
fn one_heading(share: f64) -> Formula {
    let scene = any_cav(Profile::HARDENED);
    let along = || home(&Real::from_integer(1)).pose.direction;
    let mut trajectory = vec![home(&Real::from_integer(1))];
    trajectory.extend([1, 2].map(|i| point(i, 100_000_000, vector(&format!("p{i}")), along())));
    if slide_failure(&scene, &trajectory).is_some() {
        return Formula::Known(true);
    }
    let last = &trajectory[2].pose.origin;
    let rest = (Real::from_double(0.1) + Real::from_double(0.02) * Real::ratio(1, 5))
        / Real::from_integer(2);
    let limit = Real::from_double(share) * &last.x + rest;
    Formula::All(vec![at_most(&last.y, &limit), at_most(&-&last.y, &limit)])
}

/// The bound at the point with this number, of a trajectory whose headings are turned to and fro.
fn to_and_fro(at: usize) -> Formula {
    let scene = any_cav(Profile::HARDENED);
    // The tangent of half the turn is 1/40.
    let turned = || Vector { x: Real::ratio(1599, 1601), y: Real::ratio(80, 1601) };
    let ahead = || home(&Real::from_integer(1)).pose.direction;
    let mut trajectory = vec![home(&Real::from_integer(1))];
    trajectory.extend((1..5).map(|i| {
        let direction = if i % 2 == 1 { turned() } else { ahead() };
        point(i, 1_000_000, vector(&format!("p{i}")), direction)
    }));
    if slide_failure(&scene, &trajectory).is_some() {
        return Formula::Known(true);
    }
    let way = &trajectory[at].pose.origin;
    given(at_most(&Real::zero(), &scene.ego.length));
    given(at_most(&Real::zero(), &way.x));
    let limit = Real::ratio(13, 100) * &way.x + Real::ratio(6, 100);
    Formula::All(vec![at_most(&way.y, &limit), at_most(&-&way.y, &limit)])
}

/// Whether `slide` is not the rule that fails a vehicle whose reference is up to `most` L ahead of its
/// rear axle.
fn one_reference(most: &Real) -> Formula {
    let scene = any_cav(Profile::HARDENED);
    let reference = Real::variable("reference");
    given(at_most(&Real::zero(), &reference));
    given(at_most(&reference, &(most * &scene.ego.length)));
    let turned = |name| {
        let [x, y] = Real::unit(name);
        Vector { x, y }
    };
    let ahead = home(&Real::from_integer(1)).pose.direction;
    let headings = [ahead, turned("1"), turned("2")];
    let mut axle = Vector { x: Real::zero(), y: Real::zero() };
    let mut trajectory = Vec::new();
    for (i, heading) in headings.iter().enumerate() {
        if i > 0 {
            let way = Real::variable(&format!("way {i}"));
            given(at_most(&Real::zero(), &way));
            axle = &axle + &(&headings[i - 1] + heading).scaled(&way);
        }
        let origin = &axle + &heading.scaled(&reference);
        trajectory.push(point(i, 100_000_000, origin, heading.clone()));
    }
    Formula::Known(slide_failure(&scene, &trajectory).is_none())
}
