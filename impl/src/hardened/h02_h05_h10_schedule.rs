//! Which stages the hardened profile runs, and what counts as an obstacle check (H-02, H-05, H-10
//! of `spec/3-stages.md#hardened-profile`).

use crate::input::profile::Profile;
use crate::report::FailedStage;
use crate::services::configuration::Configuration;
use crate::stages::given::Given;

/// H-05: stage v is conditional in `PlanRemote`, too.
pub(crate) fn has_stage_v_in_plan_remote(profile: Profile) -> bool {
    profile == Profile::Hardened
}

/// H-10: what stages iii and iv did does not keep stage v from running, where it is conditional.
pub(crate) fn others_replace_stage_v(given: Given) -> bool {
    given.profile == Profile::Paper
}

/// H-05: a current trajectory that nothing compared with obstacles, in a cycle that no stage
/// failed. H-02: in `AllRemote` a stage iii on tracks that stage i could not check, because no
/// detections are current, does not count. `ran`: whether stages iii, iv and v ran.
pub(crate) fn no_obstacle_check(
    given: Given,
    [ran_iii, ran_iv, ran_v]: [bool; 3],
) -> Option<FailedStage> {
    let all_remote = given.configuration == Configuration::AllRemote;
    let checked_iii = ran_iii && (!all_remote || given.detections);
    let applies = given.profile == Profile::Hardened
        && given.configuration != Configuration::Local
        && given.trajectory;
    let fails = applies && !(checked_iii || ran_iv || ran_v);
    fails.then_some(FailedStage::NoObstacleCheck)
}
