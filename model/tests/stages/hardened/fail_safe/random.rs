//! Random cycles near their thresholds: what strict accepts exact accepts, and what exact accepts lax does.

use mufasa_model::cycle::check;
use mufasa_model::input::cycle::{Cycle, Profile, Track, Trajectory, TrajectoryPoint};
use mufasa_model::report::{FailedStage, Outcome, Reading, Rule, Stage};
use mufasa_model::services::configuration::Configuration::PlanRemote;

use crate::base::*;
use crate::exact::Draw;

/// A multiple of an eighth, now and then off by less than two margins.
fn near_eighths(draw: &mut Draw, low: i32, high: i32) -> f64 {
    let off = [0.0, 0.0, 0.5, -0.5, 1.0, 1.5][usize::try_from(draw.between(0, 5)).expect("small")];
    f64::from(draw.between(low, high)) / 8.0 + off * 1e-6
}

/// A path that bends a little, at a speed whose way to stop is a multiple of an eighth of a metre, and an
/// object about it.
fn drawn(draw: &mut Draw) -> Cycle {
    let mut cycle = base(Profile::HARDENED, PlanRemote);
    cycle.parameters.tau = [0.0, 0.5][usize::try_from(draw.between(0, 1)).expect("small")];
    (cycle.parameters.a_max, cycle.parameters.lateral_tolerance) = (4.0, 2.0);
    cycle.parameters.safety_time = 0.0;
    cycle.ego.speed = f64::from(draw.between(0, 4)) * 2.0;
    let (first, slope) = (near_eighths(draw, -2, 3), f64::from(draw.between(-2, 2)) / 64.0);
    let aside = near_eighths(draw, -6, 6);
    let point = |i: i32| {
        let x = first + f64::from(i) / 2.0;
        TrajectoryPoint { y: aside + slope * x, ..at_time(i64::from(i) * 100_000_000, x, 0.0) }
    };
    cycle.trajectory = Some(Trajectory { stamp_ns: NOW, points: (0..40).map(point).collect() });
    let [x, y] = [near_eighths(draw, -60, 100), near_eighths(draw, -24, 24)];
    let speeds = [-8, -1, 0, 1, 6, 8, 64];
    let mut speed =
        || f64::from(speeds[usize::try_from(draw.between(0, 6)).expect("small")]) / 8.0 * 2.0;
    let (vx, vy) = (speed(), speed());
    let [cos, sin] = if vx.abs() < vy.abs() { [0.0, 1.0] } else { [1.0, 0.0] };
    let object = Track { cos, sin, vx, vy, length: 2.0, width: 1.0, ..track(1, x, y) };
    (cycle.tracks, cycle.detections) = (tracks(vec![object]), None);
    if draw.between(0, 1) == 1 {
        cycle.detections = detections(vec![detection(x, y)]);
        cycle.detection_history = history(&[[x, y, vx, vy], [x + 0.5, y, vx, vy]]);
    }
    cycle
}

#[test]
fn strict_accepts_no_more_than_exact_and_exact_no_more_than_lax() {
    let mut draw = Draw::new(29);
    let (mut apart, mut by_rule) = (0, [0; 3]);
    for _ in 0..1500 {
        let cycle = drawn(&mut draw);
        let reports = [Reading::Strict, Reading::Exact, Reading::Lax]
            .map(|reading| check(&cycle, reading).expect("valid"));
        let safe = reports.each_ref().map(|report| report.failed_stage.is_none());
        assert!(safe[0] <= safe[1] && safe[1] <= safe[2], "{safe:?} {cycle:?}");
        // The stage that fails is no earlier in a milder reading.
        let stage = |failed: Option<FailedStage>| match failed {
            Some(FailedStage::Stage(stage)) => stage as usize,
            Some(FailedStage::Input | FailedStage::NoObstacleCheck) | None => 5,
        };
        let stages = reports.each_ref().map(|report| stage(report.failed_stage));
        assert!(stages.is_sorted(), "{stages:?} {cycle:?}");
        apart += usize::from(safe[0] != safe[2]);
        for outcome in &reports[1].stages[Stage::Ii as usize..=Stage::Iv as usize] {
            if let Outcome::Failed(witness) = outcome {
                let rules = [Rule::Reach, Rule::Collision, Rule::FailSafe];
                let seen = rules.iter().position(|rule| *rule == witness.rule);
                seen.into_iter().for_each(|rule| by_rule[rule] += 1);
            }
        }
        by_rule[1] += usize::from(safe[1]);
    }
    // Reach, safe or collision, fail-safe.
    assert!(apart > 20 && by_rule[1] > 300 && by_rule[2] > 200, "{apart} {by_rule:?}");
}
