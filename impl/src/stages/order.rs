//! Which stages run, in which order, and why the others do not, as a function of a few booleans: no
//! list and no number of the cycle decides here (`spec/3-stages.md#schedule`).

use crate::numbers::time::elapsed_ns;
use crate::report::{Input, Outcome, Reason, Stage};
use crate::services::configuration::Configuration;

/// Which inputs of a cycle are there; a list without items is (I-11). Source:
/// `spec/3-stages.md#schedule`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(clippy::struct_excessive_bools, reason = "five independent facts, each asked for by name")]
pub struct Given {
    /// There are tracks, whatever their age.
    pub tracks_of_any_age: bool,
    /// The tracks are current.
    pub tracks: bool,
    /// The trajectory is current.
    pub trajectory: bool,
    /// The detections are current.
    pub detections: bool,
    /// The grid is current.
    pub grid: bool,
}

/// Whether data with this stamp are current: 0 <= now - stamp <= `max_age`, all in ns, `max_age` at
/// most 60 s. Source: `spec/3-stages.md#schedule`.
pub fn is_current(stamp_ns: i64, now_ns: i64, max_age_ns: i64) -> bool {
    // SCHED-12; A-05
    let age_ns = elapsed_ns(stamp_ns, now_ns);
    0 <= age_ns && age_ns <= max_age_ns
}

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

/// How the stages of a cycle stand to each other.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Schedule {
    /// Of each stage, in their order.
    pub(crate) stages: [Scheduled; 5],
    /// Whether stage v is unnecessary where stage iii or iv ran.
    pub(crate) others_replace_v: bool,
}

impl Schedule {
    /// That of a configuration.
    pub(crate) fn of(configuration: Configuration) -> Self {
        let stages = Stage::ALL.map(|stage| scheduled(configuration, stage));
        Self { stages, others_replace_v: true }
    }
}

/// The table. Source: `spec/3-stages.md#schedule`.
const fn scheduled(configuration: Configuration, stage: Stage) -> Scheduled {
    use Configuration::{AllRemote, Local, MotRemote, PlanRemote};
    use Scheduled::{Always, Conditional, Never};
    match (stage, configuration) {
        // SCHED-01, SCHED-06
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

/// What became of the stages of a cycle.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Past {
    /// Which one failed.
    pub(crate) failed: Option<Stage>,
    pub(crate) ran_iii: bool,
    pub(crate) ran_iv: bool,
    pub(crate) ran_v: bool,
}

/// Goes through the stages of a cycle in their order. `fails`: whether the stage that has its turn
/// finds a safety issue; one that does not run is asked, too, with the reason.
pub(crate) fn in_order(
    schedule: Schedule,
    given: Given,
    mut fails: impl FnMut(Stage, Option<Idle>) -> bool,
) -> Past {
    let mut past = Past { failed: None, ran_iii: false, ran_iv: false, ran_v: false };
    // SCHED-02
    for (stage, scheduled) in Stage::ALL.into_iter().zip(schedule.stages) {
        let idle = past.idle(schedule.others_replace_v, given, (stage, scheduled));
        let runs = idle.is_none();
        match stage {
            Stage::I | Stage::Ii => {}
            Stage::Iii => past.ran_iii = runs,
            Stage::Iv => past.ran_iv = runs,
            Stage::V => past.ran_v = runs,
        }
        if fails(stage, idle) {
            past.failed = Some(stage);
        }
    }
    past
}

impl Past {
    /// Why a stage does not run, if it does not: after a failure none does (I-04), and one that lacks
    /// an input says so and does not fail (I-05).
    fn idle(
        self,
        others_replace_v: bool,
        given: Given,
        (stage, scheduled): (Stage, Scheduled),
    ) -> Option<Idle> {
        // SCHED-15
        match (scheduled, missing(given, stage)) {
            (Scheduled::Never, _) => Some(Idle::NotScheduled),
            // SCHED-03
            _ if self.failed.is_some() => Some(Idle::Skipped(Reason::AfterFailure)),
            (Scheduled::Conditional, _) if self.replaces(others_replace_v, stage) => {
                Some(Idle::Skipped(Reason::OtherStageRan))
            }
            // SCHED-11
            (Scheduled::Conditional, Some(input)) => Some(Idle::Skipped(Reason::NoCurrent(input))),
            // SCHED-10
            (Scheduled::Always, Some(input)) => Some(Idle::NotApplicable(input)),
            // SCHED-07
            (Scheduled::Always | Scheduled::Conditional, None) => None,
        }
    }

    /// Whether another stage made a conditional one unnecessary: by a run without a failure (I-06).
    const fn replaces(self, others_replace_v: bool, stage: Stage) -> bool {
        match stage {
            Stage::I | Stage::Ii | Stage::Iii => false,
            // SCHED-08
            Stage::Iv => self.ran_iii,
            // SCHED-09
            Stage::V => others_replace_v && (self.ran_iii || self.ran_iv),
        }
    }
}

/// The first input that the stage lacks. Tracks go to stage i whatever their age.
const fn missing(given: Given, stage: Stage) -> Option<Input> {
    let Given { tracks_of_any_age, tracks, trajectory, detections, grid } = given;
    let [first, second] = match stage {
        // SCHED-04
        Stage::I => [(tracks_of_any_age, Input::Tracks), (detections, Input::Detections)],
        // SCHED-05
        Stage::Ii => [(trajectory, Input::Trajectory); 2],
        Stage::Iii => [(trajectory, Input::Trajectory), (tracks, Input::Tracks)],
        Stage::Iv => [(trajectory, Input::Trajectory), (detections, Input::Detections)],
        Stage::V => [(trajectory, Input::Trajectory), (grid, Input::Grid)],
    };
    // SCHED-16
    match (first, second) {
        ((false, input), _) | (_, (false, input)) => Some(input),
        ((true, _), (true, _)) => None,
    }
}
