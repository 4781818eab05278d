//! Detections whose track has the past of an object that the remote left out (F-42; "disputed" in
//! SEEN-17), on both sides of the thresholds. The CAV drives at
//! 5 m/s along y = 0; a car comes from the right at 15 m/s, and the remote says that it goes away.

use crate::scene::{Scene, detection, scene, track};
use mufasa::input::cycle::{Detection, Track};
use mufasa::input::profile::Profile;
use mufasa::report::{Rule, Stage};
use mufasa::services::configuration::Configuration::{AllRemote, MotRemote};

const MS: i64 = 1_000_000;
/// Where a car is parked.
const PARKED: [f64; 2] = [7.6, -3.0];

/// Lists of this age have the parked car at 0.5 s and 0.8 s for the origin of the crossing one: its
/// past is 1.3 m and 2.4 m away; at 0.3 s 3.3 m, which is too far.
fn taken() -> Scene {
    let mut scene = scene(Profile::HARDENED, MotRemote, [0.0, 0.0]);
    let lie = Track { cos: 0.0, sin: 1.0, vx: -3.0, vy: -10.5, ..track(2, 5.0, -9.0) };
    scene.tracks = Some(vec![track(1, 3.0, 50.0), lie]);
    scene.detections = Some(vec![far(), crossing(0.0), parked(0.0)]);
    let items = |ms: i64| vec![far(), crossing(ms as f64 * 1e-3), parked(0.0)];
    scene.history = [300, 500, 800].map(|ms| (ms * MS, items(ms))).to_vec();
    scene
}

/// Things that no track explains.
fn others_far_away(count: u8) -> impl Iterator<Item = Detection> {
    (0..count).map(|i| detection(400.0 + 5.0 * f64::from(i), 300.0))
}

fn far() -> Detection {
    detection(3.0, 50.1)
}

fn crossing(seconds: f64) -> Detection {
    Detection { cos: 0.0, sin: 1.0, ..detection(5.0, -9.0 - 15.0 * seconds) }
}

/// So far from where the car is parked.
fn parked(along: f64) -> Detection {
    detection(PARKED[0] + along, PARKED[1])
}

fn collides(scene: &Scene) -> bool {
    scene.fails_by(Rule::FailSafe)
}

#[test]
fn a_track_with_the_past_of_another_object_is_not_believed() {
    for configuration in [MotRemote, AllRemote] {
        let mut scene = taken();
        scene.configuration = configuration;
        let (stage, witness) = scene.failure().expect("it crosses");
        assert_eq!((stage, witness.rule), (Stage::Iv, Rule::FailSafe), "{configuration:?}");
        assert_eq!(witness.detection, Some(1));
        assert_eq!((witness.item, witness.age_ns), (Some(1), Some(500 * MS)));
    }
}

#[test]
fn where_all_is_explained_nothing_is_disputed() {
    let mut scene = taken();
    scene.detections.as_mut().expect("detections").truncate(2);
    assert!(!collides(&scene), "it is not seen any more");
    // Nor does what is too far, which is 32 m.
    for ((away, met), others) in
        [(35.0 - 1e-6, true), (35.0 + 1e-6, false)].into_iter().flat_map(|it| [(it, 0), (it, 9)])
    {
        let mut scene = taken();
        let detections = scene.detections.as_mut().expect("detections");
        detections[2] = parked(away);
        detections.splice(0..0, others_far_away(others));
        for (age_ns, items) in &mut scene.history {
            items.push(parked(away - 70.0 * *age_ns as f64 * 1e-9));
        }
        assert_eq!(collides(&scene), met, "{away} {others}");
    }
}

/// Only the unexplained ones: here another track has the detection of the parked car, and what was
/// beside it for its past.
#[test]
fn an_explained_detection_does_not_dispute_another() {
    let mut scene = taken();
    scene.history.iter_mut().for_each(|(_, items)| items.push(parked(1.5)));
    assert!(collides(&scene));
    scene.tracks.as_mut().expect("tracks").push(track(3, PARKED[0] + 0.8, PARKED[1]));
    assert!(!collides(&scene));
    scene.detections.as_mut().expect("detections").extend(others_far_away(9));
    assert!(!collides(&scene), "nor where many are unexplained");
}

/// With the parked car in the list its place in the past is nobody's own.
#[test]
fn a_past_that_is_not_left_out_confirms_neither() {
    let mut scene = taken();
    scene.tracks.as_mut().expect("tracks").push(track(3, PARKED[0], PARKED[1]));
    assert!(collides(&scene));
}

/// The car has driven off since, 8 m in the 500 ms of the list of the track: from its own origin,
/// not from the other one, which is nearer.
#[test]
fn nothing_faster_than_v_object_disputes() {
    for (v_object, met) in [(16.0 + 1e-6, true), (16.0 - 1e-6, false)] {
        for other in [0, 3] {
            let mut scene = taken();
            scene.parameters.v_object = v_object;
            scene.detections.as_mut().expect("detections")[2] = parked(8.0);
            scene.history[0].1[2] = parked(3.2);
            scene.history[1].1.insert(other, parked(0.3));
            assert_eq!(collides(&scene), met, "{v_object} {other}");
        }
    }
}

/// SEEN-16: 1 m and what tyres bend the way of a thing, 11.5 m/s^2 dt' abs(dt' - dt)/2, or more where the CAV
/// brakes harder.
#[test]
fn another_list_has_to_support_the_dispute() {
    for (a_b, a_tyre) in [(8.0, 11.5), (20.0, 20.0)] {
        // The list of the track is that of 500 ms.
        let within = [0.3 * 0.2, 0.8 * 0.3].map(|bend| 1.0 + a_tyre * bend / 2.0);
        for (offs, met) in [([1e-7, 1e-7], false), ([-1e-7, 1e-7], true), ([1e-7, -1e-7], true)] {
            let mut scene = taken();
            scene.parameters.a_b = a_b;
            scene.history[0].1[2].y += within[0] + offs[0];
            scene.history[2].1[2].y += within[1] + offs[1];
            assert_eq!(collides(&scene), met, "{a_b} {offs:?}");
        }
    }
}

/// Neither age nor items of the reference list: here it holds no origin of the track, and that of
/// 300 ms does.
#[test]
fn the_list_is_that_of_the_track() {
    for (v_object, met) in [(30.0 + 1e-6, true), (30.0 - 1e-6, false)] {
        let mut scene = taken();
        scene.parameters.v_object = v_object;
        let [x, y] = [5.9, -5.85];
        scene.detections.as_mut().expect("detections")[2] = detection(x + 9.0, y);
        scene.history[0].1[2] = detection(x, y);
        scene.history[1].1[2] = detection(x - 6.0, y);
        assert_eq!(collides(&scene), met, "{v_object}");
        // What it supports is an item of another list.
        scene.history[1].1[2].x += 1.0 + 11.5 * 0.5 * 0.2 / 2.0 + 1e-6;
        assert!(!collides(&scene));
    }
}
