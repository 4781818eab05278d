//! `spec/2-offloading.md#requester`: offers, requests, area, data, withdrawal, loss.

use mufasa_model::offloading::requester::Action::{self, Drop};
use mufasa_model::offloading::requester::Group::{self, Mot, Plan};
use mufasa_model::offloading::requester::GroupState::Local;
use mufasa_model::offloading::requester::{Groups, Parameters};

use crate::{
    Cav, MOT, PROFILES, TICK, area, confirm, data, lost, offer, reject, request, withdraw,
};

/// `spec/2-offloading.md#requester`
#[test]
fn requests_are_numbered_over_all_groups_and_every_message_carries_the_number() {
    let mut cav = Cav::paper();
    cav.at(0, offer(1, Groups::ALL));
    assert_eq!(cav.at(0, TICK), [request(1, Mot, 1), request(1, Plan, 2)]);
    cav.at(1, reject(1, Mot, 1));
    assert_eq!(cav.at(2, TICK), [request(1, Mot, 3)]);
    cav.at(3, reject(1, Plan, 2));
    assert_eq!(cav.at(4, TICK), [request(1, Plan, 4)]);
}

/// REQ-04: no event but a tick sends a request.
#[test]
fn requests_are_decided_at_ticks_only() {
    for kind in [
        offer(2, Groups::ALL),
        withdraw(2),
        lost(2),
        area(Groups::ALL),
        confirm(1, Mot, 7),
        reject(1, Mot, 7),
        data(1, Mot, 7, 0),
        crate::safe(Some(1), Some(2)),
    ] {
        let mut cav = Cav::paper();
        cav.at(0, offer(1, Groups::ALL));
        let actions = cav.at(1, kind);
        assert!(!actions.contains(&request(1, Mot, 1)), "{kind:?}");
        assert_eq!(cav.states(), (Local, Local));
        assert_eq!(cav.at(2, TICK), [request(1, Mot, 1), request(1, Plan, 2)], "MOT before PLAN");
    }
}

/// REQ-20: one thing wrong at a time.
#[test]
fn data_are_used_only_when_the_group_is_remote_and_station_and_session_are_the_running_ones() {
    for profile in PROFILES {
        let mut cav = Cav::remote(profile, Groups::ALL);
        assert_eq!(cav.at(1, data(1, Mot, 1, 1)), []);
        assert_eq!(cav.at(1, data(1, Plan, 2, 1)), []);
        for foreign in [data(2, Mot, 1, 2), data(1, Mot, 2, 2), data(1, Mot, 0, 2)] {
            assert_eq!(cav.at(2, foreign), [Drop(Mot)]);
        }
        assert_eq!(cav.at(2, data(1, Plan, 1, 2)), [Drop(Plan)], "the session of MOT");
        let mut cav = Cav::requested(profile, MOT);
        assert_eq!(cav.at(1, data(1, Mot, 1, 1)), [Drop(Mot)], "requested only");
        assert_eq!(cav.at(1, data(1, Plan, 2, 1)), [Drop(Plan)], "local");
    }
}

/// REQ-21
#[test]
fn all_other_data_are_dropped_and_counted() {
    let mut cav = Cav::remote(crate::Profile::PAPER, MOT);
    let before = cav.model().clone();
    assert_eq!(cav.model().foreign_data(), 0);
    cav.at(1, data(2, Mot, 1, 1));
    cav.at(1, data(1, Plan, 1, 1));
    assert_eq!(cav.model().foreign_data(), 2);
    assert_eq!(*cav.model(), before, "and change nothing else");
    cav.at(1, data(1, Mot, 1, 1));
    assert_eq!(cav.model().foreign_data(), 2, "a used element is not counted");
}

/// `spec/4-arithmetic.md#domain`
#[test]
fn times_below_zero_are_outside_the_domain() {
    assert_eq!(Parameters::default().first_outside_domain(), None);
    let negative = Parameters { l_max_ns: -1, dt_max_ns: -1, ..Parameters::default() };
    assert_eq!(negative.first_outside_domain(), Some("l_max_ns"));
}

/// The station of the request of this tick, which then rejects.
fn ask(cav: &mut Cav, t_ns: i64, wanted: Group) -> Option<i64> {
    let actions = cav.at(t_ns, TICK);
    let mut asked = None;
    for action in actions {
        let Action::Request { station, group, session } = action else {
            panic!("only requests are expected")
        };
        cav.at(t_ns, reject(station, group, session));
        if group == wanted {
            asked = Some(station);
        }
    }
    asked
}

/// REQ-07, REQ-08
#[test]
fn a_station_that_always_rejects_starves_nobody() {
    let mut cav = Cav::paper();
    for station in 1..=5 {
        cav.at(0, offer(station, Groups::ALL));
    }
    for group in Group::ALL {
        let mut asked: Vec<_> = (0..5).map(|t_ns| ask(&mut cav, t_ns, group)).collect();
        asked.sort_unstable();
        assert_eq!(asked, [1, 2, 3, 4, 5].map(Some));
    }
}
