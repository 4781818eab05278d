//! Tracks: how near they come to the truth, and when they begin and end.

use core::f64::consts::PI;
use std::collections::BTreeSet;

use mufasa::input::cycle::{Detection, Track};
use mufasa_sim::pose::Point;
use mufasa_sim::services::detectors::random::Draws;
use mufasa_sim::services::mot::assignment::assigned;
use mufasa_sim::services::mot::kalman::Filter;
use mufasa_sim::services::mot::{Settings, Tracker};

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
    let mut tracker = Tracker::new(Settings::default());
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
fn what_stands_has_no_velocity() {
    let mut tracker = Tracker::new(Settings::default());
    let mut draws = Draws::new([2; 4]);
    let mut moving = 0;
    for cycle in 0..2000 {
        let tracks = run(&mut tracker, cycle, &[detected(5.0, 5.0, 0.0, &mut draws)]);
        moving += tracks.iter().filter(|track| track.vx != 0.0 || track.vy != 0.0).count();
    }
    // At most one of a hundred.
    assert!(moving < 20, "{moving}");
}

#[test]
fn ids_stay_when_two_cross() {
    for seed in 0..20 {
        let mut tracker = Tracker::new(Settings::default());
        let mut draws = Draws::new([seed; 4]);
        let mut ids = Vec::new();
        for cycle in 0..120 {
            // Across each other, 3 m apart at their nearest, and next to each other in opposite directions.
            let way = 0.5 * cycle as f64 - 30.0;
            let detections = [
                detected(way, 0.0, 0.0, &mut draws),
                detected(2.0, way - 2.0, PI / 2.0, &mut draws),
                detected(-way, 2.5, PI, &mut draws),
            ];
            let tracks = run(&mut tracker, cycle, &detections);
            if cycle == 10 {
                ids = tracks.iter().map(|track| (track.id, track.vx, track.vy)).collect();
                assert_eq!(ids.len(), 3);
            }
        }
        let tracks = tracker.tracks(119 * STEP_NS);
        let now: Vec<_> = tracks.iter().map(|track| (track.id, track.vx, track.vy)).collect();
        assert_eq!(now.len(), 3);
        for ((id, vx, vy), (id_now, vx_now, vy_now)) in ids.iter().zip(&now) {
            assert_eq!(id, id_now);
            assert!(
                (vx - vx_now).abs() < 3.0 && (vy - vy_now).abs() < 3.0,
                "seed {seed}: {ids:?} {now:?}"
            );
        }
    }
}

#[test]
fn a_track_begins_with_the_third_hit_of_five_and_ends_with_the_fifth_miss() {
    let mut draws = Draws::new([4; 4]);
    let mut lengths = |pattern: &[bool]| -> Vec<usize> {
        let mut tracker = Tracker::new(Settings::default());
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
fn clutter_rarely_begins_a_track() {
    let mut tracker = Tracker::new(Settings::default());
    let mut draws = Draws::new([5; 4]);
    let mut seen = 0;
    for cycle in 0..4000 {
        // One a cycle, anywhere within 60 m: far more than a detector has.
        let (x, y) = (draws.between(-60.0, 60.0), draws.between(-60.0, 60.0));
        seen += run(&mut tracker, cycle, &[detected(x, y, 0.0, &mut draws)]).len();
    }
    assert!(seen < 40, "{seen} tracks in 4000 cycles");
}

#[test]
fn ids_are_bytes_and_no_two_tracks_share_one() {
    let mut tracker = Tracker::new(Settings::default());
    let mut draws = Draws::new([6; 4]);
    let mut all = BTreeSet::new();
    for cycle in 0..400 {
        // 150 objects, each for a while: more than there are tracks, and in the end more than ids.
        let first = cycle / 20 * 10;
        let detections: Vec<_> = (first..first + 150)
            .map(|place| {
                detected(10.0 * (place % 40) as f64, 10.0 * (place / 40) as f64, 0.0, &mut draws)
            })
            .collect();
        let tracks = run(&mut tracker, cycle, &detections);
        assert!(tracks.len() <= 128 && (cycle < 3 || tracks.len() > 100), "{}", tracks.len());
        let ids: BTreeSet<_> = tracks.iter().map(|track| track.id).collect();
        assert_eq!(ids.len(), tracks.len());
        assert!(ids.iter().all(|id| (0..256).contains(id)));
        all.extend(ids);
    }
    assert!(all.len() > 250, "ids go round: {}", all.len());
}

#[test]
fn old_detections_are_not_used_and_a_reset_forgets() {
    let mut tracker = Tracker::new(Settings::default());
    let mut draws = Draws::new([7; 4]);
    for cycle in 0..10 {
        run(&mut tracker, cycle, &[detected(0.5 * cycle as f64, 0.0, 0.0, &mut draws)]);
    }
    let before = tracker.tracks(0);
    run(&mut tracker, 9, &[detected(40.0, 0.0, 0.0, &mut draws)]);
    run(&mut tracker, 3, &[detected(40.0, 0.0, 0.0, &mut draws)]);
    assert_eq!(tracker.tracks(0), before);
    assert_eq!(before.len(), 1);
    tracker.reset();
    assert_eq!(tracker.tracks(0), []);
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
