//! What of a cycle comes out, and what the requester is told of it (`spec/monitor.md#monitor`).

use super::time::Time;
use crate::offloading::requester::{Running, Sessions};
use crate::report::{InvalidInput, Outcome, Problem, Report};

/// What comes out of a cycle, and its verdict. Source: `spec/monitor.md#monitor`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Released {
    /// No stage failed, and there was no error.
    pub is_safe: bool,
    /// Whether the tracks of the station come out.
    pub tracks: bool,
    /// Whether the trajectory that was checked comes out.
    pub trajectory: bool,
    /// The sessions of the remote data that come out.
    pub sessions: Sessions,
}

impl Released {
    /// Of MOT and PLAN: the running session of a remote group, and whether what the cycle looked at was there and current;
    /// whether it had what a trajectory is examined with, too. Source: `spec/monitor.md#monitor`.
    pub fn of(
        report: &Result<Report, InvalidInput>,
        [mot, plan]: [Option<i64>; 2],
        [has_tracks, has_trajectory]: [bool; 2],
        has_seen: bool,
    ) -> Self {
        // MON-10
        let is_safe = report.as_ref().is_ok_and(|report| report.failed_stage.is_none());
        // MON-02: in a safe cycle with remote tracks stage i passed or had no detections; only a
        // study leaves it out.
        let was_compared = report
            .as_ref()
            .is_ok_and(|report| !matches!(report.stages, [Outcome::NotApplicable(_), ..]));
        // MON-01, MON-05
        let tracks = has_tracks && is_safe && was_compared && mot.is_some();
        // MON-01, MON-04, MON-05, MON-66, SCHED-18
        let trajectory = has_trajectory && has_seen && is_safe && (mot.is_some() || plan.is_some());
        // MON-11
        let sessions = Sessions { mot: mot.filter(|_| tracks), plan: plan.filter(|_| trajectory) };
        Self { is_safe, tracks, trajectory, sessions }
    }
}

/// Whether the report counts: the detections of the cycle fit, which would be missing in later cycles, and its own tracks.
///
/// Errors: that of the report; a list does not fit. Source: `spec/monitor.md#monitor`.
pub fn if_kept(
    report: &Result<Report, InvalidInput>,
    [detections_fit, tracks_fit]: [bool; 2],
) -> Result<(), InvalidInput> {
    let field = if detections_fit { "tracks.items" } else { "detections.items" };
    let own = InvalidInput { field, index: None, problem: Problem::ScratchTooSmall };
    let fits = detections_fit && tracks_fit;
    match report {
        // MON-19, MON-65
        Ok(_) if !fits => Err(own),
        Ok(_) => Ok(()),
        // What does not fit is too much for the scratch, too.
        Err(problem) if !fits && problem.problem == own.problem => Err(own),
        Err(problem) => Err(*problem),
    }
}

/// Whether the element with this station, session and generation time is the last one that the requester used in the
/// session. Source: `spec/monitor.md#monitor`.
pub fn is_last_used(running: &Running, station: i64, session: i64, generated: Time) -> bool {
    // MON-07
    let generated_ns = Some(generated.as_nanoseconds());
    (station, session, generated_ns) == (running.station, running.session, running.last_used_ns)
}

/// Whether the last tick since the cycle before is in time, ns. Source: `spec/monitor.md#monitor`.
pub fn is_ticked(
    ticked_ns: Option<i64>,
    before_ns: Option<i64>,
    now_ns: i64,
    dt_max_ns: i64,
) -> bool {
    ticked_ns.is_some_and(|tick_ns| {
        // MON-45
        let is_set_back = before_ns.is_some_and(|before_ns| tick_ns < before_ns);
        let since_ns = now_ns.checked_sub(tick_ns);
        !is_set_back && since_ns.is_some_and(|it| (0..=dt_max_ns).contains(&it))
    })
}
