//! What comes out of a cycle.

use mufasa::input::cycle::{Track, TrajectoryPoint};
use mufasa::monitor::Brake;
use mufasa::offloading::requester::Action;
use mufasa::report::{FailedStage, InvalidInput, Report};
use mufasa_model::input::cycle::Cycle;

/// What a cycle lets control have.
#[derive(Debug, Default)]
pub struct Decided {
    /// Whether data may be used; always, where nothing is checked.
    pub is_safe: bool,
    /// The report of the stages, or what was wrong with the input; none where nothing is checked.
    pub report: Option<Result<Report, InvalidInput>>,
    /// The trajectory that control may follow. None in `Local` where something is checked: there the
    /// CAV's own is not.
    pub trajectory: Option<Vec<TrajectoryPoint>>,
    /// By when control has to brake along it where nothing newer has come, ns (F-47).
    pub brake_by_ns: Option<i64>,
    /// Whether control has to brake in place of following the CAV's own plan (F-48).
    pub brake: Option<Brake>,
    /// Remote tracks that the CAV's own planner may use, with their stamp, ns.
    pub tracks: Option<(i64, Vec<Track>)>,
    /// What is to be done.
    pub actions: Vec<Action>,
    /// The cycle that the monitor was asked about, as the model has it, where it is recorded.
    pub record: Option<Box<Cycle>>,
}

impl Decided {
    /// Where a safety issue was found.
    pub fn failed_stage(&self) -> Option<FailedStage> {
        match self.report {
            Some(Ok(report)) => report.failed_stage,
            Some(Err(_)) => Some(FailedStage::Input),
            None => None,
        }
    }

    /// `failed_stage` as a number: 0 for nothing found, or nothing checked; 1 to 5 for the stage that failed; 6 for no
    /// obstacle check; 7 for the input.
    pub fn code(&self) -> u8 {
        match self.failed_stage() {
            None => 0,
            // The stages are declared in their order.
            Some(FailedStage::Stage(stage)) => 1 + stage as u8,
            Some(FailedStage::NoObstacleCheck) => 6,
            Some(FailedStage::Input) => 7,
        }
    }
}
