//! `spec/hardened/H-14.md#requirements-motions`

use mufasa_model::cycle::check;
use mufasa_model::hardened::h14_fail_safe::motions::{Motion, Named, all_motions};
use mufasa_model::hardened::h14_fail_safe::work::of_pairs;
use mufasa_model::input::cycle::{Cycle, Detection, DetectionList, Profile, Track};
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

/// F-38: a car stands, another passes it, and the remote exchanges their pasts. Both detections are explained.
fn exchanged() -> Cycle {
    let mut cycle = detected(PlanRemote, &[[11.0, 0.0, 0.0, 0.0], [11.0, 2.0, 8.0, 0.0]]);
    cycle.tracks = tracks(vec![says(7, [11.0, 0.0, 8.0, -2.0]), says(8, [11.0, 2.0, 0.0, 2.0])]);
    cycle
}

/// d may stand: who stands is examined as standing, and who passed as it was seen to, whatever their confirmed tracks
/// claim. Who stood in every list has no false motion.
/// H-14.18, H-14.20, H-14.63, SEEN-14, SEEN-17.
#[test]
fn who_has_an_exchanged_past_is_examined_as_seen() {
    let expected = [
        (of_track(7), [8.0, -2.0]),
        (of_track(8), [0.0, 2.0]),
        (pair(0, 1, 500), [8.0, -4.0]),
        (pair(1, 0, 500), [0.0, 4.0]),
        (pair(0, 0, 500), [0.0; 2]),
        (pair(1, 1, 500), [8.0, 0.0]),
    ];
    let stood = [&expected[..2], &expected[3..]].concat();
    assert_eq!(named(&exchanged()), stood);
    // The list of 250 ms ago has it elsewhere.
    let moved = || {
        let mut cycle = exchanged();
        let item = &mut cycle.detection_history[0].items[0];
        (item.x, item.y) = (11.7, 0.3);
        cycle
    };
    assert_eq!(named(&moved()), expected);
    // It stands before the CAV, and nothing else is in its way. Half a second ago it was y m to the left.
    let seen_at = |y: f64, mut cycle: Cycle| {
        (cycle.ego.width, cycle.parameters.safety_time) = (1.8, 0.1);
        cycle.detection_history[1].items[0].y = y;
        found(&cycle).map(|it| (it.track, it.detection, it.item, it.age_ns))
    };
    let stands = Some((None, Some(0), Some(0), Some(500_000_000)));
    assert_eq!([seen_at(0.0, exchanged()), seen_at(1.0, moved())], [stands; 2]);
    let farther = 1f64.next_up();
    assert_eq!(seen_at(farther, moved()), None, "farther than theta_track_max");
    assert_eq!(seen_at(farther, exchanged()), stands, "and seen to come from there");
}

/// A car drives at 8 m/s, and there was something beside it 250, 500 and 750 ms ago. A false track says that it came
/// from there, and stands.
fn followed() -> Cycle {
    let list = |ms: i64, items: &[[f64; 2]]| DetectionList {
        stamp_ns: NOW - ms * 1_000_000,
        items: items.iter().map(|[x, y]| detection(*x, *y)).collect(),
    };
    let mut cycle = detected(PlanRemote, &[A]);
    cycle.detection_history = vec![
        list(250, &[[28.0, 0.0], [30.0, 1.0]]),
        list(500, &[[26.0, 0.0], [30.0, 1.5]]),
        list(750, &[[24.0, 0.0]]),
    ];
    cycle.tracks = tracks(vec![says(7, [30.0, 0.0, 0.0, 0.0])]);
    cycle
}

/// H-14.20: of an explained detection what every list shows is examined, whatever the track says; of an unexplained one
/// what one list supports.
#[test]
fn an_explained_detection_is_examined_as_every_list_shows() {
    let with = |change: fn(&mut Cycle)| {
        let mut cycle = followed();
        change(&mut cycle);
        let of = |cycle: &Cycle| named(cycle).into_iter().map(|(name, _)| name).collect::<Vec<_>>();
        let explained = of(&cycle);
        cycle.tracks = tracks(vec![]);
        (explained, of(&cycle))
    };
    let standing = Named { detection: Some(0), ..Named::default() };
    let [from_there, beside] = [pair(0, 0, 500), pair(0, 1, 500)];
    let believed = vec![of_track(7), beside];
    let of_unexplained = vec![from_there, beside, standing];
    let seen = (vec![of_track(7), beside, from_there], of_unexplained.clone());
    let hidden = (believed.clone(), of_unexplained);
    assert_eq!(with(|_| ()), seen);
    assert_eq!(with(|c| c.detection_history[2].items.clear()), hidden);
    // 0.3 m and theta_track_max, and as much as tyres let it be off.
    assert_eq!(with(|c| c.detection_history[0].items[0].y = -0.65), seen);
    assert_eq!(with(|c| c.detection_history[0].items[0].y = -0.67), hidden);
    assert_eq!(with(|c| c.detection_history[2].items[0].y = -1.37), seen);
    assert_eq!(with(|c| c.detection_history[2].items[0].y = -1.39), hidden);
    // Faster than v_object it is not looked for.
    assert_eq!(with(|c| c.parameters.v_object = 8.0), seen);
    let slower = (believed, vec![beside, standing]);
    assert_eq!(with(|c| c.parameters.v_object = 8f64.next_down()), slower);
}

/// With the item that is near the past of its track, and that it was seen to come from, too, a detection is examined
/// once. With an item that is not near that past it still is. Items of another list are others: two tracks that have one
/// past of 500 ms ago have the list of 250 ms ago.
/// H-14.19.
#[test]
fn a_pair_is_examined_once() {
    let items = |cycle: &Cycle| {
        let motions = named(cycle).into_iter().filter(|(it, _)| it.item.is_some());
        motions.map(|(it, _)| it).collect::<Vec<_>>()
    };
    let mut cycle = detected(MotRemote, &[A]);
    cycle.tracks = tracks(vec![says(7, A)]);
    assert_eq!(items(&cycle), [pair(0, 0, 500)]);
    cycle.detection_history[1].items.push(detection(30.0, 0.0));
    assert_eq!(items(&cycle), [pair(0, 0, 500), pair(0, 1, 500)]);
    let b = [30.5, 0.0, 8.0, 0.0];
    let mut shared = detected(MotRemote, &[A, b]);
    shared.tracks = tracks(vec![says(7, A), says(8, b)]);
    shared.detection_history[1].items.pop();
    let items_800 = vec![detection(23.6, 0.0), detection(24.1, 0.0)];
    shared.detection_history.push(DetectionList { stamp_ns: NOW - 800_000_000, items: items_800 });
    let of_tracks = [[0, 0], [0, 1], [1, 0], [1, 1]].map(|[d, item]| pair(d, item, 250));
    assert_eq!(items(&shared), [&of_tracks[..], &[pair(0, 0, 500), pair(1, 0, 500)]].concat());
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

/// A person at (x, y).
fn person(x: f64, y: f64) -> Detection {
    Detection { length: 0.5, width: 0.5, ..detection(x, y) }
}

/// Persons at (8, y), of whom no track tells, and where they were 250 and 500 ms ago.
fn persons(now: &[f64], seen: [&[f64]; 2]) -> Cycle {
    let at = |ys: &[f64]| ys.iter().map(|y| person(8.0, *y)).collect();
    let list =
        |(ms, ys): (i64, &[f64])| DetectionList { stamp_ns: NOW - ms * 1_000_000, items: at(ys) };
    let mut cycle = base(HARDENED, PlanRemote);
    (cycle.tracks, cycle.detections) = (tracks(vec![]), detections(at(now)));
    cycle.detection_history = [250, 500].into_iter().zip(seen).map(list).collect();
    cycle
}

/// H-14.63: of two persons who stand 1.9 m from each other neither comes from where the other one stands. Who moved may
/// come from there.
#[test]
fn who_stood_did_not_come_from_elsewhere() {
    let standing = |d: usize| Named { detection: Some(d), ..Named::default() };
    let (first, second) = ((standing(0), [0.0; 2]), (standing(1), [0.0; 2]));
    let stood = persons(&[0.0, 1.875], [&[0.0, 1.875]; 2]);
    let own = [0, 1].map(|i| (pair(i, i, 500), [0.0; 2]));
    assert_eq!(named(&stood), [own[0], own[1], first, second]);
    let moved = persons(&[0.0, 1.875], [&[0.0, 2.125], &[0.0, 2.375]]);
    let of_moved = [(pair(1, 0, 500), [0.0, 3.75]), (pair(1, 1, 500), [0.0, -1.0])];
    assert_eq!(named(&moved), [own[0], of_moved[0], of_moved[1], first, second]);
    let mut once = stood.clone();
    once.detection_history.remove(0);
    assert_eq!(named(&once).len(), 6, "one usable list says nothing");
}

/// H-14.63, MARGIN-01: how many motions, strict, exact, lax, of a person at 0.
#[test]
fn margins_move_the_items_of_who_stood() {
    let count = |seen: [&[f64]; 2]| {
        let cycle = persons(&[0.0], seen);
        [Reading::Strict, Reading::Exact, Reading::Lax]
            .map(|reading| all_motions(&scene(&cycle, reading)).len())
    };
    // Another item of the reference list at <= 0.3 m + m.
    let item = |y: f64| count([&[-0.2], &[0.0, y]]);
    assert_eq!([item(0.3 - 2e-6), item(0.3 - 0.5e-6), item(0.3)], [[3; 3], [3, 3, 2], [3, 3, 2]]);
    assert_eq!(item(0.3f64.next_up()), [3, 2, 2]);
    assert_eq!([item(0.3 + 0.5e-6), item(0.3 + 2e-6)], [[3, 2, 2], [2; 3]]);
    // Where the person did not stand, for the other list, an item at 0.9 m is another one.
    let stood = |y: f64| count([&[-y], &[0.0, 0.9]]);
    assert_eq!([stood(0.3 - 2e-6), stood(0.3 - 0.5e-6)], [[2; 3], [3, 2, 2]]);
    assert_eq!([stood(0.3 + 0.5e-6), stood(0.3 + 2e-6)], [[3, 3, 2], [3; 3]]);
    // SEEN-19: from 0.75 m it came evenly where the other list has an item at 0.375 m, by <= 0.3 m + m.
    let even = |e: f64| count([&[0.0, 0.675 + e], &[0.0, 0.75]]);
    assert_eq!([even(-2e-6), even(-0.5e-6)], [[3; 3], [3, 3, 2]]);
    assert_eq!([even(0.5e-6), even(2e-6)], [[3, 2, 2], [2; 3]]);
    // What H-14.20 does not take is not taken at 0.3 m.
    let mut near = detected(PlanRemote, &[[30.0, 0.0, 0.0, 0.0]]);
    near.tracks = tracks(vec![says(7, [30.0, 0.0, 0.0, 0.0])]);
    (near.parameters.theta_track_max, near.parameters.theta_velocity) = (0.125, 0.125);
    near.parameters.v_object = 0.25;
    near.detection_history[1].items.push(detection(30.0, 0.25));
    assert_eq!(named(&near), [of_track(7), pair(0, 0, 500)].map(|it| (it, [0.0; 2])));
}

/// H-14.63: a person beside the path who stood has not come from another one, nor from an item farther than 0.3 m.
#[test]
fn margins_move_who_is_met() {
    margins_move(&[
        ("d stood: d' <= 0.3 m - m", PlanRemote, HARDENED, |c, e| {
            let seen: [&[f64]; 2] = [&[1.8 + 0.3 + e, 3.7], &[1.8, 3.7]];
            *c = persons(&[1.8, 3.7], seen);
        }),
        ("d' <= 0.3 m + m", PlanRemote, HARDENED, |c, e| {
            *c = persons(&[1.8], [&[1.6], &[1.8, 1.8 + 0.3 - e]]);
        }),
    ]);
}

/// H-14.51: with U = 2, and with three items more that are far from the detection, U = 5.
#[test]
fn work_of_pairs_is_that_of_the_text() {
    let with = |tracks: Vec<Track>, far: usize, detections: usize| {
        let mut cycle = detected(PlanRemote, &[[30.0, 0.0, 0.0, 0.0]]);
        cycle.tracks = self::tracks(tracks);
        cycle.detection_history[0].items.extend(vec![detection(900.0, 0.0); far]);
        let items = &mut cycle.detections.as_mut().expect("set").items;
        items.extend(vec![detection(-900.0, 0.0); detections]);
        of_pairs(&scene(&cycle, Reading::Strict))
    };
    assert_eq!(with(vec![], 0, 0), (240 + 2 * 2) + 2 * 2);
    assert_eq!(with(vec![], 3, 0), (240 + 2 * 5) + 2 * 5);
    assert_eq!(with(vec![], 3, 2), (240 + 2 * 5) + 3 * 2 * 5, "three detections");
    let explained = says(7, [30.0, 0.0, 0.0, 0.0]);
    assert_eq!(with(vec![explained], 3, 0), (240 + 2 * 5) + 2 * 5 + (176 + 5));
    // The detection stood: only one of the two items of 500 ms ago is taken.
    let mut stood = persons(&[1.8], [&[1.8], &[1.8, 3.3]]);
    stood.tracks = tracks(vec![says(7, [8.0, 1.8, 0.0, 0.0])]);
    let motions = all_motions(&scene(&stood, Reading::Exact));
    assert_eq!(motions.iter().filter(|motion| motion.named.item.is_some()).count(), 1);
    let work = of_pairs(&scene(&stood, Reading::Strict));
    assert_eq!(work, 2 * (240 + 2 * 3) + 2 * 3 + 2 * (176 + 3));
}
