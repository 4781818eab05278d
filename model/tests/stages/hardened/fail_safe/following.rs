//! `spec/7-fail-safe.md#meeting`: who comes across and who follows, each condition on both sides.

use mufasa_model::hardened::h14_fail_safe::meeting::{comes_across, follows, keeps_offset};
use mufasa_model::hardened::h14_fail_safe::motions::motions;
use mufasa_model::input::cycle::{Cycle, Profile, Track};
use mufasa_model::report::Reading;
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

/// Follows in the readings strict, exact, lax; whether it comes across and whether the CAV keeps its offset
/// is said.
fn is_follower(cycle: &Cycle, comes_across: bool, keeps_offset: bool) -> [bool; 3] {
    READINGS.map(|reading| {
        let scene = scene(cycle, reading);
        let motion = &motions(&scene)[0];
        follows(&scene, motion, comes_across, || keeps_offset)
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

/// The distance of each place to the reference path differs from that of p by at most 0.2 m.
#[test]
fn the_offset_is_kept_to_a_fifth_of_a_metre() {
    let kept = |start: f64, end: f64| {
        let mut cycle = cycle(behind(8.0, 0.0));
        cycle.ego.y = start;
        for point in points(&mut cycle) {
            point.y = start + (point.x / 10.0).min(1.0) * (end - start);
        }
        READINGS.map(|reading| {
            let scene = scene(&cycle, reading);
            keeps_offset(&scene, scene.trajectory.as_ref().expect("it is current"))
        })
    };
    assert_eq!([kept(0.0, 0.0), kept(0.5, 0.5)], [[true; 3]; 2]);
    assert_eq!([kept(0.0, 0.19), kept(0.0, 0.21)], [[true; 3], [false; 3]]);
    assert_eq!([kept(0.4, 0.21), kept(0.4, 0.19)], [[true; 3], [false; 3]]);
    assert_eq!(kept(-0.4, -0.59), [true; 3]);
    // The distance is what counts, not the side.
    assert_eq!(kept(0.1, -0.25), [true; 3]);
    moves("differ by at most 0.2 m - m", |e| kept(0.3, 0.5 + e));
}

/// spec/7-fail-safe.md#meeting.1: who follows is not examined, whoever else comes from behind is.
#[test]
fn who_follows_keeps_its_own_distance() {
    let fast = |y: f64, vy: f64| Track { vx: 30.0, vy, ..track(1, -12.0, y) };
    let meets = |track: Track| found(&cycle(track)).is_some();
    assert!(!meets(fast(0.0, 0.0)), "in the way already");
    // Beside the smaller rectangle it is no follower but where the CAV keeps its offset.
    assert!(!meets(fast(1.9, 0.0)));
    let mut drifting = cycle(fast(1.9, 0.0));
    points(&mut drifting).iter_mut().for_each(|point| point.y = 0.04 * point.x);
    assert!(found(&drifting).is_some());
    let mut in_the_way = cycle(fast(0.0, 0.0));
    points(&mut in_the_way).iter_mut().for_each(|point| point.y = 0.04 * point.x);
    assert!(found(&in_the_way).is_none());
    // Who cuts in from beside comes against the side of the CAV.
    assert!(meets(Track { vx: 16.0, vy: -4.0, ..track(1, -5.0, 4.0) }));
    // Beside the CAV it is not behind.
    assert!(meets(Track { vx: 8.0, vy: -1.0, ..track(1, -3.9, 2.5) }));
}
