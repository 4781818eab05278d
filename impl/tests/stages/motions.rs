//! Detections that move as the CAV saw them move, and what explains them (H-14,
//! `spec/hardened/H-14.md#requirements-motions`). The CAV is that of `fail_safe`.

use crate::scene::{Scene, detection, scene, track};
use mufasa::input::cycle::{Detection, Track};
use mufasa::input::profile::Profile;
use mufasa::report::{Rule, Stage, Witness};
use mufasa::services::configuration::Configuration::{self, AllRemote, MotRemote, PlanRemote};

const MS: i64 = 1_000_000;
/// What stands is met up to here: `s_stop`, and half the lengths of the CAV, with its offset, and of it.
const TOUCHING: f64 = 2.270_625 + 1.4 + 2.25 + 2.0;

fn met(scene: &Scene) -> bool {
    scene.fails_by(Rule::FailSafe)
}

/// A car that comes from the right at 8 m/s and is 6 m aside now; the remote leaves it out.
fn crossing(configuration: Configuration) -> Scene {
    let mut scene = scene(Profile::HARDENED, configuration, [0.0, 0.0]);
    scene.detections = Some(vec![detection(3.0, 50.1), detection(5.0, -6.0)]);
    scene.history = vec![(300 * MS, vec![before(0.3)]), (500 * MS, vec![before(0.5)])];
    scene
}

fn before(seconds: f64) -> Detection {
    detection(5.0, -6.0 - 8.0 * seconds)
}

#[test]
fn a_car_that_crosses_and_is_left_out_is_met() {
    for configuration in [MotRemote, AllRemote, PlanRemote] {
        let mut scene = crossing(configuration);
        let (stage, witness) = scene.failure().expect("it crosses");
        assert_eq!((stage, witness.rule), (Stage::Iv, Rule::FailSafe), "{configuration:?}");
        let Witness { track, detection, item, age_ns, .. } = witness;
        assert_eq!((track, detection, item), (None, Some(1), Some(0)));
        assert_eq!(age_ns, Some(500 * MS));
        scene.history.clear();
        assert!(!met(&scene), "standing, it is beside the road");
    }
}

#[test]
fn a_detection_that_nothing_explains_counts_as_standing_too() {
    let at = |x: f64, tracks: Vec<Track>| {
        let mut scene = crossing(AllRemote);
        // Without an item of the reference list from which it may come.
        scene.history = [300, 500].map(|ms| (ms * MS, vec![detection(400.0, 0.0)])).to_vec();
        scene.detections.as_mut().expect("detections")[1] = detection(x, 0.0);
        scene.tracks = Some(tracks);
        met(&scene)
    };
    assert!(at(TOUCHING - 1e-7, vec![track(1, 3.0, 50.0)]));
    assert!(!at(TOUCHING + 1e-7, vec![track(1, 3.0, 50.0)]));
}

#[test]
fn another_list_has_to_support_it() {
    for (off, expected) in [(1.0 - 1e-7, true), (1.0 + 1e-7, false)] {
        let mut scene = crossing(MotRemote);
        scene.history[0].1[0].x += off;
        assert_eq!(met(&scene), expected, "{off}");
        scene.history.insert(1, (400 * MS, vec![before(0.4)]));
        assert!(met(&scene), "one of two");
    }
    let mut alone = crossing(MotRemote);
    alone.history.remove(0);
    assert!(met(&alone), "there is no other list");
    alone.history.insert(0, (300 * MS, vec![]));
    assert!(!met(&alone), "there is, and it is empty");
}

#[test]
fn nothing_faster_than_v_object_is_looked_for() {
    for (v_object, expected) in [(8.0 + 1e-6, true), (8.0 - 1e-6, false)] {
        let mut scene = crossing(MotRemote);
        scene.parameters.v_object = v_object;
        assert_eq!(met(&scene), expected, "{v_object}");
    }
}

/// The reference list is the one nearest to 500 ms, the younger of two.
#[test]
fn the_reference_list_is_nearest_to_500_ms() {
    for (ages_ms, reference) in
        [([300, 500], 500), ([400, 600], 400), ([399, 600], 600), ([250, 700], 700)]
    {
        let mut scene = crossing(MotRemote);
        scene.history = ages_ms.map(|ms| (ms * MS, vec![before(ms as f64 * 1e-3)])).to_vec();
        let (_, witness) = scene.failure().expect("it crosses");
        assert_eq!(witness.age_ns, Some(reference * MS), "{ages_ms:?}");
    }
}

/// The car 4.5 m aside, as a track that is confirmed and stands; a thing 4 m farther half a second ago,
/// with support, would be a car that crosses.
fn explained(configuration: Configuration) -> Scene {
    let mut scene = crossing(configuration);
    scene.detections = Some(vec![detection(3.0, 50.1), detection(5.0, -4.5)]);
    scene.tracks = Some(vec![track(1, 3.0, 50.0), track(2, 5.0, -4.5)]);
    let items = |ms: i64| vec![detection(5.0, -4.5), detection(5.0, -4.5 - 8.0 * ms as f64 * 1e-3)];
    scene.history = [300, 500].map(|ms| (ms * MS, items(ms))).to_vec();
    scene
}

/// In `PlanRemote` the CAV's own tracks explain.
#[test]
fn an_explained_detection_comes_from_its_past_alone() {
    for configuration in [MotRemote, AllRemote, PlanRemote] {
        let scene = explained(configuration);
        assert!(!met(&scene), "{configuration:?}");
        let mut unexplained = explained(configuration);
        unexplained.tracks = Some(vec![track(1, 3.0, 50.0)]);
        assert!(met(&unexplained), "{configuration:?}");
        // A list that is not current explains nothing.
        let mut old = explained(configuration);
        old.track_age_ns = 91 * MS;
        assert!(met(&old), "{configuration:?}");
    }
}

/// From each item as near to its past as an origin may be, 2 m at 500 ms.
#[test]
fn a_confirmed_track_may_come_from_every_item_near_its_past() {
    for (away, expected) in [(2.0 - 1e-7, true), (2.0 + 1e-7, false)] {
        let mut scene = explained(MotRemote);
        scene.history = vec![
            (300 * MS, vec![detection(5.0, -4.5)]),
            (500 * MS, vec![detection(5.0, -4.5 - away), detection(5.0, -4.4)]),
        ];
        assert_eq!(met(&scene), expected, "{away}");
        if expected {
            let (_, witness) = scene.failure().expect("it crosses");
            let at = (witness.detection, witness.item, witness.age_ns);
            assert_eq!(at, (Some(1), Some(0), Some(500 * MS)));
        }
    }
}

/// A track says 8 m/s of a car ahead, and what the CAV saw bears it out; but something was where the car is,
/// or at most 1 m from there, half a second ago.
#[test]
fn what_may_stand_is_met_whatever_its_track_says() {
    for (away, expected) in [(0.0, true), (1.0 - 1e-7, true), (1.0 + 1e-7, false)] {
        let mut scene = explained(AllRemote);
        scene.detections = Some(vec![detection(3.0, 50.1), detection(6.5, 0.0)]);
        scene.tracks = Some(vec![track(1, 3.0, 50.0), Track { vx: 8.0, ..track(2, 6.5, 0.0) }]);
        scene.history = vec![
            (300 * MS, vec![detection(4.1, 0.0)]),
            (500 * MS, vec![detection(6.5 - away, 0.0), detection(2.5, 0.0)]),
        ];
        assert_eq!(met(&scene), expected, "{away}");
    }
}

/// In `PlanRemote` nothing but H-14 asks what the CAV saw.
#[test]
fn what_is_too_close_to_call_fails_in_the_place_of_stage_iv() {
    let mut scene = explained(PlanRemote);
    scene.parameters.v_object = 1.0;
    assert_eq!(scene.rule(), None);
    scene.tracks.as_mut().expect("tracks")[1].vx = 1.0;
    let failure = scene.failure().map(|(stage, it)| (stage, it.rule));
    assert_eq!(failure, Some((Stage::Iv, Rule::Ambiguous)));
}

/// Detections times items of the longest list times items of all lists, 11 places and 30 points.
#[test]
fn its_work_is_limited() {
    let limited = Some((Stage::Iv, Rule::WorkLimit));
    let mut scene = crossing(MotRemote);
    scene.tracks = Some(vec![]);
    scene.detections = Some(vec![detection(3.0, 50.1), detection(5.0, -60.0)]);
    // Two usable lists of one item.
    assert_eq!(scene.failure_with_work(2 * (2 + 41)), None);
    assert_eq!(scene.failure_with_work(2 * (2 + 41) - 1), limited);
    scene.history.clear();
    assert_eq!(scene.failure_with_work(2 * 41), None);
    assert_eq!(scene.failure_with_work(2 * 41 - 1), limited);
}
