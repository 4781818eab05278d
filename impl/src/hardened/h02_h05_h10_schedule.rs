//! Which stages the hardened profile runs, and what counts as an obstacle check (H-02, H-05, H-10
//! of `spec/3-stages.md#hardened-profile`).

use crate::input::cycle::Cycle;
use crate::input::profile::Profile;
use crate::report::FailedStage;
use crate::services::configuration::Configuration;

/// H-05: stage v is conditional in `PlanRemote`, too.
pub(crate) fn has_stage_v_in_plan_remote(cycle: &Cycle<'_>) -> bool {
    cycle.profile == Profile::Hardened
}

/// H-10: in `AllRemote` what stage iii did does not keep stage iv from running.
pub(crate) fn stage_iii_replaces_iv(cycle: &Cycle<'_>) -> bool {
    cycle.profile == Profile::Paper || cycle.configuration != Configuration::AllRemote
}

/// H-10: what stages iii and iv did does not keep stage v from running, where it is conditional.
pub(crate) fn others_replace_stage_v(cycle: &Cycle<'_>) -> bool {
    cycle.profile == Profile::Paper
}

/// What of a cycle that no stage failed H-05 asks for.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ObstacleChecks {
    /// A trajectory is current.
    pub(crate) trajectory: bool,
    /// Detections are current, so that stage i could check received tracks.
    pub(crate) detections: bool,
    /// Stages iii, iv and v ran.
    pub(crate) ran: [bool; 3],
}

/// H-05: a current trajectory that nothing compared with obstacles. H-02: in `AllRemote` a stage
/// iii on tracks that stage i could not check does not count.
pub(crate) fn no_obstacle_check(cycle: &Cycle<'_>, checks: ObstacleChecks) -> Option<FailedStage> {
    let ObstacleChecks { trajectory, detections, ran: [ran_iii, ran_iv, ran_v] } = checks;
    let all_remote = cycle.configuration == Configuration::AllRemote;
    let checked_iii = ran_iii && (!all_remote || detections);
    let applies = cycle.profile == Profile::Hardened
        && cycle.configuration != Configuration::Local
        && trajectory;
    let fails = applies && !(checked_iii || ran_iv || ran_v);
    fails.then_some(FailedStage::NoObstacleCheck)
}
