//! `spec/2-offloading.md#quality-of-service`.

use mufasa_model::offloading::quality_of_service::{
    inter_arrival_ns, is_silent, is_violation, latency_ns,
};
use mufasa_model::offloading::requester::Action::{Activate, Deactivate, Drop};
use mufasa_model::offloading::requester::Group::Mot;
use mufasa_model::offloading::requester::{GroupState, Groups, Parameters};

use crate::{Cav, MOT, PROFILES, Profile, TICK, data, on, release, request, safe};

/// What a violation of MOT's session 1 does in the paper profile.
const LEFT: [mufasa_model::offloading::requester::Action; 3] = [
    Drop(Mot),
    mufasa_model::offloading::requester::Action::Release { station: 1, group: Mot, session: 1 },
    Activate(Mot),
];

/// QOS-06, QOS-07
#[test]
fn a_violation_returns_that_group_and_no_other_with_a_release_and_the_element_is_dropped() {
    for profile in PROFILES {
        let mut cav = Cav::remote(profile, Groups::ALL);
        let activated = profile == Profile::PAPER;
        let left = if activated { &LEFT[..] } else { &LEFT[..2] };
        assert_eq!(cav.at(1, data(1, Mot, 1, 2)), left);
        assert_eq!(cav.states(), (GroupState::Local, on(1, 2)));
        assert_eq!(cav.model().hold_until_ns(), None);
        assert_eq!(cav.at(2, TICK), [request(1, Mot, 3)], "no hold");
    }
}

/// FALL-10: over the whole range of 64 bits.
#[test]
fn differences_are_exact() {
    assert_eq!(latency_ns(i64::MAX, i64::MIN), i128::from(u64::MAX));
    assert_eq!(inter_arrival_ns(i64::MIN, i64::MAX), -i128::from(u64::MAX));
    let parameters =
        Parameters { l_max_ns: i64::MAX, dt_max_ns: i64::MAX, ..Parameters::default() };
    assert!(is_violation(&parameters, i64::MAX, i64::MAX, -1));
    assert!(!is_violation(&parameters, i64::MAX, i64::MAX, 0));
    assert!(is_violation(&parameters, i64::MAX, -1, i64::MAX));
    assert!(is_violation(&parameters, i64::MIN, i64::MAX, i64::MAX));
    assert!(is_silent(&parameters, i64::MAX, -1) && !is_silent(&parameters, i64::MIN, i64::MAX));
}

/// QOS-06 with H-08: services that never stopped do not start.
#[test]
fn a_violation_activates_the_local_services_exactly_when_they_stopped() {
    let mut cav = Cav::remote(Profile::HARDENED, MOT);
    cav.at(1, data(1, Mot, 1, 1));
    assert_eq!(cav.at(2, safe(Some(1), None)), [Deactivate(Mot)]);
    assert_eq!(cav.at(3, data(1, Mot, 1, 4)), LEFT);
    let mut cav = Cav::remote(Profile::HARDENED, MOT);
    cav.at(1, data(1, Mot, 1, 1));
    assert_eq!(cav.at(3, data(1, Mot, 1, 4)), [Drop(Mot), release(1, Mot, 1)]);
}
