//! `spec/hardened/H-14.md#requirements-not-examined`: who keeps beside does so where the route bends, abs(h x g_i) <=
//! abs(g_i) (0.05 + (distance of p from g_i)/R), R = 30 m for who comes towards the CAV, else 300 m.

use mufasa_model::input::cycle::{CrossSection, Cycle, Profile, Track};
use mufasa_model::services::configuration::Configuration::MotRemote;

use super::following::{beside, keeps_beside, moves};
use super::{alone, margins_move_meetings};
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

/// 15 m ahead the bound is 0.1 for who goes the same way, 0.55 else, times the length of the leg; to both sides.
/// H-14.40.
#[test]
fn the_route_bends_and_does_not_turn_off() {
    let both_sides = |object: f64, sin: f64, r: f64| {
        for side in [1.0, -1.0] {
            let keeps = |x: f64, length: f64, sin: f64| {
                keeps_beside(&corner(object, x, length, side * sin))
            };
            moves("the sine", |e| keeps(15.0, 1.0, sin + e));
            moves("times the length", |e| keeps(15.0, 16.0, sin + e / 16.0));
            moves("the distance", |e| keeps(15.0 - r * e, 1.0, sin));
        }
    };
    both_sides(SAME_WAY, 0.1, 300.0);
    TOWARDS.iter().for_each(|object| both_sides(*object, 0.55, 30.0));
}

/// The route may lead the other way: so may its segments.
#[test]
fn the_route_bends_the_opposite_way_too() {
    let reversed = |object: f64, sin: f64| {
        let mut cycle = corner(object, 15.0, 1.0, sin);
        cycle.route.cross_sections.reverse();
        keeps_beside(&cycle)
    };
    moves("same way", |e| reversed(SAME_WAY, 0.1 + e));
    moves("towards", |e| reversed(TOWARDS[0], 0.55 + e));
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

/// Between the bounds, 0.1 and 0.55: who goes the CAV's way, behind it, beside it or ahead, and who comes.
#[test]
fn the_route_bends_less_for_who_goes_the_same_way() {
    for x in [-10.0, 0.0, 8.0] {
        let keeps = |vx: f64| {
            let mut cycle = corner(x, 15.0, 1.0, 0.3);
            cycle.tracks.as_mut().expect("set").items[0].vx = vx;
            keeps_beside(&cycle)
        };
        assert_eq!([8.0, -8.0].map(keeps), [[false; 3], [true; 3]], "{x}");
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

/// A leg that ends 15 m behind the CAV counts as one ahead.
#[test]
fn a_segment_behind_the_cav_counts() {
    let with = |object: f64, sin: f64| {
        let mut cycle = car(object, -4.0);
        let cos = (1.0 - sin * sin).sqrt();
        on_route(&mut cycle, [[-15.0 - cos, sin], [-15.0, 0.0], [100.0, 0.0]]);
        keeps_beside(&cycle)
    };
    moves("same way", |e| with(SAME_WAY, 0.1 + e));
    moves("towards", |e| with(TOWARDS[1], 0.55 + e));
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
    moves("same way, shifted", |e| with(SAME_WAY, 15.0, 0.1 + e, &shifted));
    moves("towards, shifted", |e| with(TOWARDS[1], 15.0, 0.55 + e, &shifted));
    let elsewhere = |c: &mut Cycle| c.ego.x = 1.0;
    moves("same way, elsewhere", |e| with(SAME_WAY, 16.0, 0.1 + e, &elsewhere));
    moves("towards, elsewhere", |e| with(TOWARDS[1], 16.0, 0.55 + e, &elsewhere));
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
    moves("the inside of a segment", |e| leaving(16.5 - 30.0 / 200.0 * e));
}

/// To a lane 3 m aside in two legs of 5.22 m each: at 0.287, which is the bound of who goes the same way from 71.2 m on, and
/// everybody else's from 7.12 m on.
fn lane_change(cycle: &mut Cycle, x: f64) {
    let legs = [[x, 0.0], [x + 5.0, 1.5], [x + 10.0, 3.0]];
    on_route(cycle, [[-100.0, 0.0], legs[0], legs[1], legs[2], [x + 100.0, 3.0]]);
}

#[test]
fn a_route_that_changes_lanes_is_no_bend_for_who_goes_the_same_way() {
    let keeps = |object: f64, x: f64| {
        let mut cycle = car(object, -4.0);
        lane_change(&mut cycle, x);
        keeps_beside(&cycle)
    };
    assert_eq!([71.0, 72.0].map(|x| keeps(SAME_WAY, x)), [[false; 3], [true; 3]]);
    assert_eq!([20.0, 71.0].map(|x| keeps(TOWARDS[1], x)), [[true; 3]; 2]);
    // Past the CAV, too: the legs end 6 m or 8 m behind it, the first of them 5.22 m farther.
    assert_eq!(
        [-10.0 - 6.0, -10.0 - 8.0].map(|x| {
            let mut cycle = beside(8.0, 9.0, -8.0, 0.0);
            lane_change(&mut cycle, x);
            cycle.route.cross_sections.iter_mut().for_each(|it| it.y -= 3.0);
            keeps_beside(&cycle)
        }),
        [[false; 3], [true; 3]]
    );
}

/// Each segment: neither the nearest ones alone, nor the first that bends, nor all but the closing one.
#[test]
fn each_segment_of_the_route_counts() {
    let second = |object: f64, sin: f64| {
        let mut cycle = car(object, -4.0);
        let cos = (1.0 - sin * sin).sqrt();
        on_route(
            &mut cycle,
            [[-100.0, 0.0], [12.0, 0.0], [15.0, 0.0], [15.0 + cos, sin], [200.0, sin]],
        );
        keeps_beside(&cycle)
    };
    moves("same way", |e| second(SAME_WAY, 0.1 + e));
    moves("towards", |e| second(TOWARDS[1], 0.55 + e));
    let third = |closed: bool, object: f64| {
        let mut cycle = car(object, 4.0);
        on_route(&mut cycle, [[-100.0, 0.0], [400.0, 0.0], [400.0, 160.0]]);
        cycle.route.closed = closed;
        keeps_beside(&cycle)
    };
    assert_eq!([third(false, SAME_WAY), third(true, SAME_WAY)], [[true; 3], [false; 3]]);
    assert_eq!(third(true, TOWARDS[1]), [true; 3], "0.305 < 0.05 + 30.5/30");
}

const NEAR: &[Near] =
    &[("who comes from behind before a lane change", MotRemote, Profile::HARDENED, |c, e| {
        alone(c, Track { vx: 30.0, vy: -2.0, ..track(1, -12.0, 3.1) });
        let (sin, length) = (0.3 + e / 5.0, 5.0);
        let end = [75.0 + length * (1.0 - sin * sin).sqrt(), length * sin];
        on_route(c, [[-100.0, 0.0], [75.0, 0.0], end, [200.0, end[1]]]);
    })];

/// H-14.40: who passes a CAV that is about to change lanes is examined.
#[test]
fn margins_move_where_the_route_bends() {
    margins_move_meetings(NEAR);
}

/// The longest route there is.
#[test]
fn a_long_route_bends_everywhere() {
    let mut cycle = beside(SAME_WAY, -4.0, 8.0, 0.0);
    let at = |i: i32| {
        let x = f64::from(i - 100);
        let y = 1e-3 * (x / 50.0).sin();
        CrossSection { x, y, left: [x, y + 9.0], right: [x, y - 9.0] }
    };
    cycle.route.cross_sections = (0..8192).map(at).collect();
    assert_eq!(keeps_beside(&cycle), [true; 3]);
}
