//! H-13: which motions are examined, how far along the trajectory, and what the witness names.

use mufasa_model::input::cycle::{Cycle, Detection, DetectionList, Profile, Track};
use mufasa_model::report::{Outcome, Rule, Stage, Witness};
use mufasa_model::services::configuration::Configuration::{AllRemote, MotRemote, PlanRemote};

use crate::base::*;
use crate::near::*;

const HARDENED: Profile = Profile::Hardened;

/// Looks along y.
fn crossing(x: f64, y: f64) -> Detection {
    Detection { cos: 0.0, sin: 1.0, ..detection(x, y) }
}

fn list(millis: i64, items: &[[f64; 2]]) -> DetectionList {
    let items = items.iter().map(|[x, y]| crossing(*x, *y)).collect();
    DetectionList { stamp_ns: NOW - millis * 1_000_000, items }
}

/// Detections alone, and the lists of 250 and 500 ms ago.
fn alone(cycle: &mut Cycle, seen: &[[f64; 2]], young: &[[f64; 2]], reference: &[[f64; 2]]) {
    (cycle.tracks, cycle.grid) = (None, None);
    cycle.detections = detections(seen.iter().map(|[x, y]| crossing(*x, *y)).collect());
    cycle.detection_history = vec![list(250, young), list(500, reference)];
}

/// What stage iv finds with detections alone.
fn found(seen: &[[f64; 2]], young: &[[f64; 2]], reference: &[[f64; 2]]) -> Option<Witness> {
    let mut cycle = base(HARDENED, PlanRemote);
    alone(&mut cycle, seen, young, reference);
    moving(&cycle)
}

fn moving(cycle: &Cycle) -> Option<Witness> {
    match outcome(cycle, Stage::Iv) {
        Outcome::Failed(witness) => {
            assert_eq!(witness.rule, Rule::CollisionMoving);
            Some(witness)
        }
        _ => None,
    }
}

/// A car at (10, -9) that says that it drives at 4 m/s, as it does, and is not met; an item of the
/// reference list at (10, y) beside its own origin.
fn tracked(cycle: &mut Cycle, y: f64) {
    alone(cycle, &[[10.0, -9.0], [60.0, 0.0]], &[[10.0, -10.0]], &[[10.0, -11.0], [10.0, y]]);
    cycle.configuration = MotRemote;
    let says = Track { cos: 0.0, sin: 1.0, vy: 4.0, ..track(1, 10.0, -9.0) };
    cycle.tracks = tracks(vec![says, track(2, 60.0, 0.0)]);
}

const NEAR: &[Near] = &[
    ("(b) abs(d - d') <= v_object dt + m", PlanRemote, HARDENED, |c, e| {
        alone(c, &[[10.0, -8.0]], &[[10.0, -10.0]], &[[10.0, -12.0]]);
        c.parameters.v_object = 8.0 + 2.0 * e;
    }),
    ("(b) support at distance <= theta_track_max + m", PlanRemote, HARDENED, |c, e| {
        alone(c, &[[10.0, -8.0]], &[[11.0 - e, -10.0]], &[[10.0, -12.0]]);
    }),
    ("(a) distance <= theta_track_max + theta_velocity dt + m", MotRemote, HARDENED, |c, e| {
        tracked(c, -13.0 + e);
    }),
    ("way <= (1 + 1e-6) (s_stop + tau_motion v_now) + m", PlanRemote, HARDENED, |c, e| {
        // s_stop = 6.25; the car is met at the point after the one 10.00001 m along.
        (c.parameters.tau, c.parameters.tau_motion) = (0.0, 0.375);
        points(c)[10].x = 10.000_01 - e;
        alone(c, &[[13.9, -8.8]], &[[13.9, -10.8]], &[[13.9, -12.8]]);
    }),
];

#[test]
fn margins_move_what_is_examined_as_moving() {
    margins_move(NEAR);
    for (name, configuration, profile, with) in NEAR {
        let mut cycle = base(*profile, *configuration);
        with(&mut cycle, 3e-6);
        assert!(moving(&cycle).is_some(), "{name}");
    }
}

#[test]
fn the_filter_changes_no_report_of_motion() {
    the_filter_changes_nothing(NEAR);
}

/// The bounds are included.
#[test]
fn what_is_on_the_bound_is_examined() {
    let v_object = |v_object: f64| {
        let mut cycle = base(HARDENED, PlanRemote);
        alone(&mut cycle, &[[10.0, -8.0]], &[[10.0, -10.0]], &[[10.0, -12.0]]);
        cycle.parameters.v_object = v_object;
        moving(&cycle).is_some()
    };
    assert!(v_object(8.0) && !v_object(8.0f64.next_down()));
    let support = |x: f64| found(&[[10.0, -8.0]], &[[x, -10.0]], &[[10.0, -12.0]]).is_some();
    assert!(support(11.0) && !support(11.0f64.next_up()));
    let of_track = |y: f64| {
        let mut cycle = base(HARDENED, MotRemote);
        tracked(&mut cycle, y);
        moving(&cycle).is_some()
    };
    assert!(of_track(-13.0) && !of_track((-13.0f64).next_down()));
}

/// Point, detection, item and age of its list; the point comes first, then the detections, then items.
#[test]
fn the_witness_is_the_first() {
    let seen = found(&[[10.0, -8.0]], &[[10.0, -10.0]], &[[90.0, 0.0], [10.0, -12.0]]);
    let witness = seen.expect("it crosses");
    // At 0.7 s the CAV ends at 9, where the car begins, which reaches from -4.4 to -0.4.
    assert_eq!((witness.point, witness.detection, witness.item), (Some(7), Some(0), Some(1)));
    assert_eq!((witness.age_ns, witness.track), (Some(500_000_000), None));
    let compared = witness.compared.map(f64::to_bits);
    assert_eq!(compared, [14.76f64.sqrt(), 5.0].map(f64::to_bits), "3 m and 2.4 m, theta_obj");
    // A second car is met earlier: the point counts before the order of the detections.
    let two = |seen: &[[f64; 2]], young: &[[f64; 2]], reference: &[[f64; 2]]| {
        let witness = found(seen, young, reference).expect("both cross");
        (witness.point, witness.detection, witness.item)
    };
    let [a, b] = [[10.0, -8.0], [6.0, -5.0]];
    let [a_250, b_250] = [[10.0, -10.0], [6.0, -7.0]];
    let [a_500, b_500] = [[10.0, -12.0], [6.0, -9.0]];
    let both = two(&[a, b], &[a_250, b_250], &[a_500, b_500]);
    assert_eq!(both, (Some(3), Some(1), Some(1)));
    let twice = two(&[b, b], &[b_250], &[b_500, b_500]);
    assert_eq!(twice, (Some(3), Some(0), Some(0)));
}

/// (a) comes before (b) at one point, and tracks are in their order.
#[test]
fn confirmed_tracks_come_before_unexplained_detections() {
    let mut cycle = base(HARDENED, MotRemote);
    let [a, b] = [[10.0, -8.0], [10.0, -8.25]];
    let at = |[x, y]: [f64; 2], dt: f64| [x, y - 8.0 * dt];
    // b is tracked, a is not; both are met at the same point.
    let seen = [a, b, [60.0, 0.0]];
    alone(&mut cycle, &seen, &[at(a, 0.25), at(b, 0.25)], &[at(a, 0.5), at(b, 0.5)]);
    let says = Track { cos: 0.0, sin: 1.0, vy: 8.0, ..track(1, b[0], b[1]) };
    cycle.tracks = tracks(vec![says]);
    let witness = moving(&cycle).expect("both cross");
    assert_eq!((witness.point, witness.detection), (Some(7), Some(1)));
    assert_eq!(witness.item, Some(0), "each item near the past of the track, in order");
    cycle.tracks = tracks(vec![]);
    let witness = moving(&cycle).expect("both cross");
    assert_eq!((witness.point, witness.detection), (Some(7), Some(0)));
}

/// A list without support: when the reference list is the only one, none is asked for.
#[test]
fn one_list_alone_needs_no_support() {
    let mut cycle = base(HARDENED, PlanRemote);
    alone(&mut cycle, &[[10.0, -8.0]], &[], &[[10.0, -12.0]]);
    assert_eq!(moving(&cycle), None);
    cycle.detection_history.remove(0);
    assert!(moving(&cycle).is_some());
    cycle.detection_history.clear();
    assert_eq!(moving(&cycle), None, "no usable list");
}

/// An item of the history is a candidate of every detection, also that of a confirmed track.
#[test]
fn an_explained_detection_takes_no_item_away() {
    let mut cycle = base(HARDENED, MotRemote);
    tracked(&mut cycle, -11.0);
    assert_eq!(moving(&cycle), None, "4 m/s");
    // A second, unseen car: its detection was 4 m away from the origin of the tracked one.
    let seen = cycle.detections.as_mut().expect("set");
    seen.items.push(crossing(6.0, -6.0));
    cycle.detection_history[0].items.push(crossing(8.0, -8.5));
    let witness = moving(&cycle).expect("it may have come from there");
    assert_eq!((witness.detection, witness.item), (Some(2), Some(0)));
}

/// (a) takes the list nearest to 500 ms among those that hold the track's own origin.
#[test]
fn a_track_is_examined_with_a_list_that_holds_its_own_origin() {
    let mut cycle = base(HARDENED, MotRemote);
    // The track says 6 m/s; the CAV saw 8 m/s 250 and 800 ms ago, and nothing 500 ms ago.
    let seen = [[10.0, -8.0], [60.0, 0.0]];
    alone(&mut cycle, &seen, &[[10.0, -10.0]], &[]);
    cycle.detection_history.push(list(800, &[[10.0, -14.4]]));
    let says = Track { cos: 0.0, sin: 1.0, vy: 6.0, ..track(1, 10.0, -8.0) };
    cycle.tracks = tracks(vec![says, track(2, 60.0, 0.0)]);
    assert_eq!(moving(&cycle).expect("8 m/s").age_ns, Some(250_000_000));
    cycle.detection_history[0].stamp_ns += 50_000_001;
    assert_eq!(moving(&cycle), None, "backed by one list alone, and the reference list is empty");
}

/// AllRemote and MotRemote examine alike; the paper profile and PlanRemote with tracks do not.
#[test]
fn motion_is_examined_where_stage_iv_runs() {
    let mut cycle = base(HARDENED, PlanRemote);
    alone(&mut cycle, &[[10.0, -8.0]], &[[10.0, -10.0]], &[[10.0, -12.0]]);
    for configuration in [PlanRemote, MotRemote, AllRemote] {
        cycle.configuration = configuration;
        assert!(moving(&cycle).is_some(), "{configuration:?}");
    }
    (cycle.configuration, cycle.tracks) = (PlanRemote, tracks(vec![]));
    assert_eq!(moving(&cycle), None);
    (cycle.configuration, cycle.tracks, cycle.profile) = (MotRemote, None, Profile::Paper);
    assert_eq!(moving(&cycle), None);
}

/// The centre is at d + w (t_point - t_D): detections 50 ms old have moved on.
#[test]
fn motion_counts_from_the_stamp_of_the_detections() {
    let at = |age: f64, y: f64| {
        let mut cycle = base(HARDENED, PlanRemote);
        alone(&mut cycle, &[[10.0, y]], &[[10.0, y - 2.0]], &[[10.0, y - 4.0]]);
        #[expect(clippy::cast_possible_truncation, reason = "small")]
        let age_ns = (age * 1e9) as i64;
        cycle.detections.as_mut().expect("set").stamp_ns -= age_ns;
        cycle.detection_history.iter_mut().for_each(|list| list.stamp_ns -= age_ns);
        moving(&cycle).map(|witness| witness.point)
    };
    // Seen at -8 m 62.5 ms ago is seen at -7.5 m now.
    assert_eq!(at(0.0, -7.5), at(0.0625, -8.0));
    // At 1.3 s, when the CAV's rear is at 11 m, what is seen at -13.4 m now reaches -1 m.
    assert!(at(0.0, -13.3).is_some() && at(0.0, -13.5).is_none());
    assert!(at(0.0625, -13.8).is_some() && at(0.0625, -14.0).is_none());
}

/// H-04: beyond the end of the trajectory up to s_stop, at the time of the last point.
#[test]
fn motion_is_examined_beyond_the_end() {
    let mut cycle = base(HARDENED, MotRemote);
    // A car comes from the side at 1 m/s, where no point is.
    let place = |x: f64| [[x, 4.0], [x, 4.25], [x, 4.5]];
    let with = |cycle: &mut Cycle, x: f64| {
        let [now, young, old] = place(x);
        alone(cycle, &[now], &[young], &[old]);
        moving(cycle)
    };
    cycle.trajectory = Some(straight(14, 0.5));
    cycle.parameters.lag_tolerance = 2.0;
    // 13 points to 6.5 m, s_stop = 7.65: places at 6.75 to 7.75 m, all 1.3 s from now, when it is at 2.7.
    let witness = with(&mut cycle, 10.2).expect("the front reaches 9.75");
    assert_eq!(witness.point, Some(14 + 2));
    assert_eq!(with(&mut cycle, 10.9), None, "it begins at 9.9");
}

/// Detections times items of the longest usable list times (items of all usable lists + points of the
/// trajectory + places beyond its end).
#[test]
fn work_above_the_limit_fails_stage_iv_of_the_strict_reading() {
    let with = |work_limit: i64| {
        let mut cycle = base(HARDENED, PlanRemote);
        let away = [[60.0, 9.0], [60.0, -9.0], [-50.0, 0.0]];
        alone(&mut cycle, &away[..2], &away[..2], &away);
        cycle.detection_history.push(list(800, &away[..1]));
        cycle.parameters.work_limit = work_limit;
        cycle
    };
    assert_eq!(safe(&with(2 * 3 * (6 + 51))), YES);
    assert_eq!(safe(&with(2 * 3 * (6 + 51) - 1)), NEAR_SAFE);
    // 13 points to 6.5 m, s_stop = 7.65: places at 6.75 to 7.75 m.
    let shorter = |work_limit: i64| {
        let mut cycle = with(work_limit);
        cycle.trajectory = Some(straight(14, 0.5));
        cycle.parameters.lag_tolerance = 2.0;
        cycle
    };
    assert_eq!(safe(&shorter(2 * 3 * (6 + 14 + 5))), YES);
    assert_eq!(safe(&shorter(2 * 3 * (6 + 14 + 5) - 1)), NEAR_SAFE);
    let mut without = with(0);
    without.detection_history.clear();
    assert_eq!(safe(&without), YES);
}
