//! H-02, H-05, H-10: no trajectory passes without a comparison with obstacles, and that with the grid is
//! not called off by a list of tracks that the remote side made, or by detections that show nothing.

use crate::input::profile::{HardenedRule, Profile};
use crate::input::scene::Scene;
use crate::report::Stage;
use crate::services::configuration::Configuration;
use crate::stages::{self, Entry, Scheduled};

/// The schedule of the paper as the rules change it, without the stages that a study leaves out.
pub fn schedule(profile: Profile, configuration: Configuration) -> [Entry; 5] {
    stages::schedule(configuration).map(|entry| match entry.stage {
        stage if !profile.runs(stage) => Entry { scheduled: Scheduled::Never, ..entry },
        Stage::V => stage_v(profile, configuration, entry),
        Stage::I | Stage::Ii | Stage::Iii | Stage::Iv => entry,
    })
}

/// H-05, H-10: stage v is conditional in `PlanRemote`, too. H-10: nothing makes it unnecessary.
fn stage_v(profile: Profile, configuration: Configuration, paper: Entry) -> Entry {
    let is_asked = profile.has(HardenedRule::H05) || profile.has(HardenedRule::H10);
    let is_added = is_asked && configuration == Configuration::PlanRemote;
    let always = runs_whatever_else_ran(profile, configuration);
    Entry {
        scheduled: if is_added { Scheduled::Conditional } else { paper.scheduled },
        unless_ran: if always { &[] } else { paper.unless_ran },
        ..paper
    }
}

/// H-10: in `AllRemote` and `PlanRemote` stage v runs whatever else ran.
fn runs_whatever_else_ran(profile: Profile, configuration: Configuration) -> bool {
    profile.has(HardenedRule::H10)
        && matches!(configuration, Configuration::AllRemote | Configuration::PlanRemote)
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
