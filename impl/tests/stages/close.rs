//! How much that is close is decided (LLCC-03, H-14.54, MARGIN-14, MARGIN-15).

use std::f64::consts::{FRAC_1_SQRT_2, FRAC_PI_4};

use crate::scene::{NOW_NS, Scene, detection, scene, track};
use mufasa::input::cycle::{Detection, Track, TrajectoryPoint};
use mufasa::input::profile::Profile;
use mufasa::report::{Rule, Stage, Witness};
use mufasa::services::configuration::Configuration::AllRemote;

/// Half a CAV and half a car are 1.95 m wide.
const BESIDE: f64 = 1.95 + 6e-9;
const LIMIT: Option<(Rule, [f64; 2])> = Some((Rule::WorkLimit, [1025.0, 1024.0]));

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
fn standing() -> Scene {
    let mut scene = scene(Profile::HARDENED, AllRemote, [0.0, 0.0]);
    scene.ego.speed = 0.0;
    scene.points.truncate(1);
    scene
}

/// `s_stop`: 0.3 m/s after `tau`.
const LAST: f64 = 0.015 + 0.3 * 0.3 / 16.0;

#[test]
fn h14_decides_1024_close_places_and_motions_and_not_1025() {
    let mut scene = standing();
    scene.tracks = Some(tracks(512, BESIDE));
    assert_eq!(scene.failure_of_iv(), None);
    // Before the last place, and 2 cm before the other one; half the CAV's length and the offset.
    let ahead = track(512, LAST + 2.25 + 1.4 + 2.0 + 1e-8, 0.0);
    let with = |x| [tracks(512, BESIDE), vec![Track { x, ..ahead }]].concat();
    scene.tracks = Some(with(ahead.x));
    assert_eq!(reason(scene.failure_of_iv()), LIMIT);
    scene.tracks = Some(with(ahead.x + 0.01));
    assert_eq!(scene.failure_of_iv(), None);
    // Off a corner, askew, where boxes do not tell.
    let (sin, cos) = (3.0 * FRAC_PI_4).sin_cos();
    for (gap, failure) in [(0.011, None), (1e-9, LIMIT)] {
        let aside = (1.0 + gap) * FRAC_1_SQRT_2;
        let corner = |id| track(id, LAST + 2.25 + 1.4 + aside, 0.95 + aside);
        // They are 1.5 cm farther from the other place.
        let askew = (1..1024).map(|id| Track { cos, sin, ..corner(id) });
        scene.tracks = Some(tracks(1, BESIDE).into_iter().chain(askew).collect());
        assert_eq!(reason(scene.failure_of_iv()), failure, "{gap}");
    }
}

/// Pairs count wherever one is that meets the CAV, so that the order of items makes no difference.
#[test]
fn h14_counts_what_is_close_whatever_meets_the_cav() {
    let mut scene = standing();
    scene.tracks = Some([tracks(513, BESIDE), vec![track(513, 5.0, 0.0)]].concat());
    assert_eq!(reason(scene.failure_of_iv()), LIMIT);
    let mut tracks = scene.tracks.take().expect("514");
    tracks.reverse();
    scene.tracks = Some(tracks.clone());
    assert_eq!(reason(scene.failure_of_iv()), LIMIT);
    tracks.truncate(513);
    scene.tracks = Some(tracks);
    assert_eq!(scene.failure_of_iv().map(|it| it.rule), Some(Rule::FailSafe));
}

/// Detections that come from an earlier list, each from each item.
#[test]
fn h14_counts_motions_of_detections() {
    let mut scene = standing();
    scene.tracks = None;
    let beside = |count: usize| -> Vec<Detection> { vec![detection(0.0, BESIDE); count] };
    // Each from each item, and each as unexplained, at two places: 924 and 1056.
    for (count, earlier, failure) in [(21, 21, None), (22, 23, LIMIT)] {
        scene.detections = Some(beside(count));
        scene.history = vec![(300_000_000, beside(earlier))];
        assert_eq!(reason(scene.failure_of_iv()), failure, "{count}");
    }
}

/// An object that follows meets the CAV at each place, and is not close.
#[test]
fn who_follows_does_not_count() {
    let mut scene = standing();
    let behind = |id| Track { vx: 5.0, ..track(id, -3.3, 0.0) };
    scene.tracks = Some([tracks(512, BESIDE), (512..1024).map(behind).collect()].concat());
    assert_eq!(scene.failure_of_iv(), None);
    scene.tracks = Some(vec![Track { vy: 5.0, ..behind(0) }]);
    assert_eq!(scene.failure_of_iv().map(|it| it.rule), Some(Rule::FailSafe));
}

/// Who drifts into the CAV's way ahead of it keeps beside the path, which is 10 um aside all along: nearer
/// than plain doubles tell. It does not where the path leads 20 um to its side.
#[test]
fn who_keeps_beside_by_less_than_plain_doubles_tell() {
    let mut scene = scene(Profile::HARDENED, AllRemote, [0.0, 0.0]);
    let drifting = Track { vx: 20.0, vy: -2e-5, ..track(1, -3.5, 1.95 + 1e-5) };
    scene.tracks = Some(vec![drifting]);
    assert_eq!(scene.failure_of_iv(), None);
    scene.points.iter_mut().skip(3).for_each(|point| point.y = 2e-5);
    assert_eq!(scene.failure_of_iv().map(|it| it.rule), Some(Rule::FailSafe));
}
