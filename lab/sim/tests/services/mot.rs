//! Tracks: how near they come to the truth, and when they begin and end.

use std::collections::BTreeSet;

use mufasa::input::cycle::{Detection, Track};
use mufasa_sim::pose::Point;
use mufasa_sim::services::detectors::random::Draws;
use mufasa_sim::services::mot::Tracker;
use mufasa_sim::services::mot::assignment::assigned;
use mufasa_sim::services::mot::kalman::Filter;

const STEP_NS: i64 = 50_000_000;

/// A detection of a car with errors of 0.05 m.
fn detected(x: f64, y: f64, angle: f64, draws: &mut Draws) -> Detection {
    let [dx, dy] = draws.normal_pair();
    let (sin, cos) = libm::sincos(angle);
    Detection { x: x + 0.05 * dx, y: y + 0.05 * dy, cos, sin, length: 4.5, width: 1.8 }
}

fn run(tracker: &mut Tracker, cycle: i64, detections: &[Detection]) -> Vec<Track> {
    tracker.update(cycle * STEP_NS, detections);
    tracker.tracks(cycle * STEP_NS)
}

#[test]
fn place_and_velocity_of_a_steady_object_are_found() {
    let mut tracker = Tracker::default();
    let mut draws = Draws::new([1; 4]);
    let (mut count, mut place, mut speed) = (0.0, 0.0, 0.0);
    for cycle in 0..1000 {
        let (x, y) = (0.6 * cycle as f64, -0.3 * cycle as f64);
        let tracks = run(&mut tracker, cycle, &[detected(x, y, -0.46, &mut draws)]);
        if cycle < 40 {
            continue;
        }
        let [track] = tracks[..] else { panic!("{tracks:?}") };
        let (vx, vy) = (track.vx - 12.0, track.vy + 6.0);
        assert!(vx.abs() < 1.2 && vy.abs() < 1.2, "{track:?}");
        count += 2.0;
        place += (track.x - x) * (track.x - x) + (track.y - y) * (track.y - y);
        speed += vx * vx + vy * vy;
    }
    let [place, speed] = [place, speed].map(|sum: f64| (sum / count).sqrt());
    // Better than a detection, and good enough that a prediction over 1.8 s stays within half a metre.
    assert!(place < 0.04 && speed < 0.28, "{place} m, {speed} m/s");
}

#[test]
fn a_track_begins_with_the_third_hit_of_five_and_ends_with_the_fifth_miss() {
    let mut draws = Draws::new([4; 4]);
    let mut lengths = |pattern: &[bool]| -> Vec<usize> {
        let mut tracker = Tracker::default();
        let cycle = |(cycle, hit): (i64, &bool)| {
            let detections = [detected(10.0, 0.0, 0.0, &mut draws)];
            run(&mut tracker, cycle, &detections[..usize::from(*hit)]).len()
        };
        (0..).zip(pattern).map(cycle).collect()
    };
    let (hit, miss) = (true, false);
    assert_eq!(lengths(&[hit, hit, hit, miss, miss, miss, miss, miss]), [0, 0, 1, 1, 1, 1, 1, 0]);
    assert_eq!(lengths(&[hit, miss, hit, miss, hit]), [0, 0, 0, 0, 1]);
    assert_eq!(lengths(&[hit, miss, miss, hit, miss, miss, hit, miss, miss, miss]), [0; 10]);
}

#[test]
fn of_two_that_want_the_same_detections_each_gets_what_is_best_for_both() {
    let expected = |x| Filter::new(Point::new(x, 0.0), 0.5, 1.0).expected(0.05);
    let tracks = [expected(0.0), expected(1.0)];
    let mut free: BTreeSet<usize> = [0, 1].into();
    // The nearest of the second track is that of the first, too; crosswise would be worse.
    let detections = [Point::new(1.4, 0.0), Point::new(0.6, 0.0)];
    assert_eq!(assigned(&tracks, &detections, &mut free, 13.8), [Some(1), Some(0)]);
    assert!(free.is_empty());
    // One detection for two: one of them stays without, and a second one out of reach is left.
    let mut free: BTreeSet<usize> = [0, 1].into();
    let detections = [Point::new(0.9, 0.0), Point::new(9.0, 0.0)];
    assert_eq!(assigned(&tracks, &detections, &mut free, 13.8), [None, Some(0)]);
    assert_eq!(free, [1].into());
}
