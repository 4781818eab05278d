//! `spec/7-fail-safe.md#meeting`: who comes across and who follows, each condition on both sides.

use mufasa_model::hardened::h14_fail_safe::meeting::{BesideRoute, comes_across, follows};
use mufasa_model::hardened::h14_fail_safe::motions::motions;
use mufasa_model::input::cycle::{Cycle, Profile, Track};
use mufasa_model::report::{Reading, Stage};
use mufasa_model::services::configuration::Configuration::MotRemote;

use super::{alone, found, scene};
use crate::base::*;
use crate::near::points;

const READINGS: [Reading; 3] = [Reading::Strict, Reading::Exact, Reading::Lax];

fn cycle(track: Track) -> Cycle {
    let mut cycle = base(Profile::Hardened, MotRemote);
    alone(&mut cycle, track);
    cycle
}

/// Follows in the readings strict, exact, lax; whether it comes across and whether it has a lane of its own is
/// said.
fn is_follower(cycle: &Cycle, comes_across: bool, has_own_lane: bool) -> [bool; 3] {
    READINGS.map(|reading| {
        let scene = scene(cycle, reading);
        let motion = &motions(&scene)[0];
        follows(&scene, motion, comes_across, || has_own_lane)
    })
}

fn across(cycle: &Cycle) -> [bool; 3] {
    READINGS.map(|reading| {
        let scene = scene(cycle, reading);
        comes_across(&scene, &motions(&scene)[0])
    })
}

/// A bound is moved by a margin: on which sides of it who follows (`safe` at `-1`) follows.
fn moves(name: &str, with: impl Fn(f64) -> [bool; 3]) {
    assert_eq!(with(-2e-6), [true; 3], "{name}");
    assert_eq!(with(-0.5e-6), [false, true, true], "{name}");
    assert_eq!(with(0.5e-6), [false, false, true], "{name}");
    assert_eq!(with(2e-6), [false; 3], "{name}");
}

fn behind(vx: f64, vy: f64) -> Track {
    Track { vx, vy, ..track(1, -10.0, 0.0) }
}

/// Each condition alone decides.
#[test]
fn who_follows_is_behind_and_comes_along() {
    moves("w . h > m", |e| is_follower(&cycle(behind(-e, 0.0)), true, true));
    moves("all of it behind by more than m", |e| {
        is_follower(&cycle(Track { vx: 20.0, ..track(1, -4.0 + e, 0.0) }), true, true)
    });
    moves("abs(w x h) <= w . h - m", |e| is_follower(&cycle(behind(8.0, 8.0 + e)), true, false));
    moves("to the right", |e| is_follower(&cycle(behind(8.0, -8.0 - e)), true, false));
    moves("abs(w x h) <= 0.105 w . h - m", |e| {
        is_follower(&cycle(behind(8.0, 0.84 + e)), false, true)
    });
    assert_eq!(is_follower(&cycle(behind(8.0, 0.0)), true, false), [true; 3]);
    assert_eq!(is_follower(&cycle(behind(8.0, 0.0)), false, true), [true; 3]);
    assert_eq!(is_follower(&cycle(behind(8.0, 0.0)), false, false), [false; 3]);
    assert_eq!(is_follower(&cycle(behind(8.0, 8.1)), true, true), [false; 3]);
}

/// All of its rectangle where it is now, as it looks; the rear is that of the rectangle of the CAV.
#[test]
fn behind_is_behind_the_rear() {
    let with = |x: f64, change: &dyn Fn(&mut Cycle)| {
        let mut cycle = cycle(Track { vx: 20.0, width: 3.0, ..track(1, x, 0.0) });
        change(&mut cycle);
        is_follower(&cycle, true, true)[1]
    };
    assert!(with((-4.0f64).next_down(), &|_| ()) && !with(-4.0, &|_| ()));
    // Seen 50 ms ago it is a metre farther now.
    let old = |c: &mut Cycle| c.tracks.as_mut().expect("set").stamp_ns -= 50_000_000;
    assert!(with(-5.01, &old) && !with(-4.99, &old));
    let turned = |c: &mut Cycle| {
        let item = &mut c.tracks.as_mut().expect("set").items[0];
        (item.cos, item.sin) = (0.0, -1.0);
    };
    assert!(with(-3.51, &turned) && !with(-3.49, &turned));
    let shifted = |c: &mut Cycle| c.ego.center_offset = 1.0;
    assert!(with(-3.01, &shifted) && !with(-2.99, &shifted));
}

/// What is 0.3 m inside of the CAV's sides is met by who goes on; not by who stands, nor by who came.
#[test]
fn who_comes_across_meets_the_smaller_rectangle() {
    let at = |y: f64, vx: f64| across(&cycle(Track { vx, ..track(1, -10.0, y) }));
    moves("0.3 m inside", |e| {
        let met = at(1.7 + e, 8.0);
        [met[0], met[1], met[2]]
    });
    moves("0.3 m inside, to the right", |e| at(-1.7 - e, 8.0));
    assert_eq!([at(0.0, 8.0), at(0.0, 0.0), at(0.0, -8.0)], [[true; 3], [false; 3], [false; 3]]);
    let overlapping = |vx: f64| across(&cycle(Track { vx, ..track(1, -3.0, 0.0) }));
    assert_eq!([overlapping(-8.0), overlapping(0.0)], [[true; 3], [false; 3]]);
}

/// Has a lane of its own in the readings strict, exact, lax.
fn has_own_lane(cycle: &Cycle) -> [bool; 3] {
    READINGS.map(|reading| {
        let scene = scene(cycle, reading);
        let trajectory = scene.trajectory.as_ref().expect("it is current");
        BesideRoute::new(&scene, trajectory).has_own_lane(&scene, &motions(&scene)[0])
    })
}

/// The distance of its centre to the reference path differs from that of each place by more than half of both
/// widths, which are 2 m here.
#[test]
fn who_has_a_lane_of_its_own_is_beside_the_path() {
    let at = |y: f64| has_own_lane(&cycle(Track { vx: 8.0, ..track(1, -10.0, y) }));
    moves("more than half of both widths + m", |e| at(2.0 - e));
    moves("to the right", |e| at(-2.0 + e));
    assert_eq!(at(0.0), [false; 3]);
    // As it looks along the CAV's heading: now its length counts.
    let mut turned = cycle(Track { cos: 0.0, sin: 1.0, vx: 8.0, ..track(1, -10.0, 3.01) });
    assert_eq!(has_own_lane(&turned), [true; 3]);
    turned.tracks.as_mut().expect("set").items[0].y = 2.99;
    assert_eq!(has_own_lane(&turned), [false; 3]);
    // Where it is now: 50 ms ago it was 0.1 m to the right.
    let mut moving = cycle(Track { vx: 8.0, vy: 2.0, ..track(1, -10.0, 1.95) });
    assert_eq!(has_own_lane(&moving), [false; 3]);
    moving.tracks.as_mut().expect("set").stamp_ns -= 50_000_000;
    assert_eq!(has_own_lane(&moving), [true; 3]);
    // The distance is what counts, not the side: the CAV is 0.5 m to the left.
    let mut beside = cycle(Track { vx: 8.0, ..track(1, -10.0, -2.45) });
    beside.ego.y = 0.5;
    points(&mut beside).iter_mut().for_each(|point| point.y = 0.5);
    assert_eq!(has_own_lane(&beside), [false; 3]);
}

/// Each place counts: the CAV drives to the lane where the other one is.
#[test]
fn every_place_is_beside_its_lane() {
    let with = |aside: f64| {
        let mut cycle = cycle(Track { vx: 8.0, ..track(1, -10.0, 3.0) });
        for point in points(&mut cycle) {
            point.y = (point.x / 10.0).min(1.0) * aside;
        }
        has_own_lane(&cycle)
    };
    moves("at the last place, too", |e| with(1.0 + e));
}

/// Neither it nor a place lies beyond an end of an open route.
#[test]
fn there_is_no_lane_beyond_the_ends_of_an_open_route() {
    let with = |from: f64, to: f64, closed: bool| {
        let mut cycle = cycle(Track { vx: 8.0, ..track(1, -10.0, 2.5) });
        cycle.route = straight_route(from, to);
        cycle.route.closed = closed;
        has_own_lane(&cycle)
    };
    // Dot products with a vector of about 100 m.
    moves("it is before the first point", |e| with(-10.0 + e / 110.0, 100.0, false));
    // The last place is at s_stop, where the lax reading has none.
    let ending = |e: f64| with(-100.0, 10.75 - e / 110.75, false);
    assert_eq!([ending(-2e-6), ending(-0.5e-6)], [[true; 3], [false, true, true]]);
    assert_eq!([ending(0.5e-6), ending(2e-6)], [[false, false, true]; 2]);
    assert_eq!([with(-9.0, 100.0, true), with(-100.0, 10.5, true)], [[true; 3]; 2]);
}

/// spec/7-fail-safe.md#meeting.1: who follows is not examined, whoever else comes from behind is.
#[test]
fn who_follows_keeps_its_own_distance() {
    let fast = |y: f64| Track { vx: 30.0, ..track(1, -12.0, y) };
    let meets = |track: Track| found(&cycle(track)).is_some();
    assert!(!meets(fast(0.0)), "in the way already");
    assert!(meets(fast(1.9)), "it meets the side of the CAV, and is in no lane of its own");
    // In a lane of its own it follows, also where it would meet the CAV.
    let wide = |y: f64| {
        let mut cycle = cycle(Track { vy: -2.0, ..fast(y) });
        cycle
            .route
            .cross_sections
            .iter_mut()
            .for_each(|it| (it.left[1], it.right[1]) = (9.0, -9.0));
        cycle
    };
    let with = |y: f64, slope: f64| {
        let mut cycle = wide(y);
        points(&mut cycle).iter_mut().for_each(|point| point.y = slope * point.x);
        assert!(passes(&cycle, Stage::Ii));
        found(&cycle).is_some()
    };
    assert!(!with(3.0, 0.0) && with(3.0, 0.1), "the CAV ends 1.075 m to the left");
    // Who cuts in from beside comes against the side of the CAV.
    assert!(meets(Track { vx: 16.0, vy: -4.0, ..track(1, -5.0, 4.0) }));
    // Beside the CAV it is not behind.
    assert!(meets(Track { vx: 8.0, vy: -1.0, ..track(1, -3.9, 2.5) }));
}
