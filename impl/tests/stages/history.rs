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
fn a_backed_track_may_be_missed() {
    let here = standing_in_lists(&[detection(30.0, 30.0)]);
    assert!(backed(&missed(&here)));
    assert!(backed(&missed(&here[1..])), "two lists are enough");
    assert!(!backed(&missed(&here[2..])), "one is not");
    assert!(!backed(&missed(&[])));
    let mut none = missed(&here);
    none.parameters.miss_budget = 0;
    assert!(!backed(&none));
}

#[test]
fn no_more_tracks_are_missed_than_the_budget() {
    let places = |count: i64| (0..count).map(|i| (i + 2, 8.0 * i as f64, 30.0));
    for (count, fits) in [(4, true), (5, false)] {
        let items: Vec<_> = places(count).map(|(_, x, y)| detection(x, y)).collect();
        let mut scene = missed(&standing_in_lists(&items));
        let tracks = places(count).map(|(id, x, y)| track(id, x, y));
        scene.tracks = Some([track(1, 3.0, 50.0)].into_iter().chain(tracks).collect());
        assert_eq!(backed(&scene), fits, "{count}");
    }
}

#[test]
fn a_list_is_usable_from_200_ms_to_1_s() {
    for (age_ns, usable) in [
        (200 * MS, true),
        (200 * MS - 1, false),
        (1_000 * MS, true),
        (1_000 * MS + 1, false),
        (-MS, false),
    ] {
        let mut history = vec![(500 * MS, vec![detection(30.0, 30.0)])];
        history.insert(usize::from(age_ns > 500 * MS), (age_ns, vec![detection(30.0, 30.0)]));
        assert_eq!(backed(&missed(&history)), usable, "{age_ns}");
    }
}

/// `theta_track_max` + `theta_velocity` dt is 2 m at 500 ms.
#[test]
fn an_origin_is_near_the_past() {
    for (away, near) in [(2.0 - 1e-7, true), (2.0 + 1e-7, false)] {
        let lists = [
            (300 * MS, vec![detection(30.0, 30.0)]),
            (500 * MS, vec![detection(30.0 + away, 30.0)]),
        ];
        assert_eq!(backed(&missed(&lists)), near, "{away}");
    }
}

/// The past of what moves is behind it, and its place before it when the track is older.
#[test]
fn pasts_and_places_move() {
    let at = |seconds: f64| detection(30.0 + 8.0 * seconds, 30.0);
    for track_age_ns in [0, 50 * MS] {
        let mut scene = missed(
            &AGES_NS.map(|age_ns| (age_ns, vec![at((track_age_ns - age_ns) as f64 * 1e-9)])),
        );
        scene.track_age_ns = track_age_ns;
        scene.tracks = Some(vec![track(1, 3.0, 50.0), Track { vx: 8.0, ..track(2, 30.0, 30.0) }]);
        assert!(backed(&scene));
        scene.tracks = Some(vec![track(1, 3.0, 50.0), Track { vx: -8.0, ..track(2, 30.0, 30.0) }]);
        assert!(!backed(&scene));
    }
}

#[test]
fn an_origin_of_two_tracks_is_nobodys() {
    let here = standing_in_lists(&[detection(30.0, 30.0)]);
    let mut scene = missed(&here);
    let (near, far) = (track(3, 30.0, 28.9), track(3, 30.0, 27.4 - 1e-6));
    // The farthest that an origin may be at 800 ms is 2.6 m.
    scene.detections = Some(vec![detection(3.0, 50.1), detection(30.0, 28.9)]);
    scene.tracks = Some(vec![track(1, 3.0, 50.0), track(2, 30.0, 30.0), near]);
    assert!(!backed(&scene));
    scene.detections = Some(vec![detection(3.0, 50.1), detection(far.x, far.y)]);
    scene.tracks = Some(vec![track(1, 3.0, 50.0), track(2, 30.0, 30.0), far]);
    assert!(backed(&scene));
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

/// Stage i compares places: of a track that is 125 ms older, 1 m before its position.
#[test]
fn the_place_is_compared_with_detections() {
    for [x, y] in [[0.0, 0.0], [583_912.25, 5_361_004.5]] {
        let mut scene = scene(Profile::HARDENED, MotRemote, [x, y]);
        scene.track_age_ns = 125 * MS;
        scene.tracks = Some(vec![Track { vx: 8.0, ..track(1, x + 3.0, y + 50.0) }]);
        let mut at = |away: f64| {
            scene.detections = Some(vec![detection(x + 4.0, y + 50.0 + away)]);
            scene.rule()
        };
        assert_eq!(at(0.2 - 1e-7), None);
        assert_eq!(at(0.2 + 1e-7), Some(Rule::MeanCost));
        // As far as the farthest detection, exactly: 3-4-5, but for a place that is ahead.
        scene.tracks = Some(vec![Track { vx: 8.0, ..track(1, x + 29.0, y - 40.0) }]);
        scene.detections = Some(vec![detection(x + 50.0, y)]);
        assert_eq!(scene.rule(), Some(Rule::NoAssignment));
        scene.detections = Some(vec![detection(x + 50.0 - 1e-7, y)]);
        assert_eq!(scene.rule(), None, "beyond it");
    }
}

/// Leaving out a backed track lowers the mean; the budget counts, and what is not backed stays.
#[test]
fn the_mean_is_of_what_remains() {
    let mut scene = missed(&standing_in_lists(&[detection(30.0, 30.0)]));
    scene.detections = Some(vec![detection(3.0, 50.1), detection(30.0, 30.9)]);
    assert_eq!(scene.rule(), None);
    scene.detections = Some(vec![detection(3.0, 50.2 - 1e-7), detection(30.0, 30.9)]);
    assert_eq!(scene.rule(), None);
    scene.detections = Some(vec![detection(3.0, 50.2 + 1e-7), detection(30.0, 30.9)]);
    assert_eq!(scene.rule(), Some(Rule::MeanCost));
    scene.detections = Some(vec![detection(3.0, 50.1), detection(30.0, 30.9)]);
    scene.history.clear();
    assert_eq!(scene.rule(), Some(Rule::MeanCost));
}

/// Each track that is left out counts as the mean may be: of two backed tracks, 0.1 m and 0.9 m off,
/// and one at 0.29 m that is not backed, only the second is left out.
#[test]
fn no_more_is_left_out_than_has_to_be() {
    let mut scene = missed(&standing_in_lists(&[detection(30.0, 30.0), detection(3.0, 50.0)]));
    let third = track(3, -30.0, 30.0);
    scene.tracks = Some(vec![track(1, 3.0, 50.0), track(2, 30.0, 30.0), third]);
    let mut at = |third: f64| {
        let [first, second] = [detection(3.0, 50.1), detection(30.0, 30.9)];
        scene.detections = Some(vec![first, second, detection(-30.0, 30.0 + third)]);
        scene.rule()
    };
    assert_eq!(at(0.29), None);
    assert_eq!(at(0.31), Some(Rule::MeanCost));
}
