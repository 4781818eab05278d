//! Detections that move as the CAV saw them move, and what explains them (H-14,
//! `spec/hardened/H-14.md#requirements-motions`).

use crate::scene::{Scene, detection, scene, track};
use mufasa::input::cycle::{Detection, Track};
use mufasa::input::profile::Profile;
use mufasa::report::Rule;
use mufasa::services::configuration::Configuration::{self, AllRemote, MotRemote, PlanRemote};

const MS: i64 = 1_000_000;

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

/// The car 4.5 m aside, as a track that is confirmed and stands; a thing 4 m farther half a second ago,
/// with support by one list, and not by the oldest, would be a car that crosses.
fn explained(configuration: Configuration) -> Scene {
    let mut scene = crossing(configuration);
    scene.detections = Some(vec![detection(3.0, 50.1), detection(5.0, -4.5)]);
    scene.tracks = Some(vec![track(1, 3.0, 50.0), track(2, 5.0, -4.5)]);
    let items =
        |ms: i64| vec![detection(5.35, -4.5), detection(5.0, -4.5 - 8.0 * ms as f64 * 1e-3)];
    scene.history = [300, 500, 800].map(|ms| (ms * MS, items(ms))).to_vec();
    scene.history[2].1.truncate(1);
    scene
}

/// In `PlanRemote` the CAV's own tracks explain.
#[test]
fn an_explained_detection_comes_from_its_past_unless_every_list_shows_another() {
    for configuration in [MotRemote, AllRemote, PlanRemote] {
        let scene = explained(configuration);
        assert!(!met(&scene), "{configuration:?}");
        let mut shown = explained(configuration);
        shown.history[2].1.push(detection(5.0, -4.5 - 8.0 * 0.8));
        assert!(met(&shown), "{configuration:?}");
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
            (500 * MS, vec![detection(5.0, -4.5 - away), detection(5.0, -4.1)]),
        ];
        assert_eq!(met(&scene), expected, "{away}");
        if expected {
            let (_, witness) = scene.failure().expect("it crosses");
            let at = (witness.detection, witness.item, witness.age_ns);
            assert_eq!(at, (Some(1), Some(0), Some(500 * MS)));
        }
    }
}

/// Products with its velocity are rounded to whole multiples of 5e-324.
#[test]
fn who_hardly_moves_stands_in_the_way() {
    let mut scene = scene(Profile::HARDENED, AllRemote, [0.0, 0.0]);
    scene.ego.width = 2.4;
    scene.points.truncate(2);
    let narrow = Track { width: 0.9, vx: 5e-324, ..track(1, 6.0, 1.6) };
    for y in [1.6, 1.7] {
        scene.tracks = Some(vec![Track { y, ..narrow }]);
        let rule = scene.failure_of_iv().map(|witness| witness.rule);
        assert_eq!(rule, (y < 1.65).then_some(Rule::FailSafe), "{y}");
    }
}
