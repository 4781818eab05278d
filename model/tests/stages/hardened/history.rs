//! `spec/hardened/what-the-cav-saw.md`: each term at its bound and on both sides of it, and what
//! is too close to call.

use mufasa_model::cycle::check;
use mufasa_model::hardened::detection_history::{
    Seen, Usable, has_stood, may_come_from, moved_evenly, seen, shown_within, supports_within,
    usable, was_seen_to_come_from,
};
use mufasa_model::input::cycle::{Cycle, Detection, DetectionList, Profile, Track};
use mufasa_model::input::scene::{Object, Scene};
use mufasa_model::numbers::real::Real;
use mufasa_model::report::{Reading, Rule, Stage};
use mufasa_model::services::configuration::Configuration::{MotRemote, PlanRemote};

use crate::base::*;
use crate::near::*;

/// Stage i alone, with these tracks and detections, and lists of these ages in ms.
fn cycle(items: Vec<Track>, seen: Vec<Detection>, lists: &[(i64, Vec<Detection>)]) -> Cycle {
    let mut cycle = base(Profile::HARDENED, MotRemote);
    cycle.trajectory = None;
    cycle.tracks = tracks(items);
    cycle.detections = detections(seen);
    cycle.detection_history = (lists.iter())
        .map(|(ms, items)| DetectionList { stamp_ns: NOW - ms * 1_000_000, items: items.clone() })
        .collect();
    cycle
}

fn scene(cycle: &Cycle) -> Scene {
    Scene::new(cycle, Reading::Exact)
}

/// What the CAV saw of the tracks of a cycle.
fn all_seen(cycle: &Cycle) -> Vec<Seen> {
    let scene = scene(cycle);
    seen(&scene, scene.tracks.as_ref().expect("there are tracks"))
}

/// Strict fails stage i because something is too close to call; the others do not ask.
fn is_ambiguous(cycle: &Cycle) -> bool {
    let rule = |reading| {
        let report = check(cycle, reading).expect("valid");
        match &report.stages[Stage::I as usize] {
            mufasa_model::report::Outcome::Failed(witness) => Some(witness.rule),
            _ => None,
        }
    };
    assert_ne!(rule(Reading::Exact), Some(Rule::Ambiguous));
    assert_ne!(rule(Reading::Lax), Some(Rule::Ambiguous));
    rule(Reading::Strict) == Some(Rule::Ambiguous)
}

/// A car at (20, 0) that drives at (8, 0), seen 250, 500 and 750 ms ago, of which `lists` are kept.
fn driving(lists: &[i64]) -> Cycle {
    let then = |ms: i64| 20.0 - 8.0 * f64::from(i32::try_from(ms).expect("small")) / 1000.0;
    let lists: Vec<_> = lists.iter().map(|ms| (*ms, vec![detection(then(*ms), 0.0)])).collect();
    let track = Track { vx: 8.0, ..track(1, 20.0, 0.0) };
    cycle(vec![track], vec![detection(20.0, 0.0), detection(60.0, 0.0)], &lists)
}

/// Backed: own origins in two usable lists, each at distance <= 1 + 2 dt.
/// SEEN-05, SEEN-06, SEEN-08.
#[test]
fn a_track_is_backed_by_its_own_origins_in_two_lists() {
    let is_backed = |cycle: &Cycle| all_seen(cycle)[0].is_backed;
    assert!(is_backed(&driving(&[250, 500])));
    assert!(is_backed(&driving(&[250, 500, 750])));
    assert!(!is_backed(&driving(&[500])));
    // 500 ms: 2 m, and that is included.
    let moved = |y: f64| {
        let mut cycle = driving(&[250, 500]);
        cycle.detection_history[1].items[0].y = y;
        cycle
    };
    assert!(is_backed(&moved(2.0)));
    assert!(!is_backed(&moved(2.0f64.next_up())));
    // 1000 ms: 3 m.
    let mut oldest = driving(&[250, 1000]);
    oldest.detection_history[1].items[0].y = 3.0;
    assert!(is_backed(&oldest));
    oldest.detection_history[1].items[0].y = 3.0f64.next_up();
    assert!(!is_backed(&oldest));
    for (y, expected) in [(2.0 - 3e-6, false), (2.0 - 0.9e-6, true), (2.0 + 0.9e-6, true)] {
        assert_eq!(is_ambiguous(&moved(y)), expected, "{y}");
    }
    assert!(!is_ambiguous(&moved(2.0 + 3e-6)));
}

/// The detection of a track is nearer than theta_track_max, and a confirmed one has it for itself.
/// SEEN-04, SEEN-09, SEEN-10.
#[test]
fn a_confirmed_track_has_a_detection_of_its_own() {
    let with = |y: f64| {
        let mut cycle = driving(&[250, 500]);
        cycle.detections.as_mut().expect("set").items[0].y = y;
        cycle
    };
    let near = &all_seen(&with(1.0f64.next_down()))[0];
    assert_eq!((near.detection, near.is_confirmed), (Some(0), true));
    let far = &all_seen(&with(1.0))[0];
    assert_eq!((far.detection, far.is_backed, far.is_confirmed), (None, true, false));
    assert!(is_ambiguous(&with(1.0 - 0.9e-6)) && is_ambiguous(&with(1.0 + 0.9e-6)));
    assert!(!is_ambiguous(&with(1.0 - 1.1e-6)) && !is_ambiguous(&with(1.0 + 1.1e-6)));
    // Its place is that of now, 1 m on.
    let mut older = with(1.0f64.next_down());
    let list = older.tracks.as_mut().expect("set");
    (list.stamp_ns, list.items[0].x) = (list.stamp_ns - 125_000_000, 19.0);
    assert_eq!(all_seen(&older)[0].detection, Some(0));
    // Another track with the same detection.
    let mut two = with(0.0);
    two.tracks.as_mut().expect("set").items.push(track(2, 20.0, 0.5));
    let of_two = all_seen(&two);
    assert_eq!(of_two.iter().map(|it| it.detection).collect::<Vec<_>>(), [Some(0), Some(0)]);
    assert!(of_two[0].is_backed && !of_two[0].is_confirmed);
}

/// abs(v x direction) <= 2 + 8 / 10 for what is longer than 1 m; directions as given.
/// SEEN-11.
#[test]
fn a_confirmed_track_moves_along_its_detection() {
    let with = |sideways: f64, length: f64| {
        let mut cycle = driving(&[250, 500]);
        let seen = &mut cycle.detections.as_mut().expect("set").items[0];
        let sin = sideways / 8.0;
        (seen.cos, seen.sin, seen.length) = ((1.0 - sin * sin).sqrt(), sin, length);
        cycle
    };
    let is_confirmed =
        |sideways: f64, length: f64| all_seen(&with(sideways, length))[0].is_confirmed;
    assert!(is_confirmed(2.8 - 1e-9, 4.0) && !is_confirmed(2.8 + 1e-9, 4.0));
    assert!(is_confirmed(-2.8 + 1e-9, 4.0) && !is_confirmed(-2.8 - 1e-9, 4.0));
    assert!(is_confirmed(7.9, 1.0) && !is_confirmed(7.9, 1.0f64.next_up()));
    assert!(is_ambiguous(&with(2.8 - 0.9e-6, 4.0)) && is_ambiguous(&with(2.8 + 0.9e-6, 4.0)));
    assert!(!is_ambiguous(&with(2.8 - 1.1e-6, 4.0)) && !is_ambiguous(&with(2.8 + 1.1e-6, 4.0)));
    assert!(!is_ambiguous(&with(2.8, 1.0)), "not asked");
    // Not asked of a track that is not backed, either.
    let mut unbacked = with(2.8, 4.0);
    unbacked.detection_history.remove(0);
    assert!(!is_ambiguous(&unbacked));
}

/// The bound is included: abs((5, 0) x (cos, 0.75)) = 3.75 = theta_velocity + 5 / 10.
#[test]
fn the_bound_of_sideways_motion_is_included() {
    let mut cycle = driving(&[250, 500]);
    cycle.tracks.as_mut().expect("set").items[0].vx = 5.0;
    for (ms, list) in [250.0, 500.0].iter().zip(&mut cycle.detection_history) {
        list.items[0].x = 20.0 - 5.0 * ms / 1000.0;
    }
    let seen = &mut cycle.detections.as_mut().expect("set").items[0];
    (seen.cos, seen.sin) = (0.661_437_827_8, 0.75);
    cycle.parameters.theta_velocity = 3.25;
    assert!(all_seen(&cycle)[0].is_confirmed);
    cycle.parameters.theta_velocity = 3.25f64.next_down();
    assert!(!all_seen(&cycle)[0].is_confirmed);
}

/// MARGIN-10: what is exactly delta from its bound is too close to call.
#[test]
fn a_speed_exactly_delta_above_v_object_is_ambiguous() {
    let with = |vx: f64| {
        let mut cycle = driving(&[250, 500]);
        cycle.parameters.delta = 1.0 / 1024.0;
        cycle.tracks.as_mut().expect("set").items[0].vx = vx;
        cycle
    };
    let bound = with(0.0).parameters.v_object;
    let [above, below] = [bound + 1.0 / 1024.0, bound - 1.0 / 1024.0];
    assert!(is_ambiguous(&with(above)) && is_ambiguous(&with(below)));
    assert!(!is_ambiguous(&with(above.next_up())) && !is_ambiguous(&with(below.next_down())));
}

/// MARGIN-10, MARGIN-11: the strict reading asks only when stage i runs, and of every received track.
#[test]
fn ambiguity_fails_stage_i_and_no_other() {
    let mut cycle = driving(&[250, 500]);
    cycle.detection_history[1].items[0].y = 2.0;
    assert!(is_ambiguous(&cycle));
    let mut local = cycle.clone();
    local.configuration = PlanRemote;
    assert_eq!(safe(&local), YES, "no trajectory, no H-14");
    let mut blind = cycle.clone();
    blind.detections = None;
    assert_eq!(safe(&blind), YES);
    // Far outside the field of view.
    let items = &mut cycle.tracks.as_mut().expect("set").items;
    items[0].x += 1000.0;
    cycle.detection_history.iter_mut().for_each(|list| list.items[0].x += 1000.0);
    assert!(is_ambiguous(&cycle));
    assert_eq!(safe(&cycle), NEAR_SAFE);
}

/// A detection at (20, 0), and items at (20, y) in lists of these ages in ms.
fn one(lists: &[(i64, &[f64])]) -> Cycle {
    let items = |ys: &[f64]| ys.iter().map(|y| detection(20.0, *y)).collect();
    let lists: Vec<_> = lists.iter().map(|(ms, ys)| (*ms, items(ys))).collect();
    cycle(vec![], vec![detection(20.0, 0.0)], &lists)
}

/// What holds of the detection: strict, exact, lax.
fn holds(cycle: &Cycle, of: impl Fn(&Scene, &[Usable], &Object) -> bool) -> [bool; 3] {
    [Reading::Strict, Reading::Exact, Reading::Lax].map(|reading| {
        let scene = Scene::new(cycle, reading);
        of(&scene, &usable(&scene), &scene.detections.as_ref().expect("set").items[0])
    })
}

/// Whether it stood.
fn stood(lists: &[(i64, &[f64])]) -> [bool; 3] {
    holds(&one(lists), has_stood)
}

/// The first item of the list of 500 ms.
fn of_half_a_second(lists: &[Usable]) -> [usize; 2] {
    [lists.iter().position(|list| list.age_ns == 500_000_000).expect("there is one"), 0]
}

/// Whether it was seen to come from the first item of 500 ms ago.
fn came(cycle: &Cycle) -> [bool; 3] {
    holds(cycle, |scene, lists, d| was_seen_to_come_from(scene, lists, d, of_half_a_second(lists)))
}

/// Whether it may come from there.
fn may_come(cycle: &Cycle) -> [bool; 3] {
    holds(cycle, |scene, lists, d| may_come_from(scene, lists, d, of_half_a_second(lists)))
}

/// SEEN-18: in each of two usable lists or more.
#[test]
fn what_is_where_it_was_in_every_usable_list_has_stood() {
    assert_eq!(stood(&[(250, &[0.1]), (500, &[9.0, -0.2])]), YES);
    assert_eq!(stood(&[(250, &[0.0]), (500, &[0.0]), (750, &[0.0])]), YES);
    assert_eq!(stood(&[(250, &[0.0]), (500, &[0.0]), (750, &[0.4])]), NO, "it came");
    assert_eq!(stood(&[(250, &[0.4]), (500, &[0.0]), (750, &[0.0])]), NO);
    assert_eq!(stood(&[(250, &[0.0]), (500, &[])]), NO, "not seen");
    // One usable list, or none, says nothing; one that is not usable is not asked.
    assert_eq!(stood(&[(500, &[0.0])]), NO);
    assert_eq!(stood(&[(100, &[0.0]), (500, &[0.0]), (1001, &[0.0])]), NO);
    assert_eq!(stood(&[]), NO);
    assert_eq!(stood(&[(100, &[0.4]), (250, &[0.0]), (500, &[0.0])]), YES);
}

/// SEEN-18, MARGIN-01: 0.3 m is included, and <= 0.3 m - m.
#[test]
fn margins_move_what_stood() {
    for side in [1.0, -1.0] {
        let at = |y: f64| stood(&[(250, &[0.0]), (500, &[side * y])]);
        assert_eq!([at(0.3 - 2e-6), at(0.3 - 0.5e-6), at(0.3)], [YES, NEAR_SAFE, NEAR_SAFE]);
        assert_eq!(at(0.3f64.next_up()), NEAR_UNSAFE);
        assert_eq!([at(0.3 + 0.5e-6), at(0.3 + 2e-6)], [NEAR_UNSAFE, NO]);
    }
}

/// SEEN-19: a person walks by something that stands, and was seen in each list; with a step to the side, or unseen, it
/// was not.
#[test]
fn who_was_seen_to_move_in_every_list_moved_evenly() {
    let in_lists = |at_250: &[f64], at_750: &[f64]| {
        let items = |ys: &[f64]| ys.iter().map(|y| detection(20.0, *y)).collect::<Vec<_>>();
        let lists = [(250, items(at_250)), (500, items(&[0.0, 1.0])), (750, items(at_750))];
        let cycle = cycle(vec![], vec![detection(20.0, 0.0)], &lists);
        let scene = Scene::new(&cycle, Reading::Exact);
        let d = &scene.detections.as_ref().expect("set").items[0];
        [0, 1].map(|item| moved_evenly(&scene, &usable(&scene), d, [1, item]))
    };
    let evenly = |at_250: &[f64]| in_lists(at_250, &[0.0, 1.5]);
    assert_eq!(evenly(&[0.0, 0.5]), [true, true]);
    assert_eq!(evenly(&[0.0, 0.9]), [true, false]);
    assert_eq!(evenly(&[0.0]), [true, false]);
    assert_eq!(evenly(&[]), [false, false]);
    assert_eq!(in_lists(&[0.0, 0.5], &[0.0]), [true, false], "not before");
    let alone = |lists: &[(i64, Vec<Detection>)]| {
        let cycle = cycle(vec![], vec![detection(20.0, 0.0)], lists);
        let scene = Scene::new(&cycle, Reading::Exact);
        moved_evenly(
            &scene,
            &usable(&scene),
            &scene.detections.as_ref().expect("set").items[0],
            [0, 0],
        )
    };
    assert!(alone(&[(500, vec![detection(20.0, 9.0)])]), "no other list");
}

/// Within the margin of what is examined: strict and exact, strict alone.
const EXAMINED: [bool; 3] = [true, true, false];
const STRICTLY: [bool; 3] = [true, false, false];

/// SEEN-17: each other usable list shows it; for "may come from" one is enough.
#[test]
fn what_came_from_an_item_was_seen_in_every_list() {
    let both = |lists: &[(i64, &[f64])]| [came(&one(lists)), may_come(&one(lists))];
    assert_eq!(both(&[(250, &[0.5]), (500, &[1.0]), (750, &[1.5])]), [YES; 2]);
    assert_eq!(both(&[(250, &[9.0, 0.5]), (500, &[1.0, 9.0]), (750, &[1.5, 9.0])]), [YES; 2]);
    assert_eq!(both(&[(250, &[0.5]), (500, &[1.0]), (750, &[9.0])]), [NO, YES]);
    assert_eq!(both(&[(250, &[]), (500, &[1.0]), (750, &[1.5])]), [NO, YES]);
    assert_eq!(both(&[(250, &[9.0]), (500, &[1.0]), (750, &[])]), [NO; 2]);
    // Without other usable lists the distance decides.
    assert_eq!(both(&[(500, &[34.0])]), [YES; 2]);
    assert_eq!(both(&[(100, &[9.0]), (500, &[34.0]), (1001, &[])]), [YES; 2]);
}

/// SEEN-17, MARGIN-01: abs(d - d') <= v_object dt + m.
#[test]
fn what_came_from_an_item_is_no_faster_than_v_object() {
    let from = |y: f64, v_object: f64| {
        let mut cycle = one(&[(250, &[y / 2.0]), (500, &[y])]);
        cycle.parameters.v_object = v_object;
        came(&cycle)
    };
    for side in [1.0, -1.0] {
        let at = |e: f64| from(side * (4.0 + e), 8.0);
        assert_eq!([at(-2e-6), at(-0.5e-6), at(0.0)], [YES, EXAMINED, EXAMINED]);
        assert_eq!([at(0.5e-6), at(2e-6)], [STRICTLY, NO]);
    }
    assert_eq!(from(4.0, 8f64.next_down()), STRICTLY);
}

/// SEEN-17, MARGIN-01: each other list has an item at distance <= 0.3 m + a_tyre dt' abs(dt' - dt)/2 + m. With a_tyre =
/// 11.5 m/s^2 this is 0.659375 m 250 ms ago and 1.378125 m 750 ms ago, from 0.359375 m and 1.078125 m on the other side.
#[test]
fn margins_move_what_was_seen_to_come() {
    let from =
        |of_250: f64, of_750: f64| one(&[(250, &[of_250]), (500, &[-0.71875]), (750, &[of_750])]);
    let younger = |y: f64| came(&from(y, 0.0));
    let older = |y: f64| came(&from(0.0, y));
    for at in [&younger as &dyn Fn(f64) -> [bool; 3], &older] {
        assert_eq!([at(0.3 - 2e-6), at(0.3 - 0.5e-6), at(0.3)], [YES, EXAMINED, EXAMINED]);
        assert_eq!(at(0.3f64.next_up()), STRICTLY);
        assert_eq!([at(0.3 + 0.5e-6), at(0.3 + 2e-6)], [STRICTLY, NO]);
    }
    // With theta_track_max = 1 m an item farther away supports it.
    assert_eq!([came(&from(0.9, 0.9)), may_come(&from(0.9, 0.9))], [NO, YES]);
    // Who brakes harder than 11.5 m/s^2 is looked for farther away.
    let mut hard = from(0.5, 0.5);
    assert_eq!(came(&hard), NO);
    hard.parameters.a_b = 20.0;
    assert_eq!(came(&hard), YES);
}

/// SEEN-16, SEEN-17: a_tyre dt' abs(dt' - dt)/2 and 0.3 m or theta_track_max.
#[test]
fn the_radii_around_where_it_was_are_those_of_the_text() {
    let scene = scene(&one(&[]));
    let s = Real::from_double;
    for (dt, other, off) in [(0.5, 0.25, 0.359_375), (0.5, 0.75, 1.078_125), (0.25, 0.5, 0.718_75)]
    {
        assert_eq!(shown_within(&scene, &s(dt), &s(other)), s(0.3) + s(off));
        assert_eq!(supports_within(&scene, &s(dt), &s(other)), s(1.0) + s(off));
    }
}
