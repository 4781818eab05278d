//! The schedule (`spec/3-stages.md#schedule`): its table, and what the text says of it, as far as it does not
//! depend on what the stages compare.

use mufasa::cycle::check;
use mufasa::cycle::order::{Given as Inputs, Idle};
use mufasa::input::cycle::Cycle;
use mufasa::input::scratch::{Column, Row, Scratch};
use mufasa::report::{FailedStage, Outcome, Report, Stage};

use super::any::{configuration, index, profile};
use super::order::Asked;
use super::scene::{Given, cycle};
#[cfg(not(kani))]
use crate::kani;
use crate::law::schedule as law;

/// In every configuration, in both profiles, with every combination of inputs that are missing,
/// too old, harmless or harmful: exactly the stages of the table run, in their order, none after
/// the first failure, and every other outcome has the right reason.
///
/// Domain: one scene, 8192 cycles. Not covered: other numbers (`stages` has any).
pub fn verify_schedule_is_the_table() {
    let given = [(); 5].map(|()| Given::ALL[index(4)]);
    let cycle = cycle(profile(), configuration(), given);
    let (mut rows, mut columns) = ([Row::default(); 2], [Column::default(); 4]);
    let Ok(report) = check(&cycle, &mut Scratch::new(&mut rows, &mut columns)) else {
        unreachable!("every input is valid")
    };
    assert_scheduled(&cycle, &report);
    kani::cover!(report.failed_stage.is_none(), "safe");
    kani::cover!(report.failed_stage == Some(FailedStage::Stage(Stage::I)), "stage i fails");
    kani::cover!(report.failed_stage == Some(FailedStage::Stage(Stage::Ii)), "stage ii fails");
    kani::cover!(report.failed_stage == Some(FailedStage::Stage(Stage::Iii)), "stage iii fails");
    kani::cover!(report.failed_stage == Some(FailedStage::Stage(Stage::Iv)), "stage iv fails");
    kani::cover!(report.failed_stage == Some(FailedStage::Stage(Stage::V)), "stage v fails");
    kani::cover!(report.failed_stage == Some(FailedStage::NoObstacleCheck), "no obstacle check");
}

/// The laws of a report, and the table.
pub(super) fn assert_scheduled(cycle: &Cycle<'_>, report: &Report) {
    for (name, law) in law::LAWS {
        assert!(law(cycle, report), "{name}");
    }
    if report.failed_stage != Some(FailedStage::Input) {
        assert!(follows_the_table(cycle, report));
    }
}

/// What the table is asked of, with what is there of the inputs, and current.
fn asked(cycle: &Cycle<'_>) -> Asked {
    let is_current = |stamp_ns: Option<i64>| {
        stamp_ns.is_some_and(|stamp_ns| {
            let age_ns = i128::from(cycle.now_ns) - i128::from(stamp_ns);
            0 <= age_ns && age_ns <= i128::from(cycle.parameters.max_age_ns)
        })
    };
    let given = Inputs {
        tracks_of_any_age: cycle.tracks.is_some(),
        tracks: is_current(cycle.tracks.map(|list| list.stamp_ns)),
        trajectory: is_current(cycle.trajectory.map(|list| list.stamp_ns)),
        detections: is_current(cycle.detections.map(|list| list.stamp_ns)),
        grid: is_current(cycle.grid.map(|grid| grid.stamp_ns)),
    };
    Asked { profile: cycle.profile, configuration: cycle.configuration, given }
}

/// Stage by stage, what the table of `order` says of it, given what became of the stages before.
fn follows_the_table(cycle: &Cycle<'_>, report: &Report) -> bool {
    let asked = asked(cycle);
    let mut ran = [false; 5];
    let mut failed = None;
    for (at, stage) in Stage::ALL.into_iter().enumerate() {
        let outcome = report.stages[at];
        let idle = asked.idle(at, ran, failed.is_some());
        ran[at] = idle.is_none();
        // H-04, H-14: what is compared at this place although stage iv does not run.
        let instead = at == 3 && law::fails_instead_of_iv(cycle, &outcome);
        let as_expected = match idle {
            None => matches!(outcome, Outcome::Passed | Outcome::Failed(_)),
            Some(idle) if instead => {
                failed.is_none() && idle != Idle::NotScheduled && asked.given.trajectory
            }
            Some(Idle::NotScheduled) => outcome == Outcome::NotScheduled,
            Some(Idle::Skipped(reason)) => outcome == Outcome::Skipped(reason),
            Some(Idle::NotApplicable(input)) => outcome == Outcome::NotApplicable(input),
        };
        if !as_expected {
            return false;
        }
        if failed.is_none() && matches!(outcome, Outcome::Failed(_)) {
            failed = Some(FailedStage::Stage(stage));
        }
    }
    let unexamined = asked.is_unexamined(ran).then_some(FailedStage::NoObstacleCheck);
    report.failed_stage == failed.or(unexamined)
}
