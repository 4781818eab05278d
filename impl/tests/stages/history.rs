//! What the CAV saw itself, on both sides of its thresholds, as H-01 shows it
//! (`spec/hardened/what-the-cav-saw.md`).

use crate::scene::{Scene, detection, scene, track};
use mufasa::input::cycle::{Detection, Track};
use mufasa::input::profile::Profile;
use mufasa::report::Rule;
use mufasa::services::configuration::Configuration::MotRemote;

const MS: i64 = 1_000_000;
const AGES_NS: [i64; 3] = [300 * MS, 500 * MS, 800 * MS];

/// Seen where it stood in each of three lists.
fn standing_in_lists(items: &[Detection]) -> Vec<(i64, Vec<Detection>)> {
    AGES_NS.map(|age_ns| (age_ns, items.to_vec())).to_vec()
}

/// The second track, 30 m ahead and 30 m aside, has no detection now.
fn missed(history: &[(i64, Vec<Detection>)]) -> Scene {
    let mut scene = scene(Profile::HARDENED, MotRemote, [0.0, 0.0]);
    scene.tracks = Some(vec![track(1, 3.0, 50.0), track(2, 30.0, 30.0)]);
    scene.history = history.to_vec();
    scene
}

/// The second track is left out, when it is backed.
fn backed(scene: &Scene) -> bool {
    !scene.fails_by(Rule::NoAssignment)
}

#[test]
fn nothing_faster_than_v_object_is_backed() {
    let mut scene = missed(&standing_in_lists(&[detection(30.0, 30.0)]));
    let slow = Track { vx: 0.5, ..track(2, 30.0, 30.0) };
    scene.tracks = Some(vec![track(1, 3.0, 50.0), slow]);
    for (v_object, is_backed) in [(0.5 + 1e-7, true), (0.5 - 1e-7, false)] {
        scene.parameters.v_object = v_object;
        assert_eq!(backed(&scene), is_backed);
    }
    scene.parameters.v_object = 0.5;
    assert_eq!(scene.rule(), Some(Rule::Ambiguous));
}

#[test]
fn what_cannot_be_told_apart_is_rejected() {
    let ambiguous =
        |history: &[(i64, Vec<Detection>)]| missed(history).rule() == Some(Rule::Ambiguous);
    let [left, right] = [29.0, 31.0].map(|x| detection(x, 30.0));
    assert!(ambiguous(&standing_in_lists(&[left, right])), "as far");
    let nearer = detection(29.0 + 1e-7, 30.0);
    assert!(!ambiguous(&standing_in_lists(&[nearer, right])));
    assert!(!ambiguous(&standing_in_lists(&[left, left])), "the first of two at one place");
    let bound = |age_ns: i64| 1.0 + 2.0 * age_ns as f64 * 1e-9;
    let at = |off: f64| {
        AGES_NS.map(|age_ns| (age_ns, vec![detection(30.0 + bound(age_ns) + off, 30.0)]))
    };
    assert!(ambiguous(&at(0.0)), "as far as an origin may be");
    assert!(!ambiguous(&at(1e-7)) && !ambiguous(&at(-1e-7)));
    // A detection as far as it may be, and two of them.
    let detections = |items: &[Detection]| {
        let mut scene = missed(&standing_in_lists(&[detection(30.0, 30.0)]));
        scene.detections = Some([&[detection(3.0, 50.1)], items].concat());
        scene.rule() == Some(Rule::Ambiguous)
    };
    assert!(detections(&[detection(31.0, 30.0)]));
    assert!(!detections(&[detection(31.0 - 1e-7, 30.0)]));
    assert!(detections(&[detection(30.5, 30.0), detection(29.5, 30.0)]));
}
