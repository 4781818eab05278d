//! H-11 and H-12: steps and turns on both sides of each bound.

use mufasa_model::input::cycle::{Profile, Trajectory, TrajectoryPoint};
use mufasa_model::report::{Outcome, Rule, Stage};
use mufasa_model::services::configuration::Configuration::PlanRemote;

use crate::base::*;
use crate::near::*;

const HARDENED: Profile = Profile::Hardened;

/// Mean direction of the headings (1, 0) and (0.96, 0.28), for a step along an arc.
const BETWEEN: [f64; 2] = [1.96, 0.28];

const NEAR: &[Near] = &[
    ("step <= L - m", PlanRemote, HARDENED, |c, e| two_points(c, 100, [4.0 + e, 0.0])),
    ("step <= v_max dt - m", PlanRemote, HARDENED, |c, e| two_points(c, 20, [3.0 + e, 0.0])),
    ("u . h >= -0.1 dt + m", PlanRemote, HARDENED, |c, e| two_points(c, 100, [-0.01 - e, 0.0])),
    ("lateral step <= W/2 - m", PlanRemote, HARDENED, |c, e| {
        two_points(c, 100, [1.5, 0.1 + e]);
        c.ego.width = 0.2;
    }),
    ("dot product of headings >= 0.866 + m", PlanRemote, HARDENED, |c, e| {
        two_points(c, 400, [1.931_85, 0.517_64]);
        c.parameters.step_max_ns = 400_000_000;
        turn(c, 0.866 - e);
    }),
    ("turn of a step <= bound - m", PlanRemote, HARDENED, |c, e| {
        // 0.28 <= 0.1 + 0.01 + 0.5 abs(u), after a metre straight on
        two_points(c, 100, [1.0, 0.0]);
        let [x, y] = BETWEEN.map(|part| part * (0.34 - 2.0 * e) / BETWEEN[0].hypot(BETWEEN[1]));
        let last = TrajectoryPoint { cos: 0.96, sin: 0.28, ..at_time(200_000_000, 1.0 + x, y) };
        points(c).push(last);
    }),
    ("slide <= bound - m", PlanRemote, HARDENED, |c, e| {
        // Both headings along x: 2 y <= 0.1 * 2 + 0.1 + 0.02 * 0.1.
        two_points(c, 100, [1.0, 0.151 + e / 2.0]);
    }),
    ("slide of a turn <= bound - m", PlanRemote, HARDENED, |c, e| {
        // u x (h1 + h2) = 0.56 - 1.96 y, L (h1 x h2)/2 = 0.56: the CAV turns left about a point to
        // its right. 1.12 - 1.96 y <= 0.56 + 0.1 (3.92 + 0.28 y) + 0.104
        two_points(c, 200, [2.0, 0.0]);
        turn(c, 0.96);
        points(c)[1].y = (0.56 - 0.496 - e) / 1.988;
    }),
    ("turn reversed: hm . h >= m", PlanRemote, HARDENED, |c, e| {
        quarter_turn(c, e);
    }),
    ("turn on the spot <= bound - m", PlanRemote, HARDENED, |c, e| {
        // 0.28 <= 0.05 + 0.02 + 0.5 w
        two_points(c, 200, BETWEEN.map(|part| part * (0.42 - 2.0 * e) / 1.96));
        turn(c, 0.96);
    }),
    ("turn hard <= bound - m", PlanRemote, HARDENED, |c, e| {
        // 0.28 w <= 0.1 w + 11.5 * 0.04
        two_points(c, 200, BETWEEN.map(|part| part * (0.46 + e) / 0.18 / 1.96));
        turn(c, 0.96);
    }),
    // H-12: b(0.5) = s_b(10) = 2.5, 10 * 0.5 + 3 * 0.125 + 0.5.
    ("way >= b - lag_tolerance + m", PlanRemote, HARDENED, |c, e| arc(c, 2.25 - e)),
    ("arc length <= ... + start_tolerance - m", PlanRemote, HARDENED, |c, e| arc(c, 5.875 + e)),
    // 0.1 s before now: v_lo = 10 - 0.3, v_hi = 10 + 2.
    ("way >= b(v_lo), t0 before now", PlanRemote, HARDENED, |c, e| {
        shifted_arc(c, -1, 2.102_25 - e);
    }),
    ("arc length <= v_hi t + ..., t0 before now", PlanRemote, HARDENED, |c, e| {
        shifted_arc(c, -1, 6.875 + e);
    }),
    // 0.1 s after now: v_lo = 10 - 2, v_hi = 10 + 0.3.
    ("way >= b(v_lo), t0 after now", PlanRemote, HARDENED, |c, e| {
        shifted_arc(c, 1, 1.35 - e);
    }),
    ("arc length <= v_hi t + ..., t0 after now", PlanRemote, HARDENED, |c, e| {
        shifted_arc(c, 1, 6.025 + e);
    }),
];

/// The second heading.
fn turn(cycle: &mut mufasa_model::input::cycle::Cycle, cos: f64) {
    (points(cycle)[1].cos, points(cycle)[1].sin) = (cos, (1.0 - cos * cos).sqrt());
}

fn shifted_arc(cycle: &mut mufasa_model::input::cycle::Cycle, tenths: i64, x: f64) {
    arc(cycle, x);
    points(cycle).iter_mut().for_each(|point| point.t_ns += tenths * 100_000_000);
}

/// From heading 0 along a circle of 2 m to 90 degrees and `more`, 0.6 s, on a road at 45 degrees.
fn quarter_turn(cycle: &mut mufasa_model::input::cycle::Cycle, more: f64) {
    two_points(cycle, 200, [0.0, 0.0]);
    let on_circle = |i: u32| {
        let angle = (f64::from(i) * 30.0).to_radians();
        let (sin, cos) = angle.sin_cos();
        TrajectoryPoint {
            t_ns: NOW + i64::from(i) * 200_000_000,
            x: 2.0 * sin,
            y: 2.0 - 2.0 * cos,
            cos,
            sin,
        }
    };
    *points(cycle) = (0..=3).map(on_circle).collect();
    (points(cycle)[3].cos, points(cycle)[3].sin) = (-more, 1.0);
    for (cross_section, at) in cycle.route.cross_sections.iter_mut().zip([-100.0, 200.0]) {
        (cross_section.x, cross_section.y) = (at, at);
        (cross_section.left, cross_section.right) =
            ([at - 50.0, at + 50.0], [at + 50.0, at - 50.0]);
    }
}

#[test]
fn margins_move_each_bound_of_a_step_and_a_turn() {
    margins_move(NEAR);
}

#[test]
fn the_filter_changes_no_report_of_steps_and_turns() {
    the_filter_changes_nothing(NEAR);
}

/// Each case breaks the rule that it is about, the first in the order of the rules.
#[test]
fn each_bound_is_that_of_its_rule() {
    let rules = [
        Rule::StepLength,
        Rule::StepSpeed,
        Rule::StepForward,
        Rule::StepLateral,
        Rule::StepTurn,
        Rule::StepTurn,
        Rule::Slide,
        Rule::Slide,
        Rule::TurnReversed,
        Rule::TurnOnTheSpot,
        Rule::TurnHard,
        Rule::ArcTooShort,
        Rule::ArcTooLong,
        Rule::ArcTooShort,
        Rule::ArcTooLong,
        Rule::ArcTooShort,
        Rule::ArcTooLong,
    ];
    assert_eq!(NEAR.len(), rules.len());
    for ((name, configuration, profile, with), expected) in NEAR.iter().zip(rules) {
        let mut cycle = base(*profile, *configuration);
        with(&mut cycle, 3e-6);
        if expected == Rule::TurnReversed {
            // The road would be left, too: rule `direction` comes first where both fail.
            assert_ne!(rule(&cycle, Stage::Ii), Some(Rule::Direction), "{name}");
        }
        assert_eq!(rule(&cycle, Stage::Ii), Some(expected), "{name}");
    }
}

/// H-11, F-35: 2.7 m to the side within 60 ms, as points of a straight drive.
#[test]
fn a_slide_is_no_step_along_its_headings() {
    let mut cycle = base(HARDENED, PlanRemote);
    let points = points(&mut cycle);
    points.truncate(4);
    for (i, aside) in [(1, 0.9), (2, 1.8), (3, 2.7)] {
        (points[i].t_ns, points[i].y) =
            (NOW + 20_000_000 * i64::try_from(i).expect("small"), aside);
    }
    assert_eq!(rule(&cycle, Stage::Ii), Some(Rule::Slide));
}

/// H-11, F-41: turns of 0.05 rad to the right and back, each way back 0.05 m to the left.
#[test]
fn ways_aside_of_turns_to_and_fro_add_up() {
    let fails_at = |turns: i32| {
        let mut cycle = base(HARDENED, PlanRemote);
        let turned = TrajectoryPoint { cos: 0.998_749, sin: -0.05, ..at_time(0, 0.0, 0.0) };
        let point = |i: i32| TrajectoryPoint {
            t_ns: NOW + i64::from(i) * 10_000_000,
            x: 0.01 * f64::from(i),
            y: 0.05 * f64::from(i / 2),
            ..if i % 2 == 1 { turned.clone() } else { at_time(0, 0.0, 0.0) }
        };
        let points = (0..=2 * turns).map(point).collect();
        cycle.trajectory = Some(Trajectory { stamp_ns: NOW, points });
        match outcome(&cycle, Stage::Ii) {
            Outcome::Failed(witness) if witness.rule == Rule::Slide => witness.point,
            _ => None,
        }
    };
    // 2 y is 0.1 m of 0.104 m after one turn, 0.2 m of 0.109 m after two.
    assert_eq!(fails_at(1), None);
    assert_eq!(fails_at(2), Some(4));
}

/// A mark is at least 0.5 s after the mark before it, and a point is compared with the last mark before
/// it: a slow turn on the spot that each step and each half second allows is no turn of a whole second.
#[test]
fn marks_are_half_a_second_apart() {
    let turning = |step_ns: i64, headings: &[f64]| {
        let mut cycle = base(HARDENED, PlanRemote);
        two_points(&mut cycle, 100, [0.0, 0.0]);
        let point = |(i, sin): (i64, &f64)| TrajectoryPoint {
            cos: (1.0 - sin * sin).sqrt(),
            sin: *sin,
            ..at_time(i * step_ns, 0.0, 0.0)
        };
        let points = (0..).zip(headings).map(point).collect();
        cycle.trajectory = Some(Trajectory { stamp_ns: NOW, points });
        match outcome(&cycle, Stage::Ii) {
            Outcome::Failed(witness) => Some((witness.rule, witness.point)),
            _ => None,
        }
    };
    // On the spot 0.05 + 0.1 t: 0.09 after 0.4 s, and 0.1 after 0.5 s, from the first point on.
    assert_eq!(turning(100_000_000, &[0.0, 0.05, 0.06, 0.07, 0.08]), None);
    assert_eq!(turning(100_000_000, &[0.0, 0.0, 0.0, 0.0, 0.0, 0.099]), None);
    let on_the_spot = |point| Some((Rule::TurnOnTheSpot, Some(point)));
    assert_eq!(turning(100_000_000, &[0.0, 0.0, 0.0, 0.0, 0.0, 0.101]), on_the_spot(5));
    // The point at 0.5 s is compared with the first one, and is the mark of those behind it.
    assert_eq!(turning(100_000_000, &[0.0, 0.0, 0.0, 0.0, 0.0, 0.099, 0.15]), None);
    // At 0.499 999 999 s it is no mark: the next point is compared with the first one, too.
    let late = turning(99_999_999, &[0.0, 0.0, 0.0, 0.0, 0.0, 0.099, 0.15]);
    assert_eq!(late, on_the_spot(6));
    // The order of the rules comes before that of the points.
    let reversed = turning(100_000_000, &[0.0, 0.1, 0.0]);
    assert_eq!(reversed, on_the_spot(1));
}

/// A turn of up to 0.1 is what measuring leaves open, however fast.
#[test]
fn a_small_turn_is_never_hard() {
    let fast = |sin: f64| {
        let mut cycle = base(HARDENED, PlanRemote);
        two_points(&mut cycle, 30, [4.0, 0.0]);
        cycle.ego.speed = 130.0;
        cycle.parameters.v_max = 150.0;
        cycle.ego.length = 5.0;
        let cos = (1.0 - sin * sin).sqrt();
        (points(&mut cycle)[1].cos, points(&mut cycle)[1].sin) = (cos, sin);
        (points(&mut cycle)[1].x, points(&mut cycle)[1].y) = (2.0 * (1.0 + cos), 2.0 * sin);
        rule(&cycle, Stage::Ii)
    };
    assert_ne!(fast(0.1), Some(Rule::TurnHard));
    assert_eq!(fast(0.11), Some(Rule::TurnHard), "0.01 * 4 m in 30 ms is above 11.5 * 0.0009");
}
