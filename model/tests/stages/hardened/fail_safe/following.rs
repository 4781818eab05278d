//! `spec/hardened/H-14.md#requirements-not-examined`: who comes across, who follows and who keeps beside, each condition on both
//! sides.

use mufasa_model::hardened::h14_fail_safe::meeting::{
    BesideRoute, comes_across, follows, is_behind,
};
use mufasa_model::hardened::h14_fail_safe::motions::all_motions;
use mufasa_model::input::cycle::{CrossSection, Cycle, Profile, Track};
use mufasa_model::report::Reading;
use mufasa_model::services::configuration::Configuration::MotRemote;

use super::{alone, scene};
use crate::base::*;
use crate::near::{NEAR_SAFE, NEAR_UNSAFE, NO, YES, points};

pub(super) const READINGS: [Reading; 3] = [Reading::Strict, Reading::Exact, Reading::Lax];

pub(super) fn cycle(track: Track) -> Cycle {
    let mut cycle = base(Profile::HARDENED, MotRemote);
    alone(&mut cycle, track);
    cycle
}

/// Follows in the readings strict, exact, lax; whether it comes across is said.
pub(super) fn is_follower(cycle: &Cycle, comes_across: bool) -> [bool; 3] {
    READINGS.map(|reading| {
        let scene = scene(cycle, reading);
        let motion = &all_motions(&scene)[0];
        follows(&scene, motion, comes_across, is_behind(&scene, motion))
    })
}

/// Keeps beside the path in the readings strict, exact, lax.
pub(super) fn keeps_beside(cycle: &Cycle) -> [bool; 3] {
    READINGS.map(|reading| {
        let scene = scene(cycle, reading);
        let motion = &all_motions(&scene)[0];
        let trajectory = scene.trajectory.as_ref().expect("it is current");
        let beside_route = BesideRoute::new(&scene, trajectory);
        beside_route.keeps_beside(&scene, motion, is_behind(&scene, motion))
    })
}

fn across(cycle: &Cycle) -> [bool; 3] {
    READINGS.map(|reading| {
        let scene = scene(cycle, reading);
        let motion = &all_motions(&scene)[0];
        comes_across(&scene, motion, is_behind(&scene, motion))
    })
}

/// A bound is moved by a margin: on which sides of it who follows (`safe` at `-1`) follows.
pub(super) fn moves(name: &str, with: impl Fn(f64) -> [bool; 3]) {
    assert_eq!(with(-2e-6), [true; 3], "{name}");
    assert_eq!(with(-0.5e-6), [false, true, true], "{name}");
    assert_eq!(with(0.5e-6), [false, false, true], "{name}");
    assert_eq!(with(2e-6), [false; 3], "{name}");
}

/// The same with M, which is 0.0001 strictly.
pub(super) fn moves_by_m(name: &str, with: impl Fn(f64) -> [bool; 3]) {
    assert_eq!(with(-1.5e-4), YES, "{name}");
    assert_eq!(with(-0.9e-4), NEAR_SAFE, "{name}");
    assert_eq!(with(-0.5e-6), NEAR_SAFE, "{name}");
    assert_eq!(with(0.5e-6), NEAR_UNSAFE, "{name}");
    assert_eq!(with(3e-6), NO, "{name}");
}

fn behind(vx: f64, vy: f64) -> Track {
    Track { vx, vy, ..track(1, -10.0, 0.0) }
}

/// Each condition alone decides; from 28.5 m on every direction goes along.
/// H-14.35.
#[test]
fn who_follows_is_behind_and_comes_along() {
    let far = |vx: f64, vy: f64| cycle(Track { x: -40.0, ..behind(vx, vy) });
    moves("w . h > m", |e| is_follower(&far(-e, 0.0), true));
    moves("all of it behind by more than m", |e| {
        is_follower(&cycle(Track { vx: 20.0, ..track(1, -4.0 + e, 0.0) }), true)
    });
    moves("abs(w x h) <= w . h - m", |e| is_follower(&far(8.0, 8.0 + e), true));
    moves("to the right", |e| is_follower(&far(8.0, -8.0 - e), true));
    assert_eq!(is_follower(&cycle(behind(8.0, 0.0)), true), [true; 3]);
    assert_eq!(is_follower(&cycle(behind(8.0, 0.0)), false), [false; 3]);
}

/// What is b inside of the CAV's sides and rear and 0.3 m inside of its front is met by who goes on; not by who
/// stands, nor by who came.
/// H-14.30, H-14.31, H-14.33.
#[test]
fn who_comes_across_meets_the_inner_rectangle() {
    let at = |x: f64, y: f64, vx: f64| across(&cycle(Track { vx, ..track(1, x, y) }));
    moves("b = 0 for who is behind", |e| at(-10.0, 2.0 + e, 8.0));
    moves("0.3 m inside", |e| at(10.0, 1.7 + e, -8.0));
    moves("0.3 m inside, to the right", |e| at(10.0, -1.7 - e, -8.0));
    let stands = [at(-10.0, 0.0, 8.0), at(-10.0, 0.0, 0.0), at(-10.0, 0.0, -8.0)];
    assert_eq!(stands, [[true; 3], [false; 3], [false; 3]]);
    // b = v^2/16 is 1/16 m; from the side, past the rear and past the front.
    let slow = |x: f64, y: f64, [vx, vy]: [f64; 2]| {
        let mut cycle = cycle(Track { vx, vy, ..track(1, x, y) });
        cycle.ego.speed = 1.0;
        across(&cycle)
    };
    moves("b inside", |e| slow(10.0, 1.9375 + e, [-8.0, 0.0]));
    moves("the rear", |e| slow(-3.9375 - e, -9.0, [0.0, 8.0]));
    moves("the front", |e| slow(3.7 + e, -9.0, [0.0, 8.0]));
    let overlapping = |vx: f64| across(&cycle(Track { vx, ..track(1, -3.0, 0.0) }));
    assert_eq!([overlapping(-8.0), overlapping(0.0)], [[true; 3], [false; 3]]);
}

/// An object beside the straight route, which the CAV drives along.
pub(super) fn beside(x: f64, y: f64, vx: f64, vy: f64) -> Cycle {
    cycle(Track { vx, vy, ..track(1, x, y) })
}

/// The sagitta of CAV and object, each 4 m long: 32/1800 m = 17.8 mm for who goes the CAV's way, else 32/180 m = 0.178 m.
pub(super) fn sagitta(vx: f64) -> f64 {
    (4.0 * 4.0 + 4.0 * 4.0) / (6.0 * if vx > 0.0 { 300.0 } else { 30.0 })
}

/// The distance of its centre to the reference path differs from that of each place by more than half of both
/// widths, which are 2 m here, and the sagitta.
/// H-14.36, H-14.42.
#[test]
fn who_keeps_beside_is_beside_the_path() {
    for (x, vx) in [(-10.0, 8.0), (20.0, 8.0), (20.0, -8.0), (0.0, 8.0)] {
        let least = 2.0 + sagitta(vx);
        moves_by_m("half of both widths + M", |e| keeps_beside(&beside(x, least - e, vx, 0.0)));
        moves_by_m("to the right", |e| keeps_beside(&beside(x, -least + e, vx, 0.0)));
    }
    assert_eq!(keeps_beside(&beside(20.0, 0.0, 8.0, 0.0)), [false; 3]);
    assert_eq!(keeps_beside(&beside(20.0, 2.5, 0.0, 0.0)), [false; 3], "it may set off");
    // As it looks: now its length counts, 2 m + 1 m + 0.018 m.
    let turned = |y: f64| {
        let it = Track { cos: 0.0, sin: 1.0, vx: 8.0, ..track(1, -10.0, y) };
        keeps_beside(&cycle(it))[1]
    };
    assert!(turned(3.02) && !turned(3.01));
    // Where it is now: 0.1 s ago it was 0.07 m to the right.
    let mut moving = beside(-10.0, 1.95, 8.0, 0.7);
    assert_eq!(keeps_beside(&moving), [false; 3]);
    moving.tracks.as_mut().expect("set").stamp_ns -= 100_000_000;
    assert_eq!(keeps_beside(&moving), [true; 3]);
    // The distance is what counts, not the side: the CAV is 0.5 m to the left.
    let mut left = beside(-10.0, -2.45, 8.0, 0.0);
    left.ego.y = 0.5;
    points(&mut left).iter_mut().for_each(|point| point.y = 0.5);
    assert_eq!(keeps_beside(&left), [false; 3]);
    // The centre of the CAV's rectangle counts: 10 m ahead of p, which looks 0.04 to the left.
    let ahead = |center_offset: f64| {
        let mut cycle = beside(-20.0, 2.3, 8.0, 0.0);
        (cycle.ego.cos, cycle.ego.sin) = ((1.0 - 0.04f64 * 0.04).sqrt(), 0.04);
        cycle.ego.center_offset = center_offset;
        keeps_beside(&cycle)
    };
    assert_eq!([ahead(0.0), ahead(10.0)], [[true; 3], [false; 3]]);
}

/// An object is nearer than the CAV at every place, or farther at every place: D <= 20 m - M, A - D, and strictly
/// D > 0.1 m.
/// H-14.37, H-14.42, MARGIN-18.
#[test]
fn who_keeps_beside_is_nearer_or_farther_at_every_place() {
    moves_by_m("D <= 20 m - M", |e| keeps_beside(&beside(-10.0, 20.0 + e, 8.0, 0.0)));
    // The CAV is 5 m beside the route.
    let nearer = |y: f64| {
        let mut cycle = beside(-10.0, y, 8.0, 0.0);
        cycle.ego.y = 5.0;
        points(&mut cycle).iter_mut().for_each(|point| point.y = 5.0);
        keeps_beside(&cycle)
    };
    // A = 5 m - 1 m.
    moves_by_m("A - D > 1 m + sagitta + M", |e| nearer(3.0 - sagitta(8.0) + e));
    assert_eq!([0.0, 0.05, 0.1, 0.101].map(nearer), [NO, NEAR_SAFE, NEAR_SAFE, YES]);
    // A CAV as wide as a pole goes 2 m aside, 1/4 m from place to place: the object is between two of them.
    let pole = |y: f64| {
        let mut cycle = beside(30.0, y, 8.0, 0.0);
        let object = &mut cycle.tracks.as_mut().expect("set").items[0];
        (object.width, cycle.ego.width) = (0.02, 0.02);
        points(&mut cycle).iter_mut().skip(5).for_each(|point| point.y = 2.0);
        keeps_beside(&cycle)
    };
    assert_eq!([0.375, 1.875, 2.1].map(pole), [NO, NO, YES]);
}

/// (x - end) . g > M abs(g) + m; a delta that is greater than 0.0001 is M.
/// H-14.39, MARGIN-01.
#[test]
fn who_keeps_beside_is_not_beyond_an_end() {
    moves_by_m("behind", |e| keeps_beside(&beside(-100.0 - e, 4.0, 8.0, 0.0)));
    moves_by_m("ahead", |e| keeps_beside(&beside(200.0 + e, 4.0, 8.0, 0.0)));
    let short = |x: f64| {
        let mut cycle = beside(x, 4.0, 8.0, 0.0);
        cycle.parameters.delta = 0.01;
        cycle.route.cross_sections.insert(1, straight_route(-99.0, 0.0).cross_sections.remove(0));
        keeps_beside(&cycle)
    };
    assert_eq!(
        [-99.979, -99.981, -100.019, -100.021].map(short),
        [YES, NEAR_SAFE, NEAR_UNSAFE, NO]
    );
}

/// It drifts until it would have stopped for a CAV that brakes, tau + t_yield + abs(w) / (2 a_yield); not where it
/// is behind and drifts by at most a tenth.
/// H-14.43.
#[test]
fn who_keeps_beside_does_not_drift_into_the_path() {
    let t_h = |w: f64| 0.5 + 2.0 + w / 6.0;
    let drift = 0.25 * t_h(8f64.hypot(0.25)) + sagitta(8.0);
    for vy in [0.25, -0.25] {
        moves_by_m("drift ahead", |e| keeps_beside(&beside(20.0, 2.0 + drift - e, 8.0, vy)));
    }
    // Strictly 10^-6 of the way until then, too: 1.917 mm.
    let fast = |y: f64| keeps_beside(&beside(-10.0, y, 100.0, 0.0));
    assert_eq!([2.002, 2.0021].map(|y| fast(y + sagitta(8.0))), [NEAR_SAFE, YES]);
    assert_eq!(keeps_beside(&beside(-10.0, 2.02, 8.0, -0.25)), [true; 3]);
    moves_by_m("abs(w . q) <= abs(w) D (1/10 - M)", |e| {
        keeps_beside(&beside(-10.0, 4.0, 8.0, -8.0 * (0.1 + e).asin().tan()))
    });
    assert_eq!(keeps_beside(&beside(-10.0, 8.0, 8.0, -0.9)), [true; 3], "far enough for more");
}

/// (length^2 + L^2)/(6 R): an object of 18 m and a CAV of 6 m, 360 m^2, are nearer to each other by 360/1800 m = 0.2 m
/// where w . h > 0, and by 360/180 m = 2 m where not.
/// H-14.42, MARGIN-01.
#[test]
fn who_keeps_beside_leaves_room_for_the_sagitta() {
    let long = |y: f64, vx: f64| {
        let mut cycle = cycle(Track { vx, length: 18.0, ..track(1, 40.0, y) });
        cycle.ego.length = 6.0;
        keeps_beside(&cycle)
    };
    moves_by_m("the same way", |e| long(2.0 + 0.2 - e, 8.0));
    moves_by_m("towards", |e| long(2.0 + 2.0 - e, -8.0));
    moves("w . h > m", |e| keeps_beside(&beside(150.0, 2.1, -e, 0.0)));
}

/// From its first point on the CAV, now at p, is `aside` of p, and no other place is nearer or farther.
fn where_the_cav_moves(p: f64, aside: f64, y: f64, vy: f64) -> [bool; 3] {
    let mut cycle = beside(-10.0, y, 8.0, vy);
    cycle.ego.y = p;
    points(&mut cycle).iter_mut().for_each(|point| point.y = p);
    points(&mut cycle).iter_mut().skip(1).for_each(|point| point.y = p + aside);
    keeps_beside(&cycle)
}

/// An object that is behind and drifts by less than a tenth keeps to its lane only where the CAV comes no nearer to it
/// than at p, but for 1/8 m.
/// H-14.43, MARGIN-01.
#[test]
fn a_cav_that_comes_nearer_leaves_room_for_the_drift() {
    let with = where_the_cav_moves;
    // Farther than the CAV by 4 m - 1 m - 0.125 m; it needs 1 m, or with a drift of 0.7 m/s for 3.8 s 3.7 m.
    moves_by_m("C <= C_0 + 1/8 m - M", |e| with(0.0, 0.125 + e, 4.0, -0.7));
    moves_by_m("to the right", |e| with(0.0, -0.125 - e, -4.0, 0.7));
    // Nearer than the CAV by 5 m - 1 m - 0.125 m - 2 m; it needs 1 m, or with a drift of 0.3 m/s for 3.8 s 2.2 m.
    moves_by_m("A >= A_0 - 1/8 m + M", |e| with(5.0, -0.125 - e, 2.0, 0.3));
    let away = [with(5.0, 0.25, 2.0, 0.3), with(5.0, -0.25, 9.0, -0.7)];
    assert_eq!(away, [YES; 2], "the CAV goes away from it");
}

/// A CAV that crosses the reference path comes to who is on the other side of it, though its distance stays the same, and
/// goes away from who is on this side. Strictly it is on both sides where it is within 10^-4 m.
/// H-14.43, MARGIN-01.
#[test]
fn a_cav_that_crosses_the_reference_path_comes_nearer() {
    for side in [1.0, -1.0] {
        let with = |p: f64, aside: f64| {
            where_the_cav_moves(side * p, side * aside, side * 4.5, side * -0.7)
        };
        assert_eq!([with(-0.7, 1.4), with(0.7, -1.4)], [NO, YES]);
        moves_by_m("s D_k, s = -1", |e| with(-0.7, 0.125 + e));
        // Strictly p is 0.9e-4 m to the right, too, and C_0 is as much less.
        let near = [0.9e-4, 1.1e-4].map(|p| with(p, 0.125 - 1.5e-4));
        assert_eq!(near, [NEAR_SAFE, YES]);
    }
}

/// abs(h x h_k) <= 0.05 + progress / 30 m; a turned CAV is wider.
/// H-14.41.
#[test]
fn the_path_bends_and_does_not_turn_off() {
    let with = |sin: f64, y: f64| {
        let mut cycle = beside(-10.0, y, 8.0, 0.0);
        let turned = &mut points(&mut cycle)[1];
        (turned.cos, turned.sin) = ((1.0 - sin * sin).sqrt(), sin);
        keeps_beside(&cycle)
    };
    let bound = 0.05 + 1.0 / 30.0;
    moves_by_m("abs(h x h_k) <= bound - M", |e| with(bound + e, 4.0));
    moves_by_m("to the right", |e| with(-bound - e, 4.0));
    // (abs(cos) W + abs(sin) L) / 2, and half of its own width.
    let e_k = |sin: f64| (1.0 - sin * sin).sqrt() + 2.0 * sin;
    moves_by_m("E_k", |e| with(0.08, e_k(0.08) + 1.0 + sagitta(8.0) - e));
}

/// Several nearest points or segments are all asked; strictly those that are up to 10^-5 m farther, too.
/// H-14.44, MARGIN-18.
#[test]
fn every_nearest_point_and_segment_is_asked() {
    let on_route = |cycle: &mut Cycle, corner: [f64; 2], end: [f64; 2]| {
        let at = |[x, y]: [f64; 2]| CrossSection { x, y, left: [x, y + 9.0], right: [x, y - 9.0] };
        cycle.route.cross_sections = [[-100.0, 0.0], corner, end].map(at).into();
    };
    // Inside of a bend by a right angle, as far from both sides of it; along the first it keeps beside.
    let inside = |y: f64| {
        let mut cycle = beside(30.0, y, -8.0, 0.0);
        on_route(&mut cycle, [40.0, 0.0], [40.0, 40.0]);
        keeps_beside(&cycle)
    };
    assert_eq!([inside(10.0), inside(10.0 - 0.9e-5)], [NO, NEAR_SAFE]);
    assert_eq!([inside(10.0 - 1.1e-5), inside(10.0 + 2e-6)], [YES, NO]);
    // The last place is at a corner, where the next segment leads aside: half of W and L along it.
    let corner = |x: f64, y: f64| {
        let mut cycle = beside(0.0, y + sagitta(-8.0), -8.0, 0.0);
        on_route(&mut cycle, [x, 0.0], [x + 80.0, 30.0]);
        keeps_beside(&cycle)
    };
    // Laxly there is no place at s_stop.
    assert_eq!([corner(10.75, 2.6), corner(10.75, 2.7)], [NEAR_UNSAFE, YES]);
    assert_eq!([corner(10.750_009, 2.6), corner(10.750_011, 2.6)], [NEAR_SAFE, YES]);
}

/// Of p, too: a CAV of 20 m that looks along x covers 1 m to a side along a segment in x, and 1.4 m along one turned by a
/// sine of 0.04. It is up to 10^-5 m before the corner between the two, and C is 1.4 m.
/// H-14.43, H-14.44, MARGIN-18.
#[test]
fn every_segment_that_may_be_the_nearest_to_p_is_asked() {
    let (along, turned) = ([1.0, 0.0], [(1.0 - 0.04f64 * 0.04).sqrt(), 0.04]);
    let with = |before: f64, [x, y]: [f64; 2], [u, v]: [f64; 2]| {
        let mut cycle = beside(-20.0, 4.0, 8.0, -0.39);
        (cycle.ego.x, cycle.ego.y, cycle.ego.length) = (-before * x, -before * y, 20.0);
        for point in points(&mut cycle) {
            (point.x, point.y, point.cos, point.sin) = (point.x * u, point.x * v, u, v);
        }
        let at = |x: f64, y: f64| CrossSection { x, y, left: [x, y + 9.0], right: [x, y - 9.0] };
        let corners = [at(-100.0 * x, -100.0 * y), at(0.0, 0.0), at(200.0 * u, 200.0 * v)];
        cycle.route.cross_sections = corners.into();
        keeps_beside(&cycle)
    };
    // C_0 is 1.4 m, strictly 1 m near the corner.
    let from_turned = [0.9e-5, 1.1e-5].map(|before| with(before, turned, along));
    assert_eq!(from_turned, [NEAR_SAFE, YES]);
    // C_0 is 1 m, strictly too: 1.4 m would let the object keep its lane strictly alone.
    let from_along = [0.9e-5, 1.1e-5].map(|before| with(before, along, turned));
    assert_eq!(from_along, [NO, NO]);
}
