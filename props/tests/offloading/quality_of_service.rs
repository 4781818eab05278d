//! `spec/2-offloading.md#quality-of-service`. Defaults: `l_max` 50 ms, `dt_max` 100 ms.

use mufasa_model::offloading::quality_of_service::{
    inter_arrival_ns, is_silent, is_violation, latency_ns,
};
use mufasa_model::offloading::requester::Action::{Activate, Deactivate, Drop};
use mufasa_model::offloading::requester::Group::{Mot, Plan};
use mufasa_model::offloading::requester::{GroupState, Groups, Parameters};

use crate::{Cav, MOT, PROFILES, Profile, TICK, confirm, data, offer, on, release, request, safe};

const L_MAX_NS: i64 = 50_000_000;
const DT_MAX_NS: i64 = 100_000_000;

/// What a violation of MOT's session 1 does in the paper profile.
const LEFT: [mufasa_model::offloading::requester::Action; 3] = [
    Drop(Mot),
    mufasa_model::offloading::requester::Action::Release { station: 1, group: Mot, session: 1 },
    Activate(Mot),
];

/// `spec/2-offloading.md#quality-of-service.2`
#[test]
fn latency_above_l_max_is_a_violation_and_equality_is_not() {
    let mut cav = Cav::remote(Profile::PAPER, MOT);
    assert_eq!(cav.at(60_000_000, data(1, Mot, 1, 60_000_000 - L_MAX_NS)), []);
    assert_eq!(cav.at(60_000_000, data(1, Mot, 1, 60_000_000 - L_MAX_NS - 1)), LEFT);
}

/// `spec/2-offloading.md#quality-of-service.2`: since the activation, then since an arrival.
#[test]
fn inter_arrival_time_above_dt_max_is_a_violation_and_equality_is_not() {
    let t_ns = DT_MAX_NS;
    let mut cav = Cav::remote(Profile::PAPER, MOT);
    assert_eq!(cav.at(t_ns, data(1, Mot, 1, t_ns)), []);
    assert_eq!(cav.at(2 * t_ns, data(1, Mot, 1, 2 * t_ns)), []);
    assert_eq!(cav.at(3 * t_ns + 1, data(1, Mot, 1, 3 * t_ns + 1)), LEFT);
    let mut cav = Cav::remote(Profile::PAPER, MOT);
    assert_eq!(cav.at(t_ns + 1, data(1, Mot, 1, t_ns + 1)), LEFT);
}

/// `spec/2-offloading.md#quality-of-service.1`: an element out of order counts as an arrival.
#[test]
fn every_element_of_the_running_session_is_an_arrival() {
    let mut cav = Cav::remote(Profile::PAPER, MOT);
    assert_eq!(cav.at(60_000_000, data(1, Mot, 1, 60_000_000)), []);
    assert_eq!(cav.at(100_000_000, data(1, Mot, 1, 60_000_000)), [Drop(Mot)]);
    assert_eq!(cav.at(200_000_000, data(1, Mot, 1, 200_000_000)), []);
}

/// `spec/2-offloading.md#quality-of-service.1`: an old element that is also late is a violation.
#[test]
fn an_element_is_checked_for_latency_and_inter_arrival_time_first_and_for_its_order_then() {
    let mut cav = Cav::remote(Profile::PAPER, MOT);
    cav.at(40_000_000, data(1, Mot, 1, 40_000_000));
    assert_eq!(cav.at(90_000_001, data(1, Mot, 1, 40_000_000)), LEFT, "latency");
    let parameters = Parameters { l_max_ns: i64::MAX, ..Parameters::default() };
    let mut patient = Cav::new(Profile::PAPER, parameters);
    patient.at(0, offer(1, MOT));
    patient.at(0, TICK);
    patient.at(0, confirm(1, Mot, 1));
    patient.at(10, data(1, Mot, 1, 10));
    assert_eq!(patient.at(10 + DT_MAX_NS + 1, data(1, Mot, 1, 10)), LEFT, "inter-arrival time");
}

/// `spec/2-offloading.md#quality-of-service.1`
#[test]
fn other_data_are_no_arrivals() {
    let mut cav = Cav::remote(Profile::PAPER, MOT);
    for foreign in [data(2, Mot, 1, 90_000_000), data(1, Mot, 9, 90_000_000)] {
        cav.at(90_000_000, foreign);
    }
    assert_eq!(cav.at(DT_MAX_NS + 1, TICK), LEFT[1..]);
}

/// `spec/2-offloading.md#quality-of-service.3`
#[test]
fn silence_longer_than_dt_max_is_a_violation_at_the_first_tick_that_can_tell() {
    let mut cav = Cav::remote(Profile::PAPER, MOT);
    cav.ignores(DT_MAX_NS, TICK);
    assert_eq!(cav.at(DT_MAX_NS + 1, TICK), LEFT[1..], "since the activation");
    let mut cav = Cav::remote(Profile::PAPER, MOT);
    cav.at(50, data(1, Mot, 1, 50));
    cav.ignores(50 + DT_MAX_NS, TICK);
    assert_eq!(cav.at(51 + DT_MAX_NS, TICK), LEFT[1..], "since the last arrival");
}

/// `spec/2-offloading.md#quality-of-service.3`: the activation is the confirmation, not the
/// request.
#[test]
fn silence_is_counted_from_the_activation() {
    let mut cav = Cav::requested(Profile::PAPER, MOT);
    cav.at(400_000_000, confirm(1, Mot, 1));
    cav.ignores(500_000_000, TICK);
    assert_eq!(cav.at(500_000_001, TICK), LEFT[1..]);
}

/// `spec/2-offloading.md#quality-of-service.4`
#[test]
fn a_generation_time_later_than_the_arrival_time_is_a_violation() {
    let mut cav = Cav::remote(Profile::PAPER, MOT);
    assert_eq!(cav.at(10, data(1, Mot, 1, 10)), []);
    assert_eq!(cav.at(11, data(1, Mot, 1, 12)), LEFT);
}

/// `spec/2-offloading.md#quality-of-service.5`
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

/// `spec/2-offloading.md#quality-of-service.6`
#[test]
fn an_element_not_generated_later_than_the_last_one_used_since_the_activation_is_dropped() {
    let mut cav = Cav::remote(Profile::PAPER, Groups::ALL);
    assert_eq!(cav.at(10, data(1, Mot, 1, 5)), []);
    assert_eq!(cav.at(11, data(1, Mot, 1, 5)), [Drop(Mot)]);
    assert_eq!(cav.at(11, data(1, Mot, 1, 4)), [Drop(Mot)]);
    assert_eq!(cav.at(11, data(1, Plan, 2, 4)), [], "another group");
    assert_eq!(cav.at(12, data(1, Mot, 1, 6)), []);
    cav.at(13, crate::withdraw(1));
    cav.at(13, offer(1, MOT));
    cav.at(13, TICK);
    assert_eq!(cav.at(13, confirm(1, Mot, 3)), [Deactivate(Mot)]);
    assert_eq!(cav.at(14, data(1, Mot, 3, 2)), [], "the first since this activation");
}

/// `spec/2-offloading.md#fallback.5`: over the whole range of 64 bits.
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

/// `spec/2-offloading.md#quality-of-service.5` with H-08: services that never stopped do not start.
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
