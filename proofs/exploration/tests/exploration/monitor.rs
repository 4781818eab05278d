//! The monitor beside one station, in cycles that an adversary decides: every law, and every scene that
//! shows that it is not empty.
//!
//! Covers, within the bounds of `proofs/exploration/src/monitor/period.rs`:
//! * MON-01, MON-05, MON-07, MON-08, MON-10
//! * MON-30, MON-32, MON-33
//! * MON-34, MON-35, MON-36, MON-38, MON-39
//! * MON-40, MON-41, MON-45

use mufasa_exploration::monitor::{Scene, explore};
use mufasa_model::input::profile::{HardenedRule, Profile};
use mufasa_model::offloading::requester::Group;

fn laws_hold(profile: Profile, group: Group) {
    let outcome = explore(profile, group);
    println!(
        "{} states, {} periods, back within {}",
        outcome.states, outcome.periods, outcome.back_within
    );
    assert_eq!(outcome.broken, []);
    for scene in Scene::ALL {
        let seen = outcome.seen.iter().any(|(it, _)| *it == scene);
        let is_expected = scene != Scene::BrakeByPasses || profile.has(HardenedRule::H14);
        assert_eq!(seen, is_expected, "{}", scene.name());
    }
}

#[test]
fn the_laws_hold_for_plan() {
    laws_hold(Profile::HARDENED, Group::Plan);
    laws_hold(Profile::PAPER, Group::Plan);
}

#[test]
fn the_laws_hold_for_mot() {
    laws_hold(Profile::HARDENED, Group::Mot);
    laws_hold(Profile::PAPER, Group::Mot);
}
