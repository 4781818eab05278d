//! `spec/hardened/H-14.md#requirements-not-examined`: who keeps beside does so where the route bends, abs(h x g_i) <=
//! abs(g_i) (0.05 + (distance of p from g_i)/R - M) - m, R = 30 m for who comes towards the CAV, else 300 m.

use mufasa_model::input::cycle::{CrossSection, Cycle};

use super::following::{beside, keeps_beside, moves, moves_by_m};

use crate::base::*;
use crate::near::*;

fn on_route<const N: usize>(cycle: &mut Cycle, route: [[f64; 2]; N]) {
    let at = |[x, y]: [f64; 2]| CrossSection { x, y, left: [x, y + 9.0], right: [x, y - 9.0] };
    cycle.route.cross_sections = route.map(at).into();
}

/// A car 4 m beside the straight route that goes the CAV's way, and two that come towards it.
const SAME_WAY: f64 = -10.0;
const TOWARDS: [f64; 2] = [0.0, 8.0];

fn car(object: f64, y: f64) -> Cycle {
    beside(object, y, if object < -0.5 { 8.0 } else { -8.0 }, 0.0)
}

/// A leg of this length and sine that begins at a corner of the straight route.
fn corner(object: f64, x: f64, length: f64, sin: f64) -> Cycle {
    let mut cycle = car(object, -4.0 * sin.signum());
    let cos = (1.0 - sin * sin).sqrt();
    on_route(&mut cycle, [[-100.0, 0.0], [x, 0.0], [x + length * cos, length * sin]]);
    cycle
}

/// The bound is included: 0.05 stands for its double, 0.05 + 1/(5 2^56), so that the distance has to be 16.5 m -
/// 6/2^56 m or 165 m - 60/2^56 m for 3 of 5.
#[test]
fn the_bound_of_the_route_is_included() {
    let at_bound = |object: f64, x: f64, units: f64| {
        let mut cycle = car(object, -4.0);
        on_route(&mut cycle, [[-100.0, 0.0], [x, 0.0], [x + 4.0, 3.0]]);
        cycle.ego.x = units / 2f64.powi(56);
        keeps_beside(&cycle)
    };
    let (within, on_the_edge) = ([false, true, true], [false, false, true]);
    let behind = [59.0, 60.0, 61.0].map(|units| at_bound(SAME_WAY, 165.0, units));
    assert_eq!(behind, [within, within, on_the_edge]);
    for object in TOWARDS {
        let ahead = [5.0, 6.0, 7.0].map(|units| at_bound(object, 16.5, units));
        assert_eq!(ahead, [within, within, on_the_edge], "{object}");
    }
}

/// Who comes towards the CAV has abs(w x h) <= - w . h: 20 m ahead, where it goes along at up to 0.7.
#[test]
fn who_comes_towards_the_cav_comes_straight() {
    for side in [1.0, -1.0] {
        let keeps = |aside: f64, sin: f64| {
            let mut cycle = corner(20.0, 15.0, 100.0, sin);
            let item = &mut cycle.tracks.as_mut().expect("set").items[0];
            (item.vx, item.vy) = (-0.1, side * aside);
            keeps_beside(&cycle)
        };
        moves("45 degrees", |e| keeps(0.1 + e, 0.3));
        assert_eq!(keeps(0.105, 0.03), [true; 3], "on a route that bends little");
    }
}

/// From p, wherever it is, neither from the centre of the CAV nor from a point of the trajectory; of a segment any
/// point may be the nearest.
#[test]
fn the_distance_is_that_of_p() {
    let with = |object: f64, x: f64, sin: f64, change: &dyn Fn(&mut Cycle)| {
        let mut cycle = corner(object, x, 1.0, sin);
        change(&mut cycle);
        keeps_beside(&cycle)
    };
    let shifted = |c: &mut Cycle| c.ego.center_offset = 2.0;
    moves_by_m("same way, shifted", |e| with(SAME_WAY, 15.0, 0.1 + e, &shifted));
    moves_by_m("towards, shifted", |e| with(TOWARDS[1], 15.0, 0.55 + e, &shifted));
    let elsewhere = |c: &mut Cycle| c.ego.x = 1.0;
    moves_by_m("same way, elsewhere", |e| with(SAME_WAY, 16.0, 0.1 + e, &elsewhere));
    moves_by_m("towards, elsewhere", |e| with(TOWARDS[1], 16.0, 0.55 + e, &elsewhere));
    // The CAV looks away from the straight route, 200 m long, 16.5 m beside it.
    let leaving = |y: f64| {
        let mut cycle = beside(20.0, 10.0, -0.08, -0.06);
        (cycle.ego.y, cycle.ego.cos, cycle.ego.sin) = (y, 0.8, 0.6);
        for point in points(&mut cycle) {
            (point.x, point.y) = (0.8 * point.x, y + 0.6 * point.x);
            (point.cos, point.sin) = (0.8, 0.6);
        }
        cycle.route = straight_route(-100.0, 100.0);
        keeps_beside(&cycle)
    };
    moves_by_m("the inside of a segment", |e| leaving(16.5 - 30.0 * e));
    // A delta of 0.01 moves the bound by abs(g_i) M + m.
    let great = |sin: f64| with(SAME_WAY, 15.0, sin, &|c| c.parameters.delta = 0.01);
    assert_eq!([0.079, 0.081, 0.119, 0.121].map(great), [YES, NEAR_SAFE, NEAR_UNSAFE, NO]);
}
