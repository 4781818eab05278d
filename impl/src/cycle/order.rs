//! The order of the stages with what the rules of a profile change of it, as a function of a few booleans
//! (`spec/3-stages.md#schedule`).

use crate::hardened::h02_h05_h10_schedule::{hardened, no_obstacle_check};
use crate::input::profile::Profile;
use crate::report::{FailedStage, Stage};
use crate::services::configuration::Configuration;
pub use crate::stages::order::{Given, Idle, is_current};
use crate::stages::order::{Schedule, Scheduled, in_order};

/// Whose turn it is, and whether it runs. Source: `spec/3-stages.md#schedule`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Turn {
    /// The stage runs.
    Run,
    /// It does not.
    Rest(Idle),
    /// It does not, but at its place the gap is compared, where H-04 says so, and H-14 runs.
    Gap(Idle),
}

/// How the stages stand in a profile: in the table of the paper, as the rules change it, and without
/// those that a study leaves out.
pub(crate) fn schedule(profile: Profile, configuration: Configuration) -> Schedule {
    let schedule = hardened(profile, configuration, Schedule::of(configuration));
    let mut stages = schedule.stages;
    for (scheduled, stage) in stages.iter_mut().zip(Stage::ALL) {
        if !profile.runs(stage) {
            *scheduled = Scheduled::Never;
        }
    }
    Schedule { stages, ..schedule }
}

/// Goes through the stages of a cycle in their order. `fails`: whether the stage that has its turn
/// finds a safety issue. What makes the cycle unsafe. Source: `spec/3-stages.md#schedule`.
pub fn decide(
    profile: Profile,
    configuration: Configuration,
    given: Given,
    mut fails: impl FnMut(Stage, Turn) -> bool,
) -> Option<FailedStage> {
    let mut failed = false;
    let past = in_order(schedule(profile, configuration), given, |stage, idle| {
        let turn = match idle {
            None => Turn::Run,
            Some(idle) if stage == Stage::Iv && !failed => Turn::Gap(idle),
            Some(idle) => Turn::Rest(idle),
        };
        let fails = fails(stage, turn);
        failed |= fails;
        fails
    });
    // SCHED-17
    match past.failed {
        Some(stage) => Some(FailedStage::Stage(stage)),
        None => no_obstacle_check(profile, configuration, (given, past)),
    }
}
