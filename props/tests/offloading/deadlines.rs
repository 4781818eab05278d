//! `spec/2-offloading.md#requester`: confirmations, rejections, deadlines.

use mufasa_model::offloading::requester::Group::{Mot, Plan};
use mufasa_model::offloading::requester::{GroupState, Groups, Parameters};

use crate::{Cav, MOT, PROFILES, TICK, UNSAFE, confirm, offer, reject, release, request, withdraw};

const TIMEOUT_NS: i64 = 500_000_000;

/// REQ-11
#[test]
fn a_confirmation_of_the_running_session_is_ignored() {
    for profile in PROFILES {
        let mut cav = Cav::remote(profile, Groups::ALL);
        cav.ignores(1, confirm(1, Mot, 1));
        cav.ignores(TIMEOUT_NS, confirm(1, Plan, 2));
    }
}

/// REQ-12, REQ-13: too late, another session, station or group; requested,
/// remote or local.
#[test]
fn any_other_confirmation_is_answered_with_a_release_of_the_session_it_names_and_nothing_else() {
    for profile in PROFILES {
        let answered = |mut cav: Cav, t_ns, station, group, session| {
            let before = cav.model().clone();
            let released = [release(station, group, session)];
            assert_eq!(cav.at(t_ns, confirm(station, group, session)), released);
            assert_eq!(*cav.model(), before);
        };
        answered(Cav::requested(profile, Groups::ALL), TIMEOUT_NS, 1, Mot, 1);
        answered(Cav::requested(profile, Groups::ALL), 1, 1, Mot, 2);
        answered(Cav::requested(profile, Groups::ALL), 1, 2, Mot, 1);
        answered(Cav::requested(profile, Groups::ALL), 1, 1, Plan, 1);
        answered(Cav::remote(profile, Groups::ALL), 1, 1, Mot, 2);
        answered(Cav::remote(profile, Groups::ALL), 1, 2, Mot, 1);
        answered(Cav::new(profile, Parameters::default()), 1, 9, Plan, 4);
    }
}

/// REQ-16
#[test]
fn any_other_rejection_is_ignored() {
    for profile in PROFILES {
        for (station, group, session) in [(1, Mot, 2), (2, Mot, 1), (1, Plan, 1)] {
            let other = reject(station, group, session);
            Cav::requested(profile, Groups::ALL).ignores(1, other);
            Cav::new(profile, Parameters::default()).ignores(1, other);
        }
        Cav::remote(profile, Groups::ALL).ignores(1, reject(1, Mot, 1));
    }
}

/// FALL-09
#[test]
fn deadlines_saturate_at_the_limits_of_64_bits() {
    let mut cav = Cav::paper();
    cav.at(0, offer(1, MOT));
    cav.at(i64::MAX - 1, TICK);
    let saturated = GroupState::Requested { station: 1, session: 1, deadline_ns: i64::MAX };
    assert_eq!(cav.model().state(Mot), saturated);
    cav.ignores(i64::MAX - 1, TICK);
    cav.ignores(i64::MIN, TICK);
    assert_eq!(cav.at(i64::MAX, TICK), [release(1, Mot, 1)]);
}

/// PROTO-11: session 1 ended in each possible way,
/// session 2 is requested or runs, and every message of session 1 arrives late.
#[test]
fn a_message_of_an_ended_session_does_not_change_a_later_one() {
    for profile in PROFILES {
        for end in [UNSAFE, withdraw(1), offer(1, Groups::NONE), reject(1, Mot, 1)] {
            for running in [false, true] {
                let mut cav = Cav::requested(profile, MOT);
                let later = 20_000_000_000;
                cav.at(1, end);
                cav.at(later, offer(1, MOT));
                assert_eq!(cav.at(later, TICK), [request(1, Mot, 2)]);
                if running {
                    cav.at(later, confirm(1, Mot, 2));
                }
                let before = cav.model().clone();
                assert_eq!(cav.at(later, confirm(1, Mot, 1)), [release(1, Mot, 1)]);
                cav.ignores(later, reject(1, Mot, 1));
                cav.at(later, crate::data(1, Mot, 1, later));
                assert_eq!(*cav.model(), before);
            }
        }
    }
}
