//! `spec/3-stages.md#schedule`

use mufasa_model::hardened::h02_h05_h10_schedule::schedule;
use mufasa_model::input::cycle::Cycle;
use mufasa_model::report::{FailedStage, Outcome};
use mufasa_model::stages::Scheduled;

use crate::base::*;

/// Removes the inputs whose letters are named.
fn without(mut cycle: Cycle, inputs: &str) -> Cycle {
    for input in inputs.chars() {
        match input {
            'j' => cycle.trajectory = None,
            't' => cycle.tracks = None,
            'd' => cycle.detections = None,
            'g' => cycle.grid = None,
            other => panic!("no input {other}"),
        }
    }
    cycle
}

/// SCHED-14, SCHED-17: every scheduled stage has an outcome,
/// and the verdict is unsafe exactly when one failed or H-05 applies.
#[test]
fn unsafe_exactly_when_a_stage_failed() {
    let mut unsafe_cycles = 0;
    for profile in PROFILES {
        for configuration in REMOTE {
            for mask in 0..16u32 {
                let missing: String = "jtdg"
                    .chars()
                    .enumerate()
                    .filter(|(i, _)| mask >> i & 1 == 1)
                    .map(|(_, c)| c)
                    .collect();
                for bad_y in [0.0, 9.0] {
                    let mut cycle = without(base(profile, configuration), &missing);
                    if let Some(trajectory) = cycle.trajectory.as_mut() {
                        trajectory.points[2].y = bad_y;
                    }
                    let report = report(&cycle);
                    let failed = report.stages.iter().any(|o| matches!(o, Outcome::Failed(_)));
                    let no_check = report.failed_stage == Some(FailedStage::NoObstacleCheck);
                    assert!(!(failed && no_check));
                    assert_eq!(report.failed_stage.is_some(), failed || no_check);
                    unsafe_cycles += u32::from(report.failed_stage.is_some());
                    for entry in schedule(profile, configuration) {
                        let never = entry.scheduled == Scheduled::Never;
                        let outcome = &report.stages[entry.stage as usize];
                        assert_eq!(never, *outcome == Outcome::NotScheduled);
                    }
                }
            }
        }
    }
    assert!(unsafe_cycles > 40, "{unsafe_cycles}");
}
