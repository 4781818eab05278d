//! `spec/2-offloading.md#fallback` and the errors of a requester.

use super::super::{GroupState, Source};
use super::*;
use crate::report::{FailedStage, InvalidInput, Outcome, Problem, Report, Stage};
use crate::services::configuration::Configuration;

/// `spec/2-offloading.md#fallback.1`: "When a stage finds a safety issue, every group that is
/// remote or requested MUST return to local in the same step, with one release per group to its
/// station" (I-10). Which groups the cycle used does not matter.
#[test]
fn a_safety_issue_returns_every_group_that_is_remote_or_requested() -> TestResult {
    for profile in PROFILES {
        for groups in [Groups::NONE, only(MOT), only(PLAN), Groups::ALL] {
            let mut table = FREE;
            let mut requester = remote(profile, TIMES, &mut table)?;
            act(&mut requester, 0, offer(2, only(PLAN)), &[])?;
            act(
                &mut requester,
                0,
                offer(1, only(MOT)),
                &[release(1, PLAN, 2), Action::Activate(PLAN)],
            )?;
            act(&mut requester, 0, TICK, &[request(2, PLAN, 3)])?;
            let all = [release(1, MOT, 1), release(2, PLAN, 3), Action::Activate(MOT)];
            act(&mut requester, 7, EventKind::Verdict { safe: false, groups }, &all)?;
            assert_eq!(requester.configuration(), Configuration::Local);
            assert_eq!([MOT, PLAN].map(|group| requester.source(group)), [Source::Local; 2]);
            assert_eq!(requester.hold_until_ns(), Some(1007));
        }
    }
    Ok(())
}

/// `spec/2-offloading.md#fallback.2`: "In the same step `hold_until` MUST become the later of its
/// old value and now + t_wait, also when every group is local already."
#[test]
fn hold_until_becomes_the_later_of_its_old_value_and_now_plus_t_wait() -> TestResult {
    let mut table = FREE;
    let mut requester = Requester::new(Profile::Hardened, TIMES, &mut table)?;
    for (t_ns, hold_until_ns) in [(-2000, -1000), (5, 1005), (5, 1005), (4, 1005), (6, 1006)] {
        act(&mut requester, t_ns, UNSAFE, &[])?;
        assert_eq!(requester.hold_until_ns(), Some(hold_until_ns));
    }
    Ok(())
}

/// `spec/2-offloading.md#fallback.3`: "Offloading MUST be possible again at `hold_until` and not
/// before (I-08)."
#[test]
fn offloading_is_possible_again_at_hold_until_and_not_before() -> TestResult {
    let mut table = FREE;
    let mut requester = remote(Profile::Paper, TIMES, &mut table)?;
    let back =
        [release(1, MOT, 1), release(1, PLAN, 2), Action::Activate(MOT), Action::Activate(PLAN)];
    act(&mut requester, 10, UNSAFE, &back)?;
    act(&mut requester, 1009, TICK, &[])?;
    act(&mut requester, 1010, TICK, &[request(1, MOT, 3), request(1, PLAN, 4)])?;
    assert_eq!(requester.hold_until_ns(), Some(1010), "it keeps its last value");
    Ok(())
}

/// `spec/2-offloading.md#fallback.4`: "A violation of quality of service MUST NOT start a hold
/// unless `qos_hold` is set (I-09)."
#[test]
fn a_violation_of_quality_of_service_starts_a_hold_only_with_qos_hold() -> TestResult {
    for (qos_hold, at_data, at_tick) in [(false, None, None), (true, Some(1001), Some(1101))] {
        let mut table = FREE;
        let mut requester = remote(Profile::Paper, Parameters { qos_hold, ..TIMES }, &mut table)?;
        act(&mut requester, 0, offer(2, only(MOT)), &[])?;
        let violation = [Action::Drop(MOT), release(1, MOT, 1), Action::Activate(MOT)];
        act(&mut requester, 1, data(1, MOT, 1, 2), &violation)?;
        assert_eq!(requester.hold_until_ns(), at_data);
        assert_eq!(requester.state(PLAN), GroupState::Remote { station: 1, session: 2 });
        let silent = [release(1, PLAN, 2), Action::Activate(PLAN), request(2, MOT, 3)];
        // The hold that the silence starts bars the requests of the same tick.
        let without_request = silent.len().saturating_sub(usize::from(qos_hold));
        act(&mut requester, 101, TICK, silent.get(..without_request).unwrap_or(&[]))?;
        assert_eq!(requester.hold_until_ns(), at_tick);
    }
    Ok(())
}

/// `spec/2-offloading.md#fallback.5`: "Time that does not advance, or runs backwards, MUST NOT
/// shorten a hold; deadlines and hold_until saturate at the limits of 64 bits, differences are
/// exact."
#[test]
fn no_time_shortens_a_hold_and_sums_saturate() -> TestResult {
    let parameters = Parameters { qos_hold: true, ..TIMES };
    let mut table = FREE;
    let mut requester = remote(Profile::Paper, parameters, &mut table)?;
    let early = [Action::Drop(MOT), release(1, MOT, 1), Action::Activate(MOT)];
    act(&mut requester, 50, data(1, MOT, 1, 51), &early)?;
    for (t_ns, kind) in [(i64::MIN, TICK), (0, SAFE), (-7, area(Groups::ALL)), (1049, TICK)] {
        act(&mut requester, t_ns, kind, &[])?;
        assert_eq!(requester.hold_until_ns(), Some(1050));
        // Silence since the activation at 0 has not been told before the last tick.
        if t_ns == 0 {
            act(&mut requester, 0, withdraw(1), &[release(1, PLAN, 2), Action::Activate(PLAN)])?;
            act(&mut requester, 0, offer(1, Groups::ALL), &[])?;
        }
    }
    let near_the_end = i64::MAX.saturating_sub(10);
    act(&mut requester, near_the_end, TICK, &[request(1, MOT, 3), request(1, PLAN, 4)])?;
    let saturated = GroupState::Requested { station: 1, session: 3, deadline_ns: i64::MAX };
    assert_eq!(requester.state(MOT), saturated);
    act(&mut requester, near_the_end, UNSAFE, &[release(1, MOT, 3), release(1, PLAN, 4)])?;
    assert_eq!(requester.hold_until_ns(), Some(i64::MAX));
    act(&mut requester, i64::MAX.saturating_sub(1), TICK, &[])?;
    act(&mut requester, i64::MAX, TICK, &[request(1, MOT, 5), request(1, PLAN, 6)])?;
    act(&mut requester, i64::MAX, confirm(1, MOT, 5), &[release(1, MOT, 5)])?;
    act(&mut requester, i64::MIN, confirm(1, MOT, 5), &[Action::Deactivate(MOT)])?;
    // 2^64 - 1 ns of silence.
    let told = [release(1, MOT, 5), release(1, PLAN, 6), Action::Activate(MOT)];
    act(&mut requester, i64::MAX, TICK, &told)
}

/// `spec/2-offloading.md#fallback.6`: "A cycle that ends in `error` MUST be handed to the requester
/// as unsafe."
#[test]
fn a_cycle_that_ends_in_error_is_handed_on_as_unsafe() -> TestResult {
    let report =
        |failed_stage| Report { failed_stage, stages: [Outcome::NotScheduled; 5], input: None };
    let invalid = InvalidInput { field: "ego.x", index: None, problem: Problem::NotFinite };
    for (answer, safe) in [
        (Ok(report(None)), true),
        (Ok(report(Some(FailedStage::Stage(Stage::Ii)))), false),
        (Ok(report(Some(FailedStage::Input))), false),
        (Err(invalid), false),
    ] {
        let kind = EventKind::of_cycle(&answer, only(MOT));
        assert_eq!(kind, EventKind::Verdict { safe, groups: only(MOT) });
        let mut table = FREE;
        let mut requester = Requester::new(Profile::Hardened, TIMES, &mut table)?;
        act(&mut requester, 0, kind, &[])?;
        assert_eq!(requester.hold_until_ns().is_some(), !safe);
    }
    Ok(())
}

/// `spec/2-offloading.md#fallback.7`: "A tick MUST end overdue requests first, then silent
/// sessions, then decide requests. Actions of one event come in this order, MOT before PLAN within
/// each: drops, releases, activations and deactivations, requests."
#[test]
fn a_tick_ends_requests_then_sessions_then_asks_and_actions_come_in_order() -> TestResult {
    // PLAN is overdue and MOT silent: the release of MOT comes first all the same.
    let mut table = FREE;
    let mut requester = remote(Profile::Paper, TIMES, &mut table)?;
    let left = [release(1, PLAN, 2), Action::Activate(PLAN)];
    act(&mut requester, 20, offer(1, only(MOT)), &left)?;
    act(&mut requester, 20, offer(2, only(PLAN)), &[])?;
    act(&mut requester, 20, TICK, &[request(2, PLAN, 3)])?;
    let both = [release(1, MOT, 1), release(2, PLAN, 3), Action::Activate(MOT)];
    act(&mut requester, 101, TICK, &both)?;
    act(&mut requester, 101, TICK, &[request(1, MOT, 4), request(2, PLAN, 5)])?;
    // A silent PLAN does not come before the request for MOT.
    act(&mut requester, 102, confirm(2, PLAN, 5), &[Action::Deactivate(PLAN)])?;
    act(&mut requester, 102, reject(1, MOT, 4), &[])?;
    let mixed = [release(2, PLAN, 5), Action::Activate(PLAN), request(1, MOT, 6)];
    act(&mut requester, 203, TICK, &mixed)
}

/// `spec/2-offloading.md#fallback.7`: the hold that a silent session starts, with `qos_hold`, is
/// there when requests are decided at the same tick, unless it has ended at once; an overdue
/// request starts none.
#[test]
fn the_order_of_a_tick_decides_whether_it_asks() -> TestResult {
    for (t_wait_ns, hold_until_ns, asks) in [(0, 101, true), (1, 102, false)] {
        let mut table = FREE;
        let parameters = Parameters { qos_hold: true, t_wait_ns, ..TIMES };
        let mut requester = remote(Profile::Paper, parameters, &mut table)?;
        let left = [release(1, PLAN, 2), Action::Activate(PLAN)];
        act(&mut requester, 20, offer(1, only(MOT)), &left)?;
        act(&mut requester, 20, offer(2, only(PLAN)), &[])?;
        let silent = [release(1, MOT, 1), Action::Activate(MOT)];
        let and_asks = [release(1, MOT, 1), Action::Activate(MOT), request(2, PLAN, 3)];
        act(&mut requester, 101, TICK, if asks { &and_asks } else { &silent })?;
        assert_eq!(requester.hold_until_ns(), Some(hold_until_ns));
    }
    let mut table = FREE;
    let mut requester =
        Requester::new(Profile::Paper, Parameters { qos_hold: true, ..TIMES }, &mut table)?;
    act(&mut requester, 0, offer(1, only(PLAN)), &[])?;
    act(&mut requester, 0, TICK, &[request(1, PLAN, 1)])?;
    act(&mut requester, 1, offer(1, Groups::ALL), &[])?;
    act(&mut requester, 50, TICK, &[release(1, PLAN, 1), request(1, MOT, 2)])?;
    assert_eq!(requester.hold_until_ns(), None);
    Ok(())
}

/// `spec/5-interfaces.md#offloading-trace`: stations of events are >= 1; anything else is an
/// error and changes nothing.
#[test]
fn an_event_of_a_station_below_1_is_an_error_that_changes_nothing() -> TestResult {
    let mut table = FREE;
    let mut requester = remote(Profile::Paper, TIMES, &mut table)?;
    for station in [0, -1, i64::MIN] {
        for kind in [
            offer(station, Groups::ALL),
            withdraw(station),
            lost(station),
            confirm(station, MOT, 1),
            reject(station, MOT, 1),
            data(station, MOT, 1, 0),
        ] {
            let refused = requester.step(&Event { t_ns: 500, kind });
            assert_eq!(refused, Err(RequesterError::Station { station }), "{kind:?}");
        }
    }
    assert_eq!(requester.configuration(), Configuration::AllRemote);
    assert_eq!(requester.dropped(MOT), 0);
    Ok(())
}

/// `spec/4-arithmetic.md#conformance-of-an-implementation.6`: an offer that the table has no place
/// for is an error and changes nothing; other events go on.
#[test]
fn an_offer_beyond_the_table_is_an_error_that_changes_nothing() -> TestResult {
    let mut table = [StationRecord::FREE; 1];
    let mut requester = remote(Profile::Paper, TIMES, &mut table)?;
    let full = RequesterError::TableFull { station: 2, capacity: 1 };
    let offered = requester.step(&Event { t_ns: 0, kind: offer(2, only(MOT)) });
    assert_eq!(offered, Err(full));
    act(&mut requester, 0, offer(2, Groups::NONE), &[])?;
    act(&mut requester, 0, withdraw(2), &[])?;
    assert_eq!(requester.configuration(), Configuration::AllRemote);
    act(&mut requester, 0, lost(1), &[Action::Activate(MOT), Action::Activate(PLAN)])?;
    let offered = requester.step(&Event { t_ns: 0, kind: offer(2, only(MOT)) });
    assert_eq!(offered, Err(full), "station 1 was asked, so it is not forgotten");
    act(&mut requester, 1, TICK, &[])
}

/// `spec/2-offloading.md`, the defaults; `spec/4-arithmetic.md#domain`: 0 to 2^63 - 1.
#[test]
fn parameters_have_the_defaults_of_the_text_and_none_is_below_0() -> TestResult {
    let expected = Parameters {
        t_wait_ns: 10_000_000_000,
        request_timeout_ns: 500_000_000,
        l_max_ns: 50_000_000,
        dt_max_ns: 100_000_000,
        qos_hold: false,
    };
    assert_eq!(Parameters::default(), expected);
    let widest = Parameters {
        t_wait_ns: i64::MAX,
        request_timeout_ns: i64::MAX,
        l_max_ns: i64::MAX,
        dt_max_ns: 0,
        qos_hold: true,
    };
    Requester::new(Profile::Paper, widest, &mut [])?;
    for (field, parameters) in [
        ("t_wait_ns", Parameters { t_wait_ns: -1, dt_max_ns: -1, ..expected }),
        ("request_timeout_ns", Parameters { request_timeout_ns: i64::MIN, ..expected }),
        ("l_max_ns", Parameters { l_max_ns: -1, ..expected }),
        ("dt_max_ns", Parameters { dt_max_ns: -1, ..expected }),
    ] {
        let refused = Requester::new(Profile::Paper, parameters, &mut []).err();
        assert_eq!(refused, Some(RequesterError::NegativeParameter { field }));
    }
    Ok(())
}
