//! Which stages the hardened profile runs, and what counts as an obstacle check (H-02, H-05, H-10
//! of `spec/hardened/README.md`).

use crate::input::profile::{HardenedRule, Profile};
use crate::report::{FailedStage, Stage};
use crate::services::configuration::Configuration;
use crate::stages::order::{Given, Past, Schedule, Scheduled};

/// H-05, H-10: stage v is conditional in `PlanRemote`, too. H-10: what stages iii and iv did does not keep
/// stage v from running, where it is conditional.
pub(crate) fn hardened(
    profile: Profile,
    configuration: Configuration,
    schedule: Schedule,
) -> Schedule {
    let [h05, h10] = [HardenedRule::H05, HardenedRule::H10].map(|rule| profile.has(rule));
    let [i, ii, iii, iv, v] = schedule.stages;
    // H-05.1, H-10.1
    let has_v = configuration == Configuration::PlanRemote && (h05 || h10);
    let v = if has_v { Scheduled::Conditional } else { v };
    // H-02.1, H-02.2: stage iii stays as it is. H-10.1: stage v runs beside it
    Schedule { stages: [i, ii, iii, iv, v], others_replace_v: !h10 }
}

/// H-05: a current trajectory that nothing compared with obstacles, in a cycle that no stage
/// failed. H-02: in `AllRemote` a stage iii on tracks that stage i could not check, because no
/// detections are current, does not count.
pub(crate) fn no_obstacle_check(
    profile: Profile,
    configuration: Configuration,
    (given, past): (Given, Past),
) -> Option<FailedStage> {
    let Past { ran_iii, ran_iv, ran_v, .. } = past;
    let asks_stage_i = profile.has(HardenedRule::H02) && configuration == Configuration::AllRemote;
    let has_stage_i = given.detections && profile.runs(Stage::I);
    // H-02.3
    let checked_iii = ran_iii && (!asks_stage_i || has_stage_i);
    // H-05.2; the gap of stage iv (H-04.3) and the fail-safe rule (H-14.53) are no run of it
    let applies =
        profile.has(HardenedRule::H05) && configuration != Configuration::Local && given.trajectory;
    let fails = applies && !(checked_iii || ran_iv || ran_v);
    fails.then_some(FailedStage::NoObstacleCheck)
}
