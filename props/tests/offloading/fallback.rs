//! `spec/2-offloading.md#fallback`. Default: `t_wait` 10 s.

use mufasa_model::offloading::requester::Action::{Activate, Deactivate, Drop};
use mufasa_model::offloading::requester::Group::{Mot, Plan};
use mufasa_model::offloading::requester::GroupState::Local;
use mufasa_model::offloading::requester::{EventKind, Groups, Parameters};
use mufasa_model::report::{FailedStage, InvalidInput, Outcome, Report, Stage};
use mufasa_model::services::configuration::Source;

use crate::{
    Cav, MOT, PLAN, PROFILES, Profile, SESSION_1, TICK, UNSAFE, confirm, data, offer, on, release,
    request, safe,
};

const T_WAIT_NS: i64 = 10_000_000_000;

/// `spec/2-offloading.md#fallback.1`
#[test]
fn a_safety_issue_returns_every_remote_or_requested_group_in_the_same_step() {
    let mut cav = Cav::requested(Profile::PAPER, Groups::ALL);
    cav.at(1, confirm(1, Plan, 2));
    let fallen_back = [release(1, Mot, 1), release(1, Plan, 2), Activate(Plan)];
    assert_eq!(cav.at(2, UNSAFE), fallen_back);
    assert_eq!(cav.states(), (Local, Local));
}

/// `spec/2-offloading.md#fallback.1`
#[test]
fn a_fallback_sends_one_release_per_group_to_its_station() {
    let mut cav = Cav::paper();
    cav.at(0, offer(2, MOT));
    cav.at(0, offer(1, PLAN));
    cav.at(0, TICK);
    cav.at(0, confirm(2, Mot, 1));
    cav.at(0, confirm(1, Plan, 2));
    let fallen_back = [release(2, Mot, 1), release(1, Plan, 2), Activate(Mot), Activate(Plan)];
    assert_eq!(cav.at(1, UNSAFE), fallen_back);
}

/// `spec/2-offloading.md#fallback.1`: the groups that an unsafe verdict names do not matter (I-10).
#[test]
fn a_safety_issue_ends_all_remote_and_requested_services_whatever_the_cycle_used() {
    for groups in [Groups::NONE, MOT, PLAN, Groups::ALL] {
        for profile in PROFILES {
            let mut cav = Cav::remote(profile, Groups::ALL);
            let sessions = cav.model().sessions(groups);
            cav.at(1, EventKind::Verdict { safe: false, sessions });
            assert_eq!(cav.states(), (Local, Local));
            assert_eq!([Mot, Plan].map(|group| cav.model().source(group)), [Source::Local; 2]);
            assert_eq!(cav.model().hold_until_ns(), Some(1 + T_WAIT_NS));
        }
    }
}

/// `spec/2-offloading.md#fallback.1`: what arrives late from the cycle's sessions is dropped.
#[test]
fn after_a_safety_issue_data_of_the_ended_sessions_are_dropped() {
    for profile in PROFILES {
        let mut cav = Cav::remote(profile, Groups::ALL);
        assert_eq!(cav.at(1, data(1, Mot, 1, 1)), []);
        cav.at(2, UNSAFE);
        assert_eq!(cav.at(2, data(1, Mot, 1, 2)), [Drop(Mot)]);
        assert_eq!(cav.at(2, data(1, Plan, 2, 2)), [Drop(Plan)]);
    }
}

/// `spec/2-offloading.md#fallback.2`
#[test]
fn hold_until_becomes_the_later_of_its_old_value_and_now_plus_t_wait() {
    let mut cav = Cav::paper();
    assert_eq!(cav.model().hold_until_ns(), None);
    for (t_ns, until_ns) in [(5, 5), (9, 9), (7, 9), (-20_000_000_000, 9), (10, 10)] {
        assert_eq!(cav.at(t_ns, UNSAFE), [], "also when every group is local already");
        assert_eq!(cav.model().hold_until_ns(), Some(until_ns + T_WAIT_NS));
    }
}

/// `spec/2-offloading.md#fallback.3` (I-08)
#[test]
fn offloading_is_possible_again_at_hold_until_and_not_before() {
    let mut cav = Cav::remote(Profile::PAPER, Groups::ALL);
    cav.at(1, UNSAFE);
    cav.ignores(T_WAIT_NS, TICK);
    assert_eq!(cav.at(1 + T_WAIT_NS, TICK), [request(1, Mot, 3), request(1, Plan, 4)]);
    assert_eq!(cav.model().hold_until_ns(), Some(1 + T_WAIT_NS), "the last value stays");
}

/// `spec/2-offloading.md#fallback.4` (I-09): late data and silence, with and without the switch.
#[test]
fn a_violation_starts_a_hold_only_if_qos_hold_is_set() {
    for qos_hold in [false, true] {
        for (t_ns, kind) in [(1, data(1, Mot, 1, 2)), (100_000_001, TICK)] {
            let parameters = Parameters { qos_hold, ..Parameters::default() };
            let mut cav = Cav::new(Profile::PAPER, parameters);
            cav.at(0, offer(1, MOT));
            cav.at(0, TICK);
            cav.at(0, confirm(1, Mot, 1));
            cav.at(t_ns, kind);
            assert_eq!(cav.model().state(Mot), Local);
            let until_ns = t_ns + T_WAIT_NS;
            assert_eq!(cav.model().hold_until_ns(), qos_hold.then_some(until_ns));
            assert_eq!(cav.at(until_ns - 1, TICK).is_empty(), qos_hold);
        }
    }
}

/// `spec/2-offloading.md#fallback.7`: a hold that a silent session starts at a tick forbids the
/// requests of that tick, because requests are decided last.
#[test]
fn a_hold_of_silence_forbids_the_requests_of_the_same_tick() {
    for qos_hold in [false, true] {
        let parameters = Parameters { qos_hold, ..Parameters::default() };
        let mut cav = Cav::new(Profile::PAPER, parameters);
        cav.at(0, offer(1, PLAN));
        cav.at(0, TICK);
        cav.at(0, confirm(1, Plan, 1));
        cav.at(1, offer(1, Groups::ALL));
        let mut actions = vec![release(1, Plan, 1), Activate(Plan)];
        if !qos_hold {
            actions.push(request(1, Mot, 2));
        }
        assert_eq!(cav.at(100_000_001, TICK), actions);
    }
}

/// `spec/2-offloading.md#fallback.5`
#[test]
fn time_that_does_not_advance_or_runs_backwards_does_not_shorten_a_hold() {
    let mut cav = Cav::paper();
    cav.at(0, offer(1, Groups::ALL));
    cav.at(100, UNSAFE);
    for t_ns in [100, 100, 50, -1, i64::MIN, 100, 99 + T_WAIT_NS] {
        assert_eq!(cav.at(t_ns, TICK), []);
        assert_eq!(cav.model().hold_until_ns(), Some(100 + T_WAIT_NS));
    }
    cav.at(i64::MIN, UNSAFE);
    assert_eq!(cav.model().hold_until_ns(), Some(100 + T_WAIT_NS));
}

/// `spec/2-offloading.md#fallback.5`
#[test]
fn hold_until_saturates_at_the_limits_of_64_bits() {
    let parameters = Parameters { t_wait_ns: i64::MAX, ..Parameters::default() };
    let mut cav = Cav::new(Profile::PAPER, parameters);
    cav.at(0, offer(1, MOT));
    cav.at(1, UNSAFE);
    assert_eq!(cav.model().hold_until_ns(), Some(i64::MAX));
    assert_eq!(cav.at(i64::MAX - 1, TICK), []);
    assert_eq!(cav.at(i64::MAX, TICK), [request(1, Mot, 1)]);
    let mut cav = Cav::new(Profile::PAPER, parameters);
    cav.at(i64::MIN, UNSAFE);
    assert_eq!(cav.model().hold_until_ns(), Some(-1));
}

/// `spec/2-offloading.md#fallback.6`
#[test]
fn a_cycle_that_ends_in_error_is_handed_to_the_requester_as_unsafe() {
    let stages = [const { Outcome::NotScheduled }; 5];
    let report = |failed_stage| Report { failed_stage, stages: stages.clone(), input: None };
    let problem =
        InvalidInput { field: "ego.x".to_owned(), index: None, message: "is NaN".to_owned() };
    for (result, safe) in [
        (Ok(report(None)), true),
        (Ok(report(Some(FailedStage::Stage(Stage::Ii)))), false),
        (Ok(report(Some(FailedStage::Input))), false),
        (Ok(report(Some(FailedStage::NoObstacleCheck))), false),
        (Err(problem), false),
    ] {
        let kind = EventKind::of_cycle(&result, SESSION_1);
        assert_eq!(kind, EventKind::Verdict { safe, sessions: SESSION_1 });
    }
}

/// `spec/2-offloading.md#fallback.7`: PLAN is overdue, MOT silent, and the order is by kind first.
#[test]
fn actions_of_one_event_are_drops_releases_activations_requests_and_mot_before_plan_within_each() {
    let mut cav = Cav::requested(Profile::PAPER, Groups::ALL);
    cav.at(0, confirm(1, Mot, 1));
    let tick = [release(1, Mot, 1), release(1, Plan, 2), Activate(Mot)];
    assert_eq!(cav.at(500_000_000, TICK), tick);

    let mut cav = Cav::remote(Profile::HARDENED, Groups::ALL);
    cav.at(1, data(1, Plan, 2, 1));
    cav.at(1, data(1, Mot, 1, 1));
    assert_eq!(cav.at(2, safe(Some(1), Some(2))), [Deactivate(Mot), Deactivate(Plan)]);
    let early = [Drop(Plan), release(1, Plan, 2), Activate(Plan)];
    assert_eq!(cav.at(3, data(1, Plan, 2, 4)), early);

    let mut cav = Cav::remote(Profile::PAPER, Groups::ALL);
    let all = [release(1, Mot, 1), release(1, Plan, 2), Activate(Mot), Activate(Plan)];
    assert_eq!(cav.at(3, UNSAFE), all);

    let mut cav = Cav::remote(Profile::PAPER, MOT);
    cav.at(1, offer(1, Groups::ALL));
    let tick = [release(1, Mot, 1), Activate(Mot), request(1, Plan, 2)];
    assert_eq!(cav.at(100_000_001, TICK), tick);
}

/// `spec/2-offloading.md#properties-of-the-whole-protocol.6` (H-08)
#[test]
fn local_services_are_not_stopped_while_no_result_of_the_running_session_was_in_a_safe_cycle() {
    let mut cav = Cav::remote(Profile::HARDENED, MOT);
    assert_eq!(cav.at(1, safe(Some(1), None)), [], "no result");
    cav.at(2, data(1, Mot, 9, 2));
    assert_eq!(cav.at(2, safe(Some(1), None)), [], "no result of the running session");
    cav.at(3, data(1, Mot, 1, 3));
    assert_eq!(cav.at(3, safe(None, Some(1))), [], "the cycle did not use it");
    assert_eq!(cav.at(3, safe(Some(2), None)), [], "another session");
    cav.at(4, offer(1, Groups::NONE));
    cav.at(4, offer(1, MOT));
    cav.at(4, TICK);
    cav.at(4, confirm(1, Mot, 2));
    assert_eq!(cav.model().state(Mot), on(1, 2));
    assert_eq!(cav.at(5, safe(Some(2), None)), [], "the used result was of an earlier session");
    cav.at(6, data(1, Mot, 2, 6));
    assert_eq!(cav.at(6, safe(Some(1), None)), [], "a verdict on an earlier session (F-25)");
    assert_eq!(cav.at(6, safe(Some(2), None)), [Deactivate(Mot)]);
}

/// `spec/5-interfaces.md#offloading-trace`: `safe` matters only for H-08.
#[test]
fn a_safe_verdict_changes_nothing_in_the_paper_profile() {
    let mut cav = Cav::remote(Profile::PAPER, Groups::ALL);
    cav.at(1, data(1, Mot, 1, 1));
    cav.ignores(2, safe(Some(1), Some(2)));
}
