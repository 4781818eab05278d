//! `spec/2-offloading.md#requester`: whom a request is sent to.

use mufasa_model::offloading::requester::Group::{self, Mot, Plan};
use mufasa_model::offloading::requester::{Action, Groups};

use crate::{Cav, MOT, TICK, lost, offer, reject, request, withdraw};

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

/// `spec/2-offloading.md#requester.3`
#[test]
fn a_station_never_asked_for_this_group_is_taken_first_the_smallest_id() {
    let mut cav = Cav::paper();
    for station in [7, 3, 5] {
        cav.at(0, offer(station, MOT));
    }
    assert_eq!(ask(&mut cav, 1, Mot), Some(3));
    cav.at(2, offer(1, MOT));
    assert_eq!(ask(&mut cav, 3, Mot), Some(1));
    assert_eq!(ask(&mut cav, 4, Mot), Some(5));
    assert_eq!(ask(&mut cav, 5, Mot), Some(7));
}

/// `spec/2-offloading.md#requester.3`: never asked for MOT, although asked for PLAN.
#[test]
fn what_counts_are_the_requests_for_this_group() {
    let mut cav = Cav::paper();
    cav.at(0, offer(1, crate::PLAN));
    cav.at(0, offer(2, MOT));
    assert_eq!(cav.at(1, TICK), [request(2, Mot, 1), request(1, Plan, 2)]);
    cav.at(2, reject(2, Mot, 1));
    cav.at(2, offer(1, Groups::ALL));
    assert_eq!(cav.at(3, TICK), [request(1, Mot, 3)]);
}

/// `spec/2-offloading.md#requester.3`
#[test]
fn then_the_one_whose_last_request_for_this_group_is_the_oldest() {
    let mut cav = Cav::paper();
    for station in [1, 2, 3] {
        cav.at(0, offer(station, MOT));
    }
    let asked: Vec<_> = (0..7).map(|t_ns| ask(&mut cav, t_ns, Mot)).collect();
    assert_eq!(asked, [1, 2, 3, 1, 2, 3, 1].map(Some));
}

/// `spec/2-offloading.md#requester.3`: the clock runs backwards; station 1 was asked first, later.
#[test]
fn the_oldest_request_is_the_oldest_in_the_order_of_the_requests_not_of_their_times() {
    let mut cav = Cav::paper();
    cav.at(0, offer(1, MOT));
    cav.at(0, offer(2, MOT));
    let asked: Vec<_> = [900, 800, 700, 700].map(|t_ns| ask(&mut cav, t_ns, Mot)).to_vec();
    assert_eq!(asked, [1, 2, 1, 2].map(Some));
}

/// `spec/2-offloading.md#requester.3`
#[test]
fn a_withdrawal_forgets_nothing() {
    for leave in [withdraw, lost] {
        let mut cav = Cav::paper();
        cav.at(0, offer(1, MOT));
        assert_eq!(ask(&mut cav, 1, Mot), Some(1));
        cav.at(2, leave(1));
        cav.at(3, offer(1, MOT));
        cav.at(3, offer(2, MOT));
        assert_eq!(ask(&mut cav, 4, Mot), Some(2), "station 1 was asked before it left");
        assert_eq!(ask(&mut cav, 5, Mot), Some(1));
    }
}

/// `spec/2-offloading.md#requester.3`
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
