//! An explained detection that was seen to come from an item (SEEN-17), on both sides of the thresholds. The CAV
//! drives at 5 m/s along y = 0; a car comes from the right at 15 m/s, and the remote says that it goes away, with
//! the past of a parked car (F-42).

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

/// Whatever is detected beside it, and whatever has that past.
#[test]
fn what_every_list_shows_is_examined_whatever_tracks_say() {
    let mut scene = taken();
    scene.detections.as_mut().expect("detections").truncate(2);
    assert!(collides(&scene), "the parked car is not seen any more");
    for parked_as in [track(3, PARKED[0], PARKED[1]), track(3, PARKED[0] + 0.8, PARKED[1])] {
        let mut scene = taken();
        scene.history.iter_mut().for_each(|(_, items)| items.push(parked(1.5)));
        scene.tracks.as_mut().expect("tracks").push(parked_as);
        assert!(collides(&scene), "the parked car is in the list");
    }
}

/// 0.3 m and what tyres bend the way of a thing, 11.5 m/s^2 dt' abs(dt' - dt)/2, or more where the CAV
/// brakes harder, in each other list.
#[test]
fn each_other_list_has_to_show_it() {
    for (a_b, a_tyre) in [(8.0, 11.5), (20.0, 20.0)] {
        let within = [0.3 * 0.2, 0.8 * 0.3].map(|bend| 0.3 + a_tyre * bend / 2.0);
        let both = [-1e-7, -1e-7];
        for (offs, met) in [(both, true), ([1e-7, -1e-7], false), ([-1e-7, 1e-7], false)] {
            let mut scene = taken();
            scene.parameters.a_b = a_b;
            scene.history[0].1[1].y += within[0] + offs[0];
            scene.history[2].1[1].y += within[1] + offs[1];
            assert_eq!(collides(&scene), met, "{a_b} {offs:?}");
        }
    }
    for missed in [0, 2] {
        let mut scene = taken();
        scene.history[missed].1.remove(1);
        assert!(!collides(&scene), "{missed}");
    }
    for lost in [0, 2] {
        let mut scene = taken();
        scene.history.remove(lost);
        assert!(collides(&scene), "there are two lists: {lost}");
    }
}

/// It came 7.5 m in 500 ms.
#[test]
fn nothing_faster_than_v_object_was_seen_to_come() {
    for (v_object, met) in [(15.0 + 1e-6, true), (15.0 - 1e-6, false)] {
        let mut scene = taken();
        scene.parameters.v_object = v_object;
        assert_eq!(collides(&scene), met, "{v_object}");
    }
}

/// One list is enough where no track explains it.
#[test]
fn what_is_unexplained_may_be_missed_in_a_list() {
    for missed in [0, 2] {
        let mut scene = taken();
        scene.history[missed].1.remove(1);
        scene.tracks.as_mut().expect("tracks").truncate(1);
        assert!(collides(&scene), "{missed}");
    }
}
