//! `spec/hardened/H-14.md#requirements-motions`

use mufasa_model::cycle::check;
use mufasa_model::hardened::h14_fail_safe::motions::{Motion, Named, all_motions};
use mufasa_model::input::cycle::{Cycle, DetectionList, Profile, Track};

use mufasa_model::report::{Outcome, Reading, Rule, Stage};
use mufasa_model::services::configuration::Configuration::{self, MotRemote, PlanRemote};

use super::{found, scene};
use crate::base::*;
use crate::near::*;

const HARDENED: Profile = Profile::HARDENED;

/// What was seen 250 and 500 ms ago of objects at (x, y) that drive at (vx, vy).
fn seen(objects: &[[f64; 4]]) -> Vec<DetectionList> {
    let list = |ms: i64, dt: f64| DetectionList {
        stamp_ns: NOW - ms * 1_000_000,
        items: objects.iter().map(|[x, y, vx, vy]| detection(x - vx * dt, y - vy * dt)).collect(),
    };
    vec![list(250, 0.25), list(500, 0.5)]
}

/// Detections of these objects, and their history.
fn detected(configuration: Configuration, objects: &[[f64; 4]]) -> Cycle {
    let mut cycle = base(HARDENED, configuration);
    cycle.tracks = tracks(vec![]);
    cycle.detections = detections(objects.iter().map(|[x, y, ..]| detection(*x, *y)).collect());
    cycle.detection_history = seen(objects);
    cycle
}

fn says(id: i64, [x, y, vx, vy]: [f64; 4]) -> Track {
    Track { vx, vy, ..track(id, x, y) }
}

/// Of each motion what a witness names, and w.
fn named(cycle: &Cycle) -> Vec<(Named, [f64; 2])> {
    let of = |motion: Motion| (motion.named, [motion.w.x.to_f64(), motion.w.y.to_f64()]);
    all_motions(&scene(cycle, Reading::Exact)).into_iter().map(of).collect()
}

fn of_track(id: i64) -> Named {
    Named { track: Some(id), ..Named::default() }
}

fn pair(detection: usize, item: usize, ms: i64) -> Named {
    let age_ns = Some(ms * 1_000_000);
    Named { track: None, detection: Some(detection), item: Some(item), age_ns }
}

const A: [f64; 4] = [30.0, 0.0, 8.0, 0.0];
/// F-38: a car stands, another passes it, and the remote exchanges their pasts. Both detections are explained,
/// and neither is disputed.
fn exchanged() -> Cycle {
    let mut cycle = detected(PlanRemote, &[[11.0, 0.0, 0.0, 0.0], [11.0, 2.0, 8.0, 0.0]]);
    cycle.tracks = tracks(vec![says(7, [11.0, 0.0, 8.0, -2.0]), says(8, [11.0, 2.0, 0.0, 2.0])]);
    cycle
}

/// d may stand: who stands is examined as standing, whatever its confirmed track claims; who passed has the
/// false motion alone.
/// H-14.20, SEEN-14.
#[test]
fn who_stands_with_an_exchanged_past_is_examined_as_standing() {
    let expected = [
        (of_track(7), [8.0, -2.0]),
        (of_track(8), [0.0, 2.0]),
        (pair(0, 1, 500), [8.0, -4.0]),
        (pair(1, 0, 500), [0.0, 4.0]),
        (pair(0, 0, 500), [0.0; 2]),
    ];
    assert_eq!(named(&exchanged()), expected);
    // It stands before the CAV, and nothing else is in its way. Half a second ago it was y m to the left.
    let seen_at = |y: f64| {
        let mut cycle = exchanged();
        (cycle.ego.width, cycle.parameters.safety_time) = (1.8, 0.1);
        cycle.detection_history[1].items[0].y = y;
        found(&cycle).map(|it| (it.track, it.detection, it.item, it.age_ns))
    };
    let stands = Some((None, Some(0), Some(0), Some(500_000_000)));
    assert_eq!([seen_at(0.0), seen_at(1.0)], [stands; 2]);
    assert_eq!(seen_at(1f64.next_up()), None, "farther than theta_track_max");
}

/// The list of a confirmed track, each item near its past, with 1 m + 2 m/s * 0.5 s included.
/// H-14.18, SEEN-12.
#[test]
fn items_near_the_past_of_a_confirmed_track_are_examined() {
    let with = |x: f64, reading: Reading| {
        let mut cycle = detected(MotRemote, &[A]);
        cycle.tracks = tracks(vec![says(7, A)]);
        cycle.detection_history[1].items.push(detection(x, 0.0));
        all_motions(&scene(&cycle, reading)).len()
    };
    // Its past is at 26.
    let [strict, exact, lax] = [Reading::Strict, Reading::Exact, Reading::Lax];
    assert_eq!([with(24.0, exact), with(24f64.next_down(), exact)], [3, 2]);
    let all = |x: f64| [strict, exact, lax].map(|reading| with(x, reading));
    assert_eq!(all(24.0 + 2e-6), [3; 3]);
    assert_eq!(all(24.0 + 0.5e-6), [3, 3, 2]);
    assert_eq!(all(24.0 - 0.5e-6), [3, 2, 2]);
    assert_eq!(all(24.0 - 2e-6), [2; 3]);
    // Its own origin in a list of 250 ms alone.
    let mut younger = detected(MotRemote, &[A]);
    younger.tracks = tracks(vec![says(7, A)]);
    younger.detection_history[1].items.clear();
    younger.detection_history.push(DetectionList {
        stamp_ns: NOW - 800_000_000,
        items: vec![detection(30.0 - 6.4, 0.0)],
    });
    assert_eq!(named(&younger)[1], (pair(0, 0, 250), [8.0, 0.0]));
}

/// MARGIN-12: what is too close to call of the CAV's own tracks fails stage iv of
/// the strict reading in PlanRemote, with current tracks and detections, before anything meets.
#[test]
fn own_tracks_too_close_to_call_fail_stage_iv() {
    let with = |change: fn(&mut Cycle)| {
        let mut cycle = detected(PlanRemote, &[A]);
        cycle.tracks = tracks(vec![says(7, A)]);
        cycle.detection_history[1].items[0].y = 2.0;
        change(&mut cycle);
        let strict = check(&cycle, Reading::Strict).expect("valid");
        let rule = match &strict.stages[Stage::Iv as usize] {
            Outcome::Failed(it) => Some((it.rule, it.track)),
            _ => None,
        };
        (rule, safe(&cycle))
    };
    let ambiguous = Some((Rule::Ambiguous, Some(7)));
    assert_eq!(with(|_| ()), (ambiguous, NEAR_SAFE));
    assert_eq!(with(|c| c.detection_history[1].items[0].y = 1.9), (None, YES));
    assert_eq!(with(|c| c.trajectory = None), (None, YES));
    // A nanosecond is 8 nm; with it a list is not current.
    let old: fn(&mut Cycle) = |c| {
        c.tracks.as_mut().expect("set").stamp_ns -= 1;
        c.parameters.safety_time = 0.1;
        c.parameters.max_age_ns = 1;
    };
    assert_eq!(with(old), (ambiguous, NEAR_SAFE));
    let older: fn(&mut Cycle) = |c| {
        c.tracks.as_mut().expect("set").stamp_ns -= 1;
        c.parameters.max_age_ns = 0;
    };
    assert_eq!(with(older), (None, YES));
    let blind: fn(&mut Cycle) = |c| {
        c.detections.as_mut().expect("set").stamp_ns -= 1;
        c.parameters.max_age_ns = 0;
    };
    assert_eq!(with(blind), (None, YES));
    assert_eq!(with(|c| c.parameters.work_limit = 0).0, ambiguous, "before work_limit");
    let near: fn(&mut Cycle) = |c| {
        c.parameters.safety_time = 0.0;
        let items = &mut c.tracks.as_mut().expect("set").items;
        items.push(track(8, 11.0, 0.0));
    };
    assert_eq!(with(near), (ambiguous, NO), "before what meets");
}
