//! The CAV's own trajectory, where everything is local (`spec/monitor.md`, local services).

use super::Judge;
use super::elements::is_current;
use super::messages::Brake;
use crate::input::cycle::Cycle;
use crate::report::{InvalidInput, Report};

/// Examines the CAV's own trajectory: `own` is the cycle as in `PlanRemote`, with its own tracks and trajectory, and
/// the history as the cycle leaves it. [MON-47] [MON-48] [MON-50] [MON-51]
///
/// `misfit` is what of the input is refused beside the stages.
pub fn examine(own: &Cycle, misfit: Option<&InvalidInput>, judge: Judge<'_>) -> Option<Brake> {
    match (judge(own), misfit) {
        (Err(problem), _) => Some(Brake::Invalid(problem)),
        (Ok(_), Some(problem)) => Some(Brake::Invalid(problem.clone())),
        (Ok(report), None) => failed(&report)
            .or_else(|| (!has_current_trajectory(own)).then_some(Brake::NoTrajectory)),
    }
}

fn failed(report: &Report) -> Option<Brake> {
    let stage = report.failed_stage?;
    if let Some(problem) = &report.input {
        return Some(Brake::Invalid(problem.clone()));
    }
    Some(Brake::Failed(stage, report.witness().cloned()))
}

fn has_current_trajectory(own: &Cycle) -> bool {
    let max_age_ns = own.parameters.max_age_ns;
    own.trajectory.as_ref().is_some_and(|it| is_current(own.now_ns, it.stamp_ns, max_age_ns))
}
