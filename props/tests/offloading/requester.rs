//! `spec/2-offloading.md#requester`: offers, requests, area, data, withdrawal, loss.

use mufasa_model::offloading::requester::Action::{Activate, Deactivate, Drop};
use mufasa_model::offloading::requester::Group::{Mot, Plan};
use mufasa_model::offloading::requester::GroupState::Local;
use mufasa_model::offloading::requester::{Groups, Parameters};

use crate::{
    Cav, MOT, PLAN, PROFILES, TICK, UNSAFE, area, confirm, data, lost, offer, on, reject, release,
    request, withdraw,
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

/// `spec/2-offloading.md#requester.1`
#[test]
fn an_offer_replaces_the_stations_previous_offer() {
    let mut cav = Cav::paper();
    cav.at(0, offer(1, MOT));
    cav.at(0, offer(1, PLAN));
    assert_eq!(cav.at(1, TICK), [request(1, Plan, 1)]);
    let mut cav = Cav::paper();
    cav.at(0, offer(1, Groups::ALL));
    cav.at(0, offer(1, Groups::NONE));
    assert_eq!(cav.at(1, TICK), []);
}

/// `spec/2-offloading.md#requester.1`
#[test]
fn a_group_in_use_that_the_new_offer_no_longer_contains_is_left_as_by_a_withdrawal() {
    let mut cav = Cav::remote(crate::Profile::PAPER, Groups::ALL);
    assert_eq!(cav.at(1, offer(1, PLAN)), [release(1, Mot, 1), Activate(Mot)]);
    assert_eq!(cav.states(), (Local, on(1, 2)));
    let mut cav = Cav::requested(crate::Profile::PAPER, Groups::ALL);
    assert_eq!(cav.at(1, offer(1, MOT)), [release(1, Plan, 2)]);
    assert_eq!(cav.model().state(Plan), Local);
    assert_eq!(cav.model().hold_until_ns(), None);
    let mut cav = Cav::remote(crate::Profile::PAPER, Groups::ALL);
    cav.at(1, offer(2, Groups::NONE));
    assert_eq!(cav.states(), (on(1, 1), on(1, 2)), "another station's offer");
}

/// `spec/2-offloading.md#requester.2`
#[test]
fn a_request_is_sent_only_for_a_group_in_local() {
    let mut cav = Cav::requested(crate::Profile::PAPER, Groups::ALL);
    cav.at(1, offer(2, Groups::ALL));
    assert_eq!(cav.at(2, TICK), [], "both are requested");
    cav.at(3, confirm(1, Mot, 1));
    cav.at(3, confirm(1, Plan, 2));
    assert_eq!(cav.at(4, TICK), [], "both are remote");
}

/// `spec/2-offloading.md#requester.2`
#[test]
fn a_request_is_sent_only_to_a_station_whose_current_offer_contains_the_group() {
    let mut cav = Cav::paper();
    assert_eq!(cav.at(0, TICK), []);
    cav.at(1, offer(1, PLAN));
    cav.at(1, offer(2, MOT));
    assert_eq!(cav.at(2, TICK), [request(2, Mot, 1), request(1, Plan, 2)]);
}

/// `spec/2-offloading.md#requester.2`
#[test]
fn a_request_is_sent_only_while_the_group_is_in_the_area() {
    let mut cav = Cav::paper();
    cav.at(0, offer(1, Groups::ALL));
    cav.at(0, area(PLAN));
    assert_eq!(cav.at(1, TICK), [request(1, Plan, 1)]);
    cav.at(2, area(Groups::ALL));
    assert_eq!(cav.at(3, TICK), [request(1, Mot, 2)]);
}

/// `spec/2-offloading.md#requester.2`
#[test]
fn a_request_is_not_sent_before_hold_until() {
    let mut cav = Cav::paper();
    cav.at(0, offer(1, Groups::ALL));
    cav.at(5, UNSAFE);
    assert_eq!(cav.at(10_000_000_004, TICK), []);
    assert_eq!(cav.at(10_000_000_005, TICK).len(), 2);
}

/// `spec/2-offloading.md#requester.2`: no event but a tick sends a request.
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

/// `spec/2-offloading.md#requester.2`: an overdue request and a silent session.
#[test]
fn a_group_that_returned_to_local_at_this_tick_waits_for_the_next() {
    let mut cav = Cav::requested(crate::Profile::PAPER, Groups::ALL);
    cav.at(1, confirm(1, Plan, 2));
    cav.at(2, offer(2, Groups::ALL));
    let late = 500_000_000;
    let both = [release(1, Mot, 1), release(1, Plan, 2), Activate(Plan)];
    assert_eq!(cav.at(late, TICK), both);
    assert_eq!(cav.at(late, TICK), [request(2, Mot, 3), request(2, Plan, 4)]);
}

/// `spec/2-offloading.md#requester.2`: the other group does not wait.
#[test]
fn only_the_group_that_returned_at_this_tick_waits() {
    let mut cav = Cav::requested(crate::Profile::PAPER, PLAN);
    cav.at(1, offer(1, Groups::ALL));
    assert_eq!(cav.at(500_000_000, TICK), [release(1, Plan, 1), request(1, Mot, 2)]);
}

/// `spec/2-offloading.md#requester.6`
#[test]
fn all_groups_are_in_the_area_until_the_first_area_event() {
    let mut cav = Cav::paper();
    cav.at(0, offer(1, Groups::ALL));
    assert_eq!(cav.at(0, TICK).len(), 2);
}

/// `spec/2-offloading.md#requester.6`
#[test]
fn an_area_event_replaces_the_set_and_a_group_outside_returns_to_local_with_a_release() {
    let mut cav = Cav::requested(crate::Profile::PAPER, Groups::ALL);
    cav.at(1, confirm(1, Mot, 1));
    assert_eq!(cav.at(2, area(PLAN)), [release(1, Mot, 1), Activate(Mot)]);
    assert_eq!(cav.at(3, area(MOT)), [release(1, Plan, 2)], "requested: nothing to activate");
    assert_eq!(cav.states(), (Local, Local));
    assert_eq!(cav.model().hold_until_ns(), None, "without a hold");
    assert_eq!(cav.at(4, TICK), [request(1, Mot, 3)], "MOT is in the area again");
}

/// `spec/2-offloading.md#requester.7`: one thing wrong at a time.
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

/// `spec/2-offloading.md#requester.7`
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

/// `spec/2-offloading.md#requester.8`
#[test]
fn a_withdrawal_removes_the_offer_and_returns_every_group_of_the_station_with_a_release() {
    let mut cav = Cav::requested(crate::Profile::PAPER, Groups::ALL);
    cav.at(1, confirm(1, Plan, 2));
    let both = [release(1, Mot, 1), release(1, Plan, 2), Activate(Plan)];
    assert_eq!(cav.at(2, withdraw(1)), both);
    assert_eq!(cav.states(), (Local, Local));
    assert_eq!(cav.at(3, TICK), [], "no offer, no request");
    assert_eq!(cav.model().hold_until_ns(), None);
    cav.at(4, offer(1, MOT));
    assert_eq!(cav.at(4, TICK), [request(1, Mot, 3)], "no hold");
}

/// `spec/2-offloading.md#requester.8`
#[test]
fn a_loss_does_the_same_without_a_release() {
    let mut cav = Cav::requested(crate::Profile::PAPER, Groups::ALL);
    cav.at(1, confirm(1, Plan, 2));
    assert_eq!(cav.at(2, lost(1)), [Activate(Plan)]);
    assert_eq!(cav.states(), (Local, Local));
    assert_eq!(cav.at(3, TICK), []);
    assert_eq!(cav.model().hold_until_ns(), None);
}

/// `spec/2-offloading.md#requester.8`
#[test]
fn a_withdrawal_or_loss_of_another_station_changes_no_session() {
    for kind in [withdraw(2), lost(2)] {
        let mut cav = Cav::remote(crate::Profile::PAPER, Groups::ALL);
        cav.ignores(1, kind);
        cav.at(1, offer(2, Groups::ALL));
        assert_eq!(cav.at(2, kind), []);
        assert_eq!(cav.states(), (on(1, 1), on(1, 2)));
    }
}

/// `spec/2-offloading.md#requester.9`
#[test]
fn mot_and_plan_may_run_on_different_stations() {
    let mut cav = Cav::paper();
    cav.at(0, offer(2, MOT));
    cav.at(0, offer(1, PLAN));
    cav.at(1, TICK);
    assert_eq!(cav.at(2, confirm(2, Mot, 1)), [Deactivate(Mot)]);
    assert_eq!(cav.at(2, confirm(1, Plan, 2)), [Deactivate(Plan)]);
    assert_eq!(cav.states(), (on(2, 1), on(1, 2)));
    assert_eq!(cav.at(3, withdraw(1)), [release(1, Plan, 2), Activate(Plan)]);
    assert_eq!(cav.states(), (on(2, 1), Local));
}

/// `spec/2-offloading.md#requester.9`
#[test]
fn one_requester_handles_offers_of_several_providers_at_the_same_time() {
    let mut cav = Cav::paper();
    for station in [3, 1, 2] {
        cav.at(0, offer(station, Groups::ALL));
    }
    assert_eq!(cav.at(1, TICK), [request(1, Mot, 1), request(1, Plan, 2)]);
    cav.at(2, withdraw(1));
    assert_eq!(cav.at(3, TICK), [request(2, Mot, 3), request(2, Plan, 4)]);
    cav.at(4, lost(2));
    assert_eq!(cav.at(5, TICK), [request(3, Mot, 5), request(3, Plan, 6)]);
}

/// `spec/4-arithmetic.md#domain`
#[test]
fn times_below_zero_are_outside_the_domain() {
    assert_eq!(Parameters::default().first_outside_domain(), None);
    let negative = Parameters { l_max_ns: -1, dt_max_ns: -1, ..Parameters::default() };
    assert_eq!(negative.first_outside_domain(), Some("l_max_ns"));
}
