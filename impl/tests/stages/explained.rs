//! Stage iv beside stage iii: how far detections that confirmed tracks explain count as standing
//! (H-10 of `spec/3-stages.md#hardened-profile`). The CAV drives at 5 m/s along y = 0; `s_stop` is
//! 2.27 m, so that the last point examined within it is the sixth, at 2.5 m, where the CAV's front
//! is at 6.15 m; behind a leading vehicle `s_valid` is 9 m.

use crate::scene::{NOW_NS, Scene, detection, scene, track};
use mufasa::input::cycle::{Lead, Track};
use mufasa::input::profile::Profile::Hardened;
use mufasa::report::{Outcome, Rule, Stage};
use mufasa::services::configuration::Configuration::{self, AllRemote, MotRemote};

const MS: i64 = 1_000_000;
/// m/s
const SPEED: f64 = 8.0;

/// A car ahead that drives away, seen where it was, and tracked so. `gap`: from the CAV's front at
/// the sixth point to where its rear is now, m.
fn driving_away(configuration: Configuration, gap: f64) -> Scene {
    let mut scene = scene(Hardened, configuration, [0.0, 0.0]);
    let x = 6.15 + gap + 2.0;
    scene.tracks = Some(vec![track(1, 3.0, 50.0), Track { vx: SPEED, ..track(2, x, 0.0) }]);
    scene.detections = Some(vec![detection(3.0, 50.1), detection(x, 0.0)]);
    let before = |ms: i64| vec![detection(x - SPEED * ms as f64 * 1e-3, 0.0)];
    scene.history = [300, 500].map(|ms| (ms * MS, before(ms))).to_vec();
    scene.change = |cycle| {
        cycle.lead = Some(Lead { stamp_ns: NOW_NS, gap: 20.0, speed: SPEED });
    };
    scene
}

/// Point and detection of the collision in stage iv, if there is one.
fn met(scene: &Scene) -> Option<(usize, usize)> {
    let (stage, witness) = scene.failure()?;
    assert_eq!((stage, witness.rule), (Stage::Iv, Rule::Collision));
    witness.point.zip(witness.detection)
}

#[test]
fn an_explained_detection_stands_within_s_stop() {
    assert_eq!(met(&driving_away(AllRemote, -1e-7)), Some((5, 1)));
    let passed = driving_away(AllRemote, 1e-7).report();
    assert_eq!(passed.failed_stage, None);
    assert_eq!(passed.stages[2..4], [Outcome::Passed; 2]);
}

#[test]
fn any_other_detection_stands_within_s_valid() {
    let mut left_out = driving_away(AllRemote, 1e-7);
    left_out.tracks.as_mut().expect("tracks").pop();
    assert_eq!(met(&left_out), Some((6, 1)));
    // A track that one list backs is not confirmed.
    let mut once = driving_away(AllRemote, 1e-7);
    once.history.remove(0);
    assert_eq!(once.rule(), Some(Rule::CollisionStanding));
    // Its detection is the evidence of one track; both are backed.
    let mut shared = driving_away(AllRemote, 1e-7);
    let beside = Track { vx: SPEED, ..track(3, 8.15, 0.95) };
    shared.tracks.as_mut().expect("tracks").push(beside);
    shared.detections.as_mut().expect("detections").push(detection(8.15, 1.95 - 1e-3));
    for (age_ns, items) in &mut shared.history {
        items.push(detection(8.15 - SPEED * *age_ns as f64 * 1e-9, 0.95));
    }
    shared.parameters.theta_tr = 0.5;
    shared.parameters.theta_track_max = 0.99;
    assert_eq!(met(&shared), Some((6, 1)));
}

/// H-04: a car one step beyond `s_follow`, 9 m, is not examined.
#[test]
fn behind_s_valid_no_point_is_next() {
    let left_out = |gap: f64| {
        let mut scene = driving_away(AllRemote, gap);
        scene.tracks.as_mut().expect("tracks").pop();
        met(&scene)
    };
    // From the front at 2.5 m to that at 9 m, the nineteenth point.
    assert_eq!(left_out(6.5 - 1e-7), Some((18, 1)));
    assert_eq!(left_out(6.5 + 1e-7), None);
}

#[test]
fn without_stage_iii_it_stands_within_s_valid() {
    assert_eq!(met(&driving_away(MotRemote, 1e-7)), Some((6, 1)));
    // A track list that is not current explains nothing.
    let mut old = driving_away(AllRemote, 1e-7);
    old.track_age_ns = 91 * MS;
    for car in old.tracks.as_mut().expect("tracks") {
        car.x -= car.vx * 0.091;
    }
    assert_eq!(met(&old), Some((6, 1)));
}

/// First in the order of points, then detections, each as far as it is examined.
#[test]
fn the_witness_is_the_first_point() {
    for (gap, behind, first) in [(1e-7, 0.6, (7, 2)), (-1e-7, 0.6, (5, 1)), (1e-7, -0.1, (5, 2))] {
        let mut scene = driving_away(AllRemote, gap);
        // A thing on the road, of which the remote says nothing, above the car.
        scene.detections.as_mut().expect("detections").push(detection(8.15 + behind, 0.0));
        for (_, items) in &mut scene.history {
            items.push(detection(8.15 + behind, 0.0));
        }
        assert_eq!(met(&scene), Some(first), "{gap} {behind}");
    }
}
