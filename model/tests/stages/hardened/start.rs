//! H-07: the start of the trajectory, and its times, on both sides of each bound.

use mufasa_model::input::cycle::{Cycle, Profile};
use mufasa_model::numbers::real::Real;
use mufasa_model::report::{Outcome, Rule, Stage, Witness};
use mufasa_model::services::configuration::Configuration::PlanRemote;

use crate::base::*;
use crate::near::*;

/// 1/16 s, in which numbers are exact.
const SIXTEENTH_NS: i64 = 62_500_000;

/// Moves the times of all points.
fn later(cycle: &mut Cycle, by_ns: i64) {
    points(cycle).iter_mut().for_each(|point| point.t_ns += by_ns);
}

const NEAR: &[Near] = &[
    ("a point at now <= limit - m", PlanRemote, Profile::HARDENED, |c, e| c.ego.x = 2.0 + e),
    ("a point before now <= limit - m", PlanRemote, Profile::HARDENED, |c, e| {
        later(c, -SIXTEENTH_NS);
        c.ego.x = 2.625 + e;
    }),
    ("a first point after now <= limit - m", PlanRemote, Profile::HARDENED, |c, e| {
        later(c, SIXTEENTH_NS);
        c.ego.x = -2.630_859_375 - e;
    }),
    ("a later point <= limit - m", PlanRemote, Profile::HARDENED, |c, e| {
        (c.ego.speed, c.ego.x) = (7.0, -0.5 - e);
    }),
    ("heading x heading <= 0.17 - m", PlanRemote, Profile::HARDENED, |c, e| {
        let sin = 0.17 + e;
        (c.ego.cos, c.ego.sin) = ((1.0 - sin * sin).sqrt(), sin);
    }),
    ("heading x heading >= -0.17 + m", PlanRemote, Profile::HARDENED, |c, e| {
        let sin = 0.17 + e;
        (c.ego.cos, c.ego.sin) = ((1.0 - sin * sin).sqrt(), -sin);
    }),
    ("passing to the right <= lateral_tolerance - m", PlanRemote, Profile::HARDENED, |c, e| {
        c.ego.y = -0.5 - e;
    }),
    ("passing to the left <= lateral_tolerance - m", PlanRemote, Profile::HARDENED, |c, e| {
        (c.ego.x, c.ego.y) = (0.5, 0.25 + e);
        c.parameters.lateral_tolerance = 0.25;
    }),
];

#[test]
fn margins_move_each_bound_of_the_start() {
    let [position, heading, offset] = [Rule::Position, Rule::StartHeading, Rule::StartOffset];
    let positions = [position; 4];
    margins_move_rules(NEAR, &[&positions[..], &[heading, heading, offset, offset]].concat());
}

fn witness(cycle: &Cycle) -> Option<Witness> {
    match outcome(cycle, Stage::Ii) {
        Outcome::Failed(witness) => Some(witness),
        _ => None,
    }
}

/// Where the CAV is exactly at the limit of a point: x of the CAV, the point, and what makes the cycle.
type AtLimit = (&'static str, f64, usize, fn(&mut Cycle));

const AT_LIMIT: &[AtLimit] = &[
    ("at now: start_tolerance", 2.0, 0, |_| {}),
    ("at now: another start_tolerance", 0.5, 0, |c| c.parameters.start_tolerance = 0.5),
    ("at now, aside", 1.5, 0, |c| {
        c.ego.y = 2.0;
        (c.parameters.start_tolerance, c.parameters.lateral_tolerance) = (2.5, 2.0);
    }),
    ("before now: v_now abs(t) and no a_max", 2.625, 0, |c| later(c, -SIXTEENTH_NS)),
    ("before now, another v_now", 2.75, 0, |c| {
        later(c, -SIXTEENTH_NS);
        c.ego.speed = 12.0;
    }),
    ("before now, the second point", 2.5625, 1, |c| {
        later(c, -SIXTEENTH_NS);
        points(c)[1..].iter_mut().for_each(|point| point.x -= 0.75);
        points(c)[1].t_ns = NOW - SIXTEENTH_NS / 2;
    }),
    ("after now, the first point", -2.630_859_375, 0, |c| later(c, SIXTEENTH_NS)),
    ("after now, the first point, another a_max", -2.640_625, 0, |c| {
        later(c, SIXTEENTH_NS);
        c.parameters.a_max = 8.0;
    }),
    // 2 + v_now t + a_max t^2 / 2 - 10 t is least at t = 1 s.
    ("after now, a later point", -0.5, 10, |c| c.ego.speed = 7.0),
    ("after now, the last point", -0.5, 10, |c| {
        c.ego.speed = 7.0;
        points(c).truncate(11);
    }),
    ("after now, another v_now and a_max", -1.0, 10, |c| {
        (c.ego.speed, c.parameters.a_max) = (8.0, 2.0);
    }),
];

/// The limit of a point is included, and the next double is beyond it.
/// H-07.2.
#[test]
fn no_point_is_farther_than_the_cav_can_drive_by_then() {
    for (name, x, point, with) in AT_LIMIT {
        let mut cycle = base(Profile::HARDENED, PlanRemote);
        with(&mut cycle);
        cycle.ego.x = *x;
        assert_eq!(witness(&cycle), None, "{name}");
        cycle.ego.x = if *x > 0.0 { x.next_up() } else { x.next_down() };
        let found = witness(&cycle).map(|it| (it.rule, it.point));
        assert_eq!(found, Some((Rule::Position, Some(*point))), "{name}");
    }
}

/// The points 8 to 12 are too far, and 10 by most.
/// H-07.2, SCHED-20.
#[test]
fn the_first_point_too_far_is_the_witness() {
    let mut cycle = base(Profile::HARDENED, PlanRemote);
    (cycle.ego.speed, cycle.ego.x) = (7.0, -0.6);
    let [distance, limit] = [8.6, 8.56].map(Real::from_double);
    let expected = Witness::new(Rule::Position, &distance, &limit).at_point(8);
    assert_eq!(witness(&cycle), Some(expected));
}

/// A late point that is too far comes before what is wrong with the first one but its time.
/// SCHED-20.
#[test]
fn position_comes_behind_the_time_and_before_the_rest_of_the_start() {
    let mut cycle = base(Profile::HARDENED, PlanRemote);
    cycle.ego.speed = 7.0;
    (cycle.ego.x, cycle.ego.y, cycle.ego.cos) = (-0.6, 0.6, -1.0);
    assert_eq!(rule(&cycle, Stage::Ii), Some(Rule::Position));
    later(&mut cycle, -100_000_001);
    assert_eq!(rule(&cycle, Stage::Ii), Some(Rule::StartTime));
}

/// The cross product alone would take the opposite for the same.
/// H-07.3.
#[test]
fn the_opposite_heading_is_another_one() {
    let mut cycle = base(Profile::HARDENED, PlanRemote);
    cycle.ego.cos = -1.0;
    assert_eq!(rule(&cycle, Stage::Ii), Some(Rule::StartHeading));
    // Position comes before heading, heading before offset.
    cycle.ego.y = 0.6;
    assert_eq!(rule(&cycle, Stage::Ii), Some(Rule::StartHeading));
    cycle.ego.y = 2.1;
    assert_eq!(rule(&cycle, Stage::Ii), Some(Rule::Position));
}
