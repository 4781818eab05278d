//! `spec/hardened/H-14.md#requirements-not-examined`: who goes along, abs(w x h) <= abs(w) (0.05 + abs(c - p)/30 m), and that both who
//! follows and who keeps beside do.

use mufasa_model::hardened::h14_fail_safe::meeting::goes_along;
use mufasa_model::hardened::h14_fail_safe::motions::all_motions;
use mufasa_model::input::cycle::{Cycle, Track};

use super::following::{READINGS, cycle, is_follower, keeps_beside};
use super::scene;
use crate::base::*;

/// Goes along in the readings strict, exact, lax.
fn is_along(cycle: &Cycle) -> [bool; 3] {
    READINGS.map(|reading| {
        let scene = scene(cycle, reading);
        goes_along(&scene, &all_motions(&scene)[0])
    })
}

fn at([x, y]: [f64; 2], [vx, vy]: [f64; 2]) -> Cycle {
    cycle(Track { vx, vy, ..track(1, x, y) })
}

/// The distance at which who drives at 3/5 aside goes along: 0.05 + 16.5/30 = 0.6; 3 m more for each 0.1 of it.
const FAR: f64 = 16.5;

/// The bound is included: 0.05 stands for its double, 3602879701896397/2^56, so that abs(c - p) has to be
/// 18 m - 30 times that, which is 16.5 m - 6/2^56 m.
#[test]
fn the_bound_of_going_along_is_included() {
    let at_bound = |w: [f64; 2], units: f64| {
        let mut cycle = at([0.0, FAR], w);
        cycle.ego.y = units / 2f64.powi(56);
        cycle
    };
    for w in [[8.0, 6.0], [-8.0, 6.0], [1.0, -0.75]] {
        for (units, expected) in [(5.0, true), (6.0, true), (7.0, false)] {
            assert_eq!(is_along(&at_bound(w, units))[1], expected, "{w:?} {units}");
        }
    }
    let keeping = [5.0, 6.0, 7.0].map(|units| keeps_beside(&at_bound([1.0, -0.75], units))[1]);
    assert_eq!(keeping, [true, true, false]);
    let following = [5.0, 6.0, 7.0].map(|units| {
        let mut cycle = at([-FAR, 0.0], [8.0, 6.0]);
        cycle.ego.x = -units / 2f64.powi(56);
        is_follower(&cycle, true)[1]
    });
    assert_eq!(following, [true, true, false]);
}
