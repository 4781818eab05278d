//! H-02, H-05, H-10: no trajectory passes without a comparison with obstacles, and that with the grid is
//! not called off by a list of tracks that the remote side made, or by detections that show nothing.

use crate::input::profile::{HardenedRule, Profile};
use crate::input::scene::Scene;
use crate::report::Stage;
use crate::services::configuration::Configuration;

/// H-05, H-10: stage v is conditional in `PlanRemote`, too.
pub fn has_stage_v_in_plan_remote(profile: Profile) -> bool {
    profile.has(HardenedRule::H05) || profile.has(HardenedRule::H10)
}

/// H-10: in `AllRemote` and `PlanRemote` stage v runs whatever else ran.
pub fn runs_whatever_else_ran(scene: &Scene, stage: Stage) -> bool {
    scene.profile.has(HardenedRule::H10)
        && stage == Stage::V
        && matches!(scene.configuration, Configuration::AllRemote | Configuration::PlanRemote)
}

/// H-05: a current trajectory that no stage compared with obstacles. H-02: in `AllRemote` a stage iii
/// on a list that stage i did not check does not count.
pub fn no_obstacle_check(scene: &Scene, ran: &[Stage]) -> bool {
    let iii_counts = !scene.profile.has(HardenedRule::H02)
        || scene.configuration != Configuration::AllRemote
        || ran.contains(&Stage::I);
    let checked = (iii_counts && ran.contains(&Stage::Iii))
        || ran.contains(&Stage::Iv)
        || ran.contains(&Stage::V);
    scene.profile.has(HardenedRule::H05)
        && scene.configuration != Configuration::Local
        && scene.trajectory.is_some()
        && !checked
}
