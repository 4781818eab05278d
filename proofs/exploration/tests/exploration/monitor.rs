//! The monitor beside one station, in cycles that an adversary decides: every law, and every scene that
//! shows that it is not empty.
//!
//! Covers, within the bounds of `proofs/exploration/src/monitor/period.rs`:
//! * MON-01, MON-05, MON-07, MON-08, MON-10
//! * MON-30, MON-32, MON-33
//! * MON-34, MON-35, MON-36, MON-38, MON-39
//! * MON-40, MON-41, MON-45

use mufasa_exploration::monitor::{Law, explore};
use mufasa_model::input::profile::Profile;
use mufasa_model::offloading::requester::Group;

fn laws_hold(profile: Profile, group: Group) {
    let outcome = explore(profile, group);
    println!("{profile:?} {group:?}: {} states, {} periods", outcome.states, outcome.periods);
    assert_eq!(outcome.broken, []);
    for law in Law::ALL {
        assert!(outcome.expected(law).count() > 0, "{}: what shows it?", law.name());
        assert!(outcome.shows(law), "{}: {:?}", law.name(), outcome.seen);
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
