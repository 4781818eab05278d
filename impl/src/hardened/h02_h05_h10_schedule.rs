//! Which stages the hardened profile runs, and what counts as an obstacle check (H-02, H-05, H-10
//! of `spec/3-stages.md#hardened-profile`).

use crate::input::profile::{HardenedRule, Profile};
use crate::report::{FailedStage, Stage};
use crate::services::configuration::Configuration;
use crate::stages::given::Given;

/// H-05, H-10: stage v is conditional in `PlanRemote`, too.
pub(crate) fn has_stage_v_in_plan_remote(profile: Profile) -> bool {
    profile.has(HardenedRule::H05) || profile.has(HardenedRule::H10)
}

/// H-10: what stages iii and iv did does not keep stage v from running, where it is conditional.
pub(crate) fn others_replace_stage_v(given: Given) -> bool {
    !given.profile.has(HardenedRule::H10)
}

/// H-05: a current trajectory that nothing compared with obstacles, in a cycle that no stage
/// failed. H-02: in `AllRemote` a stage iii on tracks that stage i could not check, because no
/// detections are current, does not count. `ran`: whether stages iii, iv and v ran.
pub(crate) fn no_obstacle_check(
    given: Given,
    [ran_iii, ran_iv, ran_v]: [bool; 3],
) -> Option<FailedStage> {
    let profile = given.profile;
    let asks_stage_i =
        profile.has(HardenedRule::H02) && given.configuration == Configuration::AllRemote;
    let has_stage_i = given.detections && profile.runs(Stage::I);
    let checked_iii = ran_iii && (!asks_stage_i || has_stage_i);
    let applies = profile.has(HardenedRule::H05)
        && given.configuration != Configuration::Local
        && given.trajectory;
    let fails = applies && !(checked_iii || ran_iv || ran_v);
    fails.then_some(FailedStage::NoObstacleCheck)
}
