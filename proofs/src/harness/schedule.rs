//! The schedule (`spec/3-stages.md#schedule`): its table written a second time, as data, and what
//! the text says of it, as far as it does not depend on what the stages compare.

use mufasa::cycle::check;
use mufasa::input::cycle::Cycle;
use mufasa::input::profile::Profile;
use mufasa::input::scratch::{Column, Row, Scratch};
use mufasa::report::{FailedStage, Input, Outcome, Reason, Report, Stage};
use mufasa::services::configuration::Configuration;

use super::any::{configuration, index, profile};
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
    assert!(law::no_stage_runs_in_local(cycle, report));
    assert!(law::only_scheduled_stages_run(cycle, report));
    assert!(law::nothing_runs_after_a_failure(cycle, report));
    assert!(law::unsafe_exactly_when_something_failed(cycle, report));
    assert!(law::nothing_runs_without_its_input(cycle, report));
    assert!(law::no_trajectory_is_accepted_unexamined(cycle, report));
    if report.failed_stage != Some(FailedStage::Input) {
        assert!(follows_the_table(cycle, report));
    }
}

/// How a stage is marked in the table.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Mark {
    Always,
    Conditional,
    Dash,
}

use Mark::{Always, Conditional, Dash};

/// The table of the text: a row for each stage; `MotRemote`, `AllRemote`, `PlanRemote`.
const TABLE: [[Mark; 3]; 5] = [
    [Always, Always, Dash],
    [Always, Always, Always],
    [Dash, Conditional, Always],
    [Conditional, Conditional, Conditional],
    [Always, Conditional, Dash],
];

/// What each stage reads, in the order of the reasons.
const READS: [&[Input]; 5] = [
    &[Input::Tracks, Input::Detections],
    &[Input::Trajectory],
    &[Input::Trajectory, Input::Tracks],
    &[Input::Trajectory, Input::Detections],
    &[Input::Trajectory, Input::Grid],
];

fn mark(cycle: &Cycle<'_>, stage: usize) -> Mark {
    let column = match cycle.configuration {
        Configuration::Local => return Dash,
        Configuration::MotRemote => 0,
        Configuration::AllRemote => 1,
        Configuration::PlanRemote => 2,
    };
    // H-05: conditional in PlanRemote too.
    let v_in_plan_remote = stage == 4 && column == 2;
    if v_in_plan_remote && cycle.profile == Profile::HARDENED {
        Conditional
    } else {
        TABLE[stage][column]
    }
}

fn is_current(cycle: &Cycle<'_>, input: Input) -> bool {
    let stamp_ns = match input {
        Input::Trajectory => cycle.trajectory.map(|list| list.stamp_ns),
        Input::Tracks => cycle.tracks.map(|list| list.stamp_ns),
        Input::Detections => cycle.detections.map(|list| list.stamp_ns),
        Input::Grid => cycle.grid.map(|grid| grid.stamp_ns),
    };
    stamp_ns.is_some_and(|stamp_ns| is_young(cycle, stamp_ns))
}

fn is_young(cycle: &Cycle<'_>, stamp_ns: i64) -> bool {
    let age_ns = i128::from(cycle.now_ns) - i128::from(stamp_ns);
    0 <= age_ns && age_ns <= i128::from(cycle.parameters.max_age_ns)
}

/// Stage by stage, what the text says of it, given what became of the stages before.
fn follows_the_table(cycle: &Cycle<'_>, report: &Report) -> bool {
    let hardened = cycle.profile == Profile::HARDENED;
    let all_remote = cycle.configuration == Configuration::AllRemote;
    let mut ran = [false; 5];
    let mut failed = None;
    for (at, stage) in Stage::ALL.into_iter().enumerate() {
        let outcome = report.stages[at];
        // H-10: hardened, nothing blocks v.
        let blocked = match at {
            3 => ran[2],
            4 => (ran[2] || ran[3]) && !hardened,
            _ => false,
        };
        let is_there = |input: &Input| match (at, input) {
            // A received list goes to stage i whatever its age.
            (0, Input::Tracks) => cycle.tracks.is_some(),
            _ => is_current(cycle, *input),
        };
        let missing = READS[at].iter().find(|&input| !is_there(input));
        let expected = match (mark(cycle, at), missing) {
            (Dash, _) => Some(Outcome::NotScheduled),
            _ if failed.is_some() => Some(Outcome::Skipped(Reason::AfterFailure)),
            (Conditional, _) if blocked => Some(Outcome::Skipped(Reason::OtherStageRan)),
            (Conditional, Some(&input)) => Some(Outcome::Skipped(Reason::NoCurrent(input))),
            (Always, Some(&input)) => Some(Outcome::NotApplicable(input)),
            (Always | Conditional, None) => None,
        };
        ran[at] = expected.is_none();
        // H-04, H-14: what is compared at this place although stage iv does not run.
        let instead = at == 3 && law::fails_instead_of_iv(cycle, &outcome);
        let as_expected = match expected {
            None => matches!(outcome, Outcome::Passed | Outcome::Failed(_)),
            Some(_) if instead => {
                failed.is_none()
                    && mark(cycle, at) == Conditional
                    && is_current(cycle, Input::Trajectory)
            }
            Some(expected) => outcome == expected,
        };
        if !as_expected {
            return false;
        }
        if failed.is_none() && matches!(outcome, Outcome::Failed(_)) {
            failed = Some(FailedStage::Stage(stage));
        }
    }
    // H-02: tracks that stage i could not check are no obstacle check.
    let iii_counts = ran[2] && (!all_remote || is_current(cycle, Input::Detections));
    let unexamined = hardened
        && cycle.configuration != Configuration::Local
        && is_current(cycle, Input::Trajectory)
        && !(iii_counts || ran[3] || ran[4]);
    let failed = failed.or(unexamined.then_some(FailedStage::NoObstacleCheck));
    report.failed_stage == failed
}
