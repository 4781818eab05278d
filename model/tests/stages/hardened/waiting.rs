//! H-13 (c): what is examined as moving farther on, because the CAV may not wait for it.
//!
//! The CAV drives 10 m/s along y = 0; what is examined of every pair ends at point 11, where the CAV
//! reaches from 9 to 13 m.

use mufasa_model::input::cycle::{Cycle, Detection, DetectionList, Profile};
use mufasa_model::report::{Outcome, Rule, Stage, Witness};
use mufasa_model::services::configuration::Configuration::PlanRemote;

use crate::base::*;
use crate::near::*;

/// Of the points that are examined for every pair.
const LAST: usize = 11;

/// A detection that came from there 250 and 500 ms ago, and nothing else.
fn moving(cycle: &mut Cycle, d: Detection, [vx, vy]: [f64; 2]) {
    (cycle.tracks, cycle.grid) = (None, None);
    let then = |dt: f64| Detection { x: d.x - vx * dt, y: d.y - vy * dt, ..d.clone() };
    let list = |millis: i64, dt: f64| DetectionList {
        stamp_ns: NOW - millis * 1_000_000,
        items: vec![then(dt)],
    };
    cycle.detection_history = vec![list(250, 0.25), list(500, 0.5)];
    cycle.detections = detections(vec![d]);
}

/// A car of 2 m by 4 m that comes from the right at 8 m/s.
fn crossing(cycle: &mut Cycle, x: f64, y: f64) {
    moving(cycle, Detection { cos: 0.0, sin: 1.0, ..detection(x, y) }, [0.0, 8.0]);
}

/// A car from behind, at 20 m/s along and 2 m/s to the left: it meets the CAV at 15 m. `y` is from where
/// its way passes the front right corner of the CAV's rectangle at the first point.
fn overtaking(cycle: &mut Cycle, y: f64) {
    moving(cycle, detection(-18.5, -4.25 + y), [20.0, 2.0]);
}

fn found(with: impl FnOnce(&mut Cycle)) -> Option<Witness> {
    let mut cycle = base(Profile::Hardened, PlanRemote);
    with(&mut cycle);
    match outcome(&cycle, Stage::Iv) {
        Outcome::Failed(witness) => {
            assert_eq!(witness.rule, Rule::CollisionMoving);
            Some(witness)
        }
        Outcome::Passed => None,
        other => panic!("stage iv ran: {other:?}"),
    }
}

/// Where it is met.
fn point(with: impl FnOnce(&mut Cycle)) -> Option<usize> {
    found(with)?.point
}

const NEAR: &[Near] = &[
    ("a collision where the CAV may not wait", PlanRemote, Profile::Hardened, |c, e| {
        crossing(c, 12.5, -15.0 + e);
    }),
    ("the CAV's rectangle + m at the point before", PlanRemote, Profile::Hardened, |c, e| {
        crossing(c, 14.0 - e, -14.5);
    }),
    ("the CAV's rectangle - m at the first point", PlanRemote, Profile::Hardened, |c, e| {
        overtaking(c, -e);
    }),
];

#[test]
fn margins_move_where_the_cav_may_wait() {
    margins_move(NEAR);
    for (name, configuration, profile, with) in NEAR {
        let mut cycle = base(*profile, *configuration);
        with(&mut cycle, 3e-6);
        assert_eq!(rule(&cycle, Stage::Iv), Some(Rule::CollisionMoving), "{name}");
    }
}

#[test]
fn the_filter_changes_no_report_of_waiting() {
    the_filter_changes_nothing(NEAR);
}

/// A car in the way of which the CAV would have to stop is met, or the CAV gets through before it: its
/// rear is at 13 m when the car, whose lane ends there, reaches it.
#[test]
fn where_it_may_not_wait_the_cav_has_to_get_through() {
    assert_eq!(point(|c| crossing(c, 12.0, -11.7)), Some(LAST));
    let witness = found(|c| crossing(c, 12.0, -12.6)).expect("a point later");
    assert_eq!((witness.point, witness.detection, witness.item), (Some(12), Some(0), Some(0)));
    assert_eq!((witness.age_ns, witness.track), (Some(500_000_000), None));
    assert_eq!(point(|c| crossing(c, 12.0, (-12.6f64).next_down())), Some(13));
    assert_eq!(point(|c| crossing(c, 12.0, -15.0)), Some(15));
    assert_eq!(point(|c| crossing(c, 12.0, (-15.0f64).next_down())), None);
}

/// At the last point that is examined for every pair the CAV's front touches the lane, or does not.
#[test]
fn what_the_cav_may_wait_for_is_examined_no_farther() {
    assert_eq!(point(|c| crossing(c, 14.0, -14.5)), Some(15));
    assert_eq!(point(|c| crossing(c, 14.0f64.next_up(), -14.5)), None);
}

/// A lead that drives on, what stands on the road, and what has passed: the next cycle can still decide.
#[test]
fn what_is_ahead_is_waited_for() {
    let ahead = |vx: f64, x: f64| point(|c| moving(c, detection(x, 0.0), [vx, 0.0]));
    assert_eq!(ahead(2.0, 12.2), Some(LAST), "within what is examined");
    assert_eq!(ahead(2.0, 13.5), None, "met at point 12");
    assert_eq!(ahead(0.0, 17.0), None, "met at point 13");
    let passed = |y: f64| point(|c| crossing(c, 12.0, y));
    assert_eq!((passed(-4.3), passed(-4.1)), (Some(9), None), "its rear at 1 m, at point 9");
}

/// Behind a point at which the CAV may wait nothing is examined: a car overtakes from the right, and
/// its rear is 0.2 m ahead of the CAV at point 12, 1.3 s from now, and 0.7 m behind its front at point 13.
#[test]
fn a_point_to_wait_at_ends_what_is_examined() {
    let with = |x: f64| {
        point(|c| {
            points(c)[LAST + 1..].iter_mut().for_each(|point| point.t_ns += 100_000_000);
            points(c)[LAST + 2..].iter_mut().for_each(|point| point.x += 1.0);
            moving(c, detection(x, -9.1), [11.0, 6.0]);
        })
    };
    assert_eq!((with(1.6), with(1.9)), (Some(LAST + 1), None));
}

/// Who is in the way already at the first point is not helped by a refusal: a car from behind.
#[test]
fn what_the_cav_may_not_wait_for_at_the_first_point_is_examined_no_farther() {
    assert_eq!(point(|c| overtaking(c, -0.01)), Some(15));
    assert_eq!(point(|c| overtaking(c, 0.01)), None);
    let behind = |x: f64| point(|c| moving(c, detection(x, 0.0), [20.0, 0.0]));
    assert_eq!(behind(-15.0), Some(LAST), "within what is examined");
    assert_eq!(behind(-15.1), None, "met at point 12");
    // And who comes along the road towards the CAV.
    let towards = |x: f64| point(|c| moving(c, detection(x, 0.0), [-20.0, 0.0]));
    assert_eq!((towards(37.0), towards(37.1)), (Some(LAST), None));
}

/// The first of the points, then of the pairs: one car comes from the left, one from the right.
#[test]
fn the_witness_behind_what_is_examined_is_the_first() {
    let two = |left: f64, right: f64| {
        let witness = found(|c| {
            moving(c, Detection { cos: 0.0, sin: -1.0, ..detection(12.0, left) }, [0.0, -8.0]);
            let other = c.clone();
            crossing(c, 12.0, right);
            let items = &mut c.detections.as_mut().expect("set").items;
            items.insert(0, other.detections.expect("set").items[0].clone());
            for (list, before) in c.detection_history.iter_mut().zip(other.detection_history) {
                list.items.insert(0, before.items[0].clone());
            }
        });
        let witness = witness.expect("both are met");
        (witness.point, witness.detection, witness.item)
    };
    assert_eq!(two(14.0, -12.6), (Some(12), Some(1), Some(1)));
    assert_eq!(two(12.5, -12.6), (Some(12), Some(0), Some(0)));
    // What is examined of every pair comes before what is not.
    assert_eq!(two(12.6, -11.7), (Some(LAST), Some(1), Some(1)));
}
