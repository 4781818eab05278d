//! Which stages run, in which order, and why the others do not, as a function of a few booleans: no
//! list and no number of the cycle decides here (`spec/3-stages.md#schedule`).

use crate::hardened::h02_h05_h10_schedule::{
    has_stage_v_in_plan_remote, no_obstacle_check, others_replace_stage_v,
};
use crate::input::profile::Profile;
use crate::report::{FailedStage, Input, Outcome, Reason, Stage};
use crate::services::configuration::Configuration;
use crate::stages::given::Given;

/// How a stage stands in the table. Source: `spec/3-stages.md#schedule`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scheduled {
    /// Whenever its inputs are there.
    Always,
    /// Unless another stage makes it unnecessary.
    Conditional,
    /// It is not part of the configuration.
    Never,
}

/// Why a stage does not run. Source: `spec/3-stages.md#schedule`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Idle {
    /// As `Outcome::Skipped`.
    Skipped(Reason),
    /// As `Outcome::NotApplicable`.
    NotApplicable(Input),
    /// As `Outcome::NotScheduled`.
    NotScheduled,
}

impl From<Idle> for Outcome {
    fn from(idle: Idle) -> Self {
        match idle {
            Idle::Skipped(reason) => Self::Skipped(reason),
            Idle::NotApplicable(input) => Self::NotApplicable(input),
            Idle::NotScheduled => Self::NotScheduled,
        }
    }
}

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

/// Goes through the stages of a cycle in their order. `fails`: whether the stage that has its turn
/// finds a safety issue. What makes the cycle unsafe. Source: `spec/3-stages.md#schedule`.
pub fn in_order(given: Given, mut fails: impl FnMut(Stage, Turn) -> bool) -> Option<FailedStage> {
    let mut past = Past { failed: None, ran_iii: false, ran_iv: false, ran_v: false };
    for stage in Stage::ALL {
        let turn = past.turn(given, stage);
        let runs = turn == Turn::Run;
        match stage {
            Stage::I | Stage::Ii => {}
            Stage::Iii => past.ran_iii = runs,
            Stage::Iv => past.ran_iv = runs,
            Stage::V => past.ran_v = runs,
        }
        if fails(stage, turn) {
            past.failed = Some(stage);
        }
    }
    match past.failed {
        Some(stage) => Some(FailedStage::Stage(stage)),
        None => no_obstacle_check(given, [past.ran_iii, past.ran_iv, past.ran_v]),
    }
}

/// What became of the stages before.
#[derive(Clone, Copy)]
struct Past {
    failed: Option<Stage>,
    ran_iii: bool,
    ran_iv: bool,
    ran_v: bool,
}

impl Past {
    fn turn(self, given: Given, stage: Stage) -> Turn {
        let scheduled = scheduled(given.profile, given.configuration, stage);
        let idle = match (scheduled, missing(given, stage)) {
            (Scheduled::Never, _) => Idle::NotScheduled,
            _ if self.failed.is_some() => Idle::Skipped(Reason::AfterFailure),
            (Scheduled::Conditional, _) if self.replaces(given, stage) => {
                Idle::Skipped(Reason::OtherStageRan)
            }
            (Scheduled::Conditional, Some(input)) => Idle::Skipped(Reason::NoCurrent(input)),
            (Scheduled::Always, Some(input)) => Idle::NotApplicable(input),
            (Scheduled::Always | Scheduled::Conditional, None) => return Turn::Run,
        };
        if stage == Stage::Iv && self.failed.is_none() { Turn::Gap(idle) } else { Turn::Rest(idle) }
    }

    /// Whether another stage made a conditional one unnecessary.
    fn replaces(self, given: Given, stage: Stage) -> bool {
        match stage {
            Stage::I | Stage::Ii | Stage::Iii => false,
            Stage::Iv => self.ran_iii,
            Stage::V => (self.ran_iii || self.ran_iv) && others_replace_stage_v(given),
        }
    }
}

/// The first input that the stage lacks. Tracks go to stage i whatever their age.
const fn missing(given: Given, stage: Stage) -> Option<Input> {
    let Given { tracks_of_any_age, tracks, trajectory, detections, grid, .. } = given;
    let [first, second] = match stage {
        Stage::I => [(tracks_of_any_age, Input::Tracks), (detections, Input::Detections)],
        Stage::Ii => [(trajectory, Input::Trajectory); 2],
        Stage::Iii => [(trajectory, Input::Trajectory), (tracks, Input::Tracks)],
        Stage::Iv => [(trajectory, Input::Trajectory), (detections, Input::Detections)],
        Stage::V => [(trajectory, Input::Trajectory), (grid, Input::Grid)],
    };
    match (first, second) {
        ((false, input), _) | (_, (false, input)) => Some(input),
        ((true, _), (true, _)) => None,
    }
}

/// The table. Source: `spec/3-stages.md#schedule`.
pub fn scheduled(profile: Profile, configuration: Configuration, stage: Stage) -> Scheduled {
    use Configuration::{AllRemote, Local, MotRemote, PlanRemote};
    use Scheduled::{Always, Conditional, Never};
    if !profile.runs(stage) {
        return Never;
    }
    match (stage, configuration) {
        (Stage::V, PlanRemote) if has_stage_v_in_plan_remote(profile) => Conditional,
        (_, Local) | (Stage::I | Stage::V, PlanRemote) | (Stage::Iii, MotRemote) => Never,
        (Stage::I, MotRemote | AllRemote)
        | (Stage::Ii, MotRemote | AllRemote | PlanRemote)
        | (Stage::Iii, PlanRemote)
        | (Stage::V, MotRemote) => Always,
        (Stage::Iii | Stage::V, AllRemote) | (Stage::Iv, MotRemote | AllRemote | PlanRemote) => {
            Conditional
        }
    }
}
