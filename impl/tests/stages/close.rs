//! What is closer than 1e-8 m is decided, however much there is of it (IMPL-01, IMPL-02).

use std::f64::consts::{FRAC_1_SQRT_2, FRAC_PI_4};

use crate::scene::{NOW_NS, Scene, detection, scene, track};
use mufasa::input::cycle::{Detection, Track, TrajectoryPoint};
use mufasa::input::profile::Profile;
use mufasa::report::{Rule, Stage, Witness};
use mufasa::services::configuration::Configuration::AllRemote;

/// Half a CAV and half a car are 1.95 m wide.
const BESIDE: f64 = 1.95 + 6e-9;

fn reason(failure: Option<Witness>) -> Option<(Rule, [f64; 2])> {
    failure.map(|it| (it.rule, it.compared))
}

/// The CAV waits at so many points.
fn waiting(profile: Profile, points: i64) -> Scene {
    let mut scene = scene(profile, AllRemote, [0.0, 0.0]);
    let point = |i| TrajectoryPoint { t_ns: NOW_NS + i * 1_000_000, ..scene.points[0] };
    scene.points = (0..points).map(point).collect();
    scene
}

fn tracks(count: i64, y: f64) -> Vec<Track> {
    (0..count).map(|id| track(id, 0.0, y)).collect()
}

/// Stages iii and iv of as many tracks and detections at as many points, which stand so far aside.
fn of_both(objects: i64, points: i64, y: f64) -> [Option<(Rule, [f64; 2])>; 2] {
    let mut scene = waiting(Profile::PAPER, points);
    scene.tracks = Some(tracks(objects, y));
    scene.detections = Some((0..objects).map(|_| detection(0.0, y)).collect());
    [Stage::Iii, Stage::Iv].map(|stage| reason(scene.failure_of(stage)))
}

/// What is farther than half of the least margin aside is told to be, however much there is of it.
#[test]
fn stages_iii_and_iv_decide_every_pair() {
    assert_eq!(of_both(64, 64, BESIDE), [None; 2]);
    let [iii, iv] = of_both(64, 64, 1.95).map(|it| it.expect("it touches").0);
    assert_eq!([iii, iv], [Rule::Collision; 2]);
    let mut scene = waiting(Profile::PAPER, 41);
    scene.tracks = Some(tracks(41, 1.95));
    scene.parameters.theta_obj = 1.9;
    assert_eq!(scene.failure_of(Stage::Iii), None);
}

/// The CAV stands, and has two places, at most 2.1 cm apart.
#[test]
fn h14_decides_every_place_and_motion() {
    let mut scene = scene(Profile::HARDENED, AllRemote, [0.0, 0.0]);
    scene.ego.speed = 0.0;
    scene.parameters.work_limit = i64::MAX;
    scene.points.truncate(1);
    let rule = |scene: &Scene| scene.failure_of_iv().map(|it| it.rule);
    scene.tracks = Some(tracks(1024, BESIDE));
    assert_eq!(scene.failure_of_iv(), None);
    scene.tracks = Some(tracks(1024, 1.95));
    assert_eq!(rule(&scene), Some(Rule::FailSafe));
    // Off a corner of the last place, askew: half the CAV's length and the offset.
    let (sin, cos) = (3.0 * FRAC_PI_4).sin_cos();
    let last = 0.015 + 0.3 * 0.3 / 16.0;
    for (gap, failure) in [(1e-8, None), (-1e-9, Some(Rule::FailSafe))] {
        let aside = (1.0 + gap) * FRAC_1_SQRT_2;
        let corner = |id| track(id, last + 2.25 + 1.4 + aside, 0.95 + aside);
        scene.tracks = Some((0..1024).map(|id| Track { cos, sin, ..corner(id) }).collect());
        assert_eq!(rule(&scene), failure, "{gap}");
    }
    // Detections that come from an earlier list, each from each item.
    let beside = |count: usize, y: f64| -> Vec<Detection> { vec![detection(0.0, y); count] };
    scene.tracks = None;
    for (y, failure) in [(BESIDE, None), (1.95, Some(Rule::Collision))] {
        scene.detections = Some(beside(64, y));
        scene.history = vec![(300_000_000, beside(64, y))];
        assert_eq!(rule(&scene), failure, "{y}");
    }
}

/// MARGIN-18: who drifts into the CAV's way ahead of it keeps beside the path, 0.1 mm aside all along, and does not where
/// that is less than is certain.
#[test]
fn who_keeps_beside_by_a_tenth_of_a_millimetre() {
    let mut scene = scene(Profile::HARDENED, AllRemote, [0.0, 0.0]);
    let mut aside = |room: f64| {
        let drifting = Track { vx: 20.0, vy: -2e-5, ..track(1, -3.5, 1.95 + room) };
        scene.tracks = Some(vec![drifting]);
        scene.failure_of_iv().map(|it| it.rule)
    };
    assert_eq!([1e-4, 1e-5].map(&mut aside), [None, Some(Rule::FailSafe)]);
}
