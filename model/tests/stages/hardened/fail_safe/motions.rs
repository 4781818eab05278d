//! `spec/hardened/H-14.md#requirements-motions`

use mufasa_model::cycle::check;
use mufasa_model::hardened::h14_fail_safe::motions::{Motion, Named, all_motions};
use mufasa_model::input::cycle::{Cycle, Detection, DetectionList, Profile, Track};
use mufasa_model::numbers::real::Real;
use mufasa_model::report::{Outcome, Reading, Rule, Stage};
use mufasa_model::services::configuration::Configuration::{
    self, AllRemote, MotRemote, PlanRemote,
};

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

fn standing(detection: usize) -> Named {
    Named { detection: Some(detection), ..Named::default() }
}

const A: [f64; 4] = [30.0, 0.0, 8.0, 0.0];
const B: [f64; 4] = [50.0, 0.0, 4.0, 0.0];

/// H-14.22: tracks, then confirmed tracks' detections, then where a detection may stand
/// or, unexplained or disputed, may come from, then what is unexplained as standing.
#[test]
fn motions_are_in_their_order() {
    for configuration in [MotRemote, AllRemote, PlanRemote] {
        // Of the two cars the second is tracked; the first may have come from its own past alone.
        let mut cycle = detected(configuration, &[A, B]);
        cycle.parameters.v_object = 20.0;
        cycle.tracks = tracks(vec![says(7, B)]);
        let expected = [
            (of_track(7), [4.0, 0.0]),
            (pair(1, 1, 500), [4.0, 0.0]),
            (pair(0, 0, 500), [8.0, 0.0]),
            (standing(0), [0.0, 0.0]),
        ];
        assert_eq!(named(&cycle), expected, "{configuration:?}");
        cycle.tracks = tracks(vec![says(7, B), says(3, A)]);
        let expected = [
            (of_track(7), [4.0, 0.0]),
            (of_track(3), [8.0, 0.0]),
            (pair(1, 1, 500), [4.0, 0.0]),
            (pair(0, 0, 500), [8.0, 0.0]),
        ];
        assert_eq!(named(&cycle), expected, "{configuration:?}");
        // Lists that are not current are no objects, and explain nothing.
        cycle.tracks.as_mut().expect("set").stamp_ns -= 100_000_001;
        let expected = [(pair(0, 0, 500), [8.0, 0.0]), (pair(1, 1, 500), [4.0, 0.0])]
            .into_iter()
            .chain([(standing(0), [0.0, 0.0]), (standing(1), [0.0, 0.0])]);
        assert_eq!(named(&cycle), expected.collect::<Vec<_>>(), "{configuration:?}");
        cycle.detections.as_mut().expect("set").stamp_ns -= 100_000_001;
        assert_eq!(named(&cycle), [], "{configuration:?}");
    }
}

/// What a confirmed track explains is disputed where somebody else may have its past; it is examined as
/// moving, not as standing.
/// H-14.20, SEEN-17.
#[test]
fn a_disputed_detection_is_examined_as_it_moved() {
    // A car passes the place where the tracked one stands; it was there half a second ago.
    let mut cycle = detected(MotRemote, &[[20.0, 0.0, 0.0, 0.0]]);
    cycle.tracks = tracks(vec![says(7, [20.0, 0.0, 0.0, 0.0])]);
    let own = (pair(0, 0, 500), [0.0; 2]);
    assert_eq!(named(&cycle), [(of_track(7), [0.0; 2]), own, own], "it moved so, and may stand");
    cycle.detections.as_mut().expect("set").items.push(detection(24.0, 0.0));
    cycle.detection_history[0].items.push(detection(22.0, 0.0));
    let newcomer = [(pair(1, 0, 500), [8.0, 0.0]), (standing(1), [0.0; 2])];
    assert_eq!(named(&cycle), [&[(of_track(7), [0.0; 2]), own, own][..], &newcomer].concat());
    // Who drives may not stand; disputed, it may come from each item that is supported.
    let mut cycle = detected(MotRemote, &[[20.0, 0.0, 4.0, 0.0]]);
    cycle.tracks = tracks(vec![says(7, [20.0, 0.0, 4.0, 0.0])]);
    cycle.detection_history[0].items.push(detection(21.5, 0.0));
    cycle.detection_history[1].items.push(detection(23.0, 0.0));
    let own = (pair(0, 0, 500), [4.0, 0.0]);
    assert_eq!(named(&cycle), [(of_track(7), [4.0, 0.0]), own], "explained: it came from its past");
    cycle.detections.as_mut().expect("set").items.push(detection(18.5, 0.0));
    let expected = [
        (of_track(7), [4.0, 0.0]),
        own,
        own,
        (pair(0, 1, 500), [-6.0, 0.0]),
        (pair(1, 0, 500), [1.0, 0.0]),
        (pair(1, 1, 500), [-9.0, 0.0]),
        (standing(1), [0.0; 2]),
    ];
    assert_eq!(named(&cycle), expected);
}

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

/// At distance <= theta_track_max from d, each item of the reference list, not of another.
/// H-14.19, H-14.20.
#[test]
fn a_detection_may_stand_where_an_item_was() {
    let explained = |at: [f64; 2], list: usize, reading: Reading| {
        let mut cycle = detected(MotRemote, &[A]);
        cycle.tracks = tracks(vec![says(7, A)]);
        let [x, y] = at;
        cycle.detection_history[list].items.push(detection(x, y));
        all_motions(&scene(&cycle, reading)).len() == 3
    };
    let all = |at: [f64; 2]| {
        [Reading::Strict, Reading::Exact, Reading::Lax].map(|reading| explained(at, 1, reading))
    };
    // 1 m from where it is, and 3 m or more from its past.
    assert!(explained([29.0, 0.0], 1, Reading::Exact));
    assert!(!explained([29f64.next_down(), 0.0], 1, Reading::Exact));
    let apart = |e: f64| [all([29.0 + e, 0.0]), all([31.0 - e, 0.0]), all([30.0, 1.0 - e])];
    assert_eq!(apart(2e-6), [[true; 3]; 3]);
    assert_eq!(apart(0.5e-6), [[true, true, false]; 3]);
    assert_eq!(apart(-0.5e-6), [[true, false, false]; 3]);
    assert_eq!(apart(-2e-6), [[false; 3]; 3]);
    assert!(!explained([30.0, 0.0], 0, Reading::Exact), "250 ms ago");
}

/// An unexplained detection, too, whether another list supports it or not; once where it may come from there.
#[test]
fn an_unexplained_detection_may_stand_without_support() {
    let with = |x: f64, change: fn(&mut Cycle)| {
        let mut cycle = detected(MotRemote, &[A]);
        cycle.detection_history[1].items.push(detection(x, 0.0));
        change(&mut cycle);
        named(&cycle)
    };
    let own = (pair(0, 0, 500), [8.0, 0.0]);
    let stands = (standing(0), [0.0; 2]);
    // 250 ms ago the nearest was at 28 m: 2.5 m from where it would have been.
    assert_eq!(with(31.0, |_| ()), [own, (pair(0, 1, 500), [-2.0, 0.0]), stands]);
    assert_eq!(with(31f64.next_up(), |_| ()), [own, stands]);
    // Faster than v_object, too.
    assert_eq!(
        with(31.0, |c| c.parameters.v_object = 1.0),
        [(pair(0, 1, 500), [-2.0, 0.0]), stands]
    );
    let supported: fn(&mut Cycle) = |c| c.detection_history[0].items[0].x = 30.0;
    assert_eq!(with(31.0, supported), [(pair(0, 1, 500), [-2.0, 0.0]), stands]);
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

/// May come from: at most v_object dt, and supported by another list, both included; one list needs none.
/// SEEN-15, SEEN-16.
#[test]
fn a_detection_may_come_from_items_that_support_it() {
    let with = |change: &dyn Fn(&mut Cycle), reading: Reading| {
        let mut cycle = detected(MotRemote, &[A]);
        change(&mut cycle);
        all_motions(&scene(&cycle, reading)).len() == 2
    };
    let all = |change: &dyn Fn(&mut Cycle)| {
        [Reading::Strict, Reading::Exact, Reading::Lax].map(|reading| with(change, reading))
    };
    let speed = |e: f64| all(&|c| c.parameters.v_object = 8.0 + 2.0 * e);
    assert_eq!(
        [speed(0.0), speed(-0.5e-6), speed(-2e-6)],
        [[true, true, false], [true, false, false], [false; 3]]
    );
    assert_eq!([speed(0.5e-6), speed(2e-6)], [[true, true, false], [true; 3]]);
    let support = |e: f64| all(&|c| c.detection_history[0].items[0].x = 29.0 - e);
    assert_eq!(
        [support(0.0), support(-0.5e-6), support(-2e-6)],
        [[true, true, false], [true, false, false], [false; 3]].map(|it| it)
    );
    assert!(with(&|c| drop(c.detection_history.remove(0)), Reading::Exact));
    assert!(!with(&|c| c.detection_history[0].items.clear(), Reading::Exact));
}

/// H-14.24, H-14.14: times count from now, ages from
/// the stamps; r_b up to standstill.
#[test]
fn an_object_is_between_braking_and_going_on() {
    let mut cycle = detected(MotRemote, &[]);
    cycle.tracks = tracks(vec![says(7, A)]);
    cycle.tracks.as_mut().expect("set").stamp_ns -= 100_000_000;
    let motion = &all_motions(&scene(&cycle, Reading::Exact))[0];
    assert_eq!(motion.age, Real::seconds(100_000_000));
    let (a_b, r) = (Real::from_integer(8), Real::from_double);
    let braked = [0.0, 0.5, 1.0, 2.0].map(|t| motion.r_b(&a_b, &r(t)));
    assert_eq!(braked, [0.0, 3.0, 4.0, 4.0].map(r));
    // Along w, for w of any direction.
    let turned = Track { vy: 6.0, ..says(7, A) };
    cycle.tracks = tracks(vec![turned]);
    let motion = &all_motions(&scene(&cycle, Reading::Exact))[0];
    let moved = motion.moved_by(&r(5.0));
    assert_eq!((motion.speed.clone(), moved.x, moved.y), (r(10.0), r(4.0), r(3.0)));
    cycle.tracks = tracks(vec![track(7, 30.0, 0.0)]);
    let motion = &all_motions(&scene(&cycle, Reading::Exact))[0];
    assert_eq!(motion.moved_by(&Real::zero()).squared(), Real::zero());
}

/// In PlanRemote the CAV's own tracks explain: a car that drives ahead is not taken to stand, too.
/// SEEN-03.
#[test]
fn own_tracks_explain_in_plan_remote() {
    for configuration in [PlanRemote, AllRemote] {
        let ahead = [10.0, 0.0, 12.0, 0.0];
        let mut cycle = detected(configuration, &[ahead]);
        cycle.parameters.safety_time = 0.1;
        cycle.tracks = tracks(vec![says(7, ahead)]);
        assert_eq!(found(&cycle), None, "{configuration:?}");
        cycle.detection_history.clear();
        let witness = found(&cycle).expect("unexplained, it may stand");
        assert_eq!((witness.track, witness.detection, witness.item), (None, Some(0), None));
    }
}

/// F-30, F-31: a car crosses before the CAV at 7.5 m/s; it is left out, or said to stand.
/// H-14.19, H-14.21.
#[test]
fn a_crossing_car_that_the_remote_side_hides_is_seen() {
    let car = [10.0, -10.0, 0.0, 7.5];
    let turned = |d: &mut Detection| (d.cos, d.sin) = (0.0, 1.0);
    for configuration in [MotRemote, AllRemote] {
        for said in [None, Some(0.0), Some(7.5)] {
            let mut cycle = detected(configuration, &[car, [60.0, 0.0, 0.0, 0.0]]);
            cycle.detections.as_mut().expect("set").items.iter_mut().take(1).for_each(turned);
            let mut items = vec![track(2, 60.0, 0.0)];
            let told = |vy: f64| Track { cos: 0.0, sin: 1.0, vy, ..track(1, 10.0, -10.0) };
            items.extend(said.map(told));
            cycle.tracks = tracks(items);
            // Told truly it is found by its track, in AllRemote in stage iii.
            let by_track = said == Some(7.5);
            if by_track && configuration == AllRemote {
                assert_eq!(rule(&cycle, Stage::Iii), Some(Rule::Collision));
                continue;
            }
            let witness = found(&cycle).expect("it crosses");
            let by = (witness.track, witness.detection, witness.item, witness.age_ns);
            let expected = if by_track {
                (Some(1), None, None, None)
            } else {
                (None, Some(0), Some(0), Some(500_000_000))
            };
            assert_eq!(by, expected, "{configuration:?} {said:?}");
            // Without the history, and farther away than the CAV needs to stop, it is not met.
            if said.is_none() {
                cycle.detection_history.clear();
                assert_eq!(found(&cycle), None);
            }
        }
    }
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
