//! `spec/2-offloading.md#quality-of-service`; the arithmetic is tested in `qos`.

use super::super::GroupState;
use super::*;

/// `spec/2-offloading.md#quality-of-service.1`: "Every element of the running session is an
/// arrival, and MUST be checked for latency and inter-arrival time first and for its order then;
/// other data are no arrivals."
#[test]
fn every_element_of_the_running_session_is_an_arrival_and_others_are_none() -> TestResult {
    let mut table = FREE;
    let mut requester = remote(Profile::Paper, TIMES, &mut table)?;
    act(&mut requester, 60, data(1, MOT, 1, 50), &[])?;
    // Out of order, so dropped; an arrival all the same.
    act(&mut requester, 70, data(1, MOT, 1, 50), &[Action::Drop(MOT)])?;
    // Of another session: no arrival.
    act(&mut requester, 90, data(1, PLAN, 1, 90), &[Action::Drop(PLAN)])?;
    act(&mut requester, 90, data(2, PLAN, 2, 90), &[Action::Drop(PLAN)])?;
    let silent = [release(1, PLAN, 2), Action::Activate(PLAN)];
    act(&mut requester, 170, TICK, &silent)?;
    // Out of order and too old: latency is checked first.
    let late = [Action::Drop(MOT), release(1, MOT, 1), Action::Activate(MOT)];
    act(&mut requester, 170, data(1, MOT, 1, 50), &late)
}

/// `spec/2-offloading.md#quality-of-service.2`: "l > l_max or dt > dt_max MUST be a violation;
/// equality MUST NOT", and "dt = time since the previous arrival, or since the activation".
#[test]
fn latency_and_inter_arrival_time_beyond_their_limits_are_violations() -> TestResult {
    let violation = [Action::Drop(MOT), release(1, MOT, 1), Action::Activate(MOT)];
    for (t_ns, generated_ns, expected) in [
        (20, 0, [].as_slice()),
        (20, -1, &violation),
        (100, 99, &[]),
        (101, 100, &violation),
        (101, 0, &violation),
    ] {
        let mut table = FREE;
        let mut requester = remote(Profile::Paper, TIMES, &mut table)?;
        act(&mut requester, t_ns, data(1, MOT, 1, generated_ns), expected)?;
        assert_eq!(requester.state(MOT) == GroupState::Local, !expected.is_empty());
    }
    Ok(())
}

/// `spec/2-offloading.md#quality-of-service.3`: "Silence longer than dt_max since the last arrival
/// (or since the activation) MUST be a violation at the first tick that can tell, without waiting
/// for data."
#[test]
fn silence_is_a_violation_at_the_first_tick_that_can_tell() -> TestResult {
    for profile in PROFILES {
        let mut table = FREE;
        let mut requester = remote(profile, TIMES, &mut table)?;
        act(&mut requester, 30, data(1, PLAN, 2, 30), &[])?;
        act(&mut requester, 100, TICK, &[])?;
        act(&mut requester, 101, SAFE, &[])?;
        let silent = [release(1, MOT, 1), Action::Activate(MOT)];
        act(&mut requester, 101, TICK, &silent)?;
        // MOT may be asked for again; PLAN is silent in the same tick.
        let actions = [release(1, PLAN, 2), Action::Activate(PLAN), request(1, MOT, 3)];
        act(&mut requester, 131, TICK, &actions)?;
    }
    Ok(())
}

/// `spec/2-offloading.md#quality-of-service.4`: "A generation time later than the arrival time MUST
/// be a violation (the clocks cannot be trusted)."
#[test]
fn a_generation_time_later_than_the_arrival_is_a_violation() -> TestResult {
    let mut table = FREE;
    let mut requester = remote(Profile::Paper, TIMES, &mut table)?;
    act(&mut requester, 5, data(1, PLAN, 2, 5), &[])?;
    let violation = [Action::Drop(PLAN), release(1, PLAN, 2), Action::Activate(PLAN)];
    act(&mut requester, 5, data(1, PLAN, 2, 6), &violation)
}

/// `spec/2-offloading.md#quality-of-service.5`: "A violation MUST return that group, and no other,
/// to its local services at once, with a release sent; the element is dropped."
#[test]
fn a_violation_returns_that_group_and_no_other() -> TestResult {
    for profile in PROFILES {
        for (bad, good) in [((MOT, 1), (PLAN, 2)), ((PLAN, 2), (MOT, 1))] {
            let mut table = FREE;
            let mut requester = remote(profile, TIMES, &mut table)?;
            let (group, session) = bad;
            let expected =
                [Action::Drop(group), release(1, group, session), Action::Activate(group)];
            act(&mut requester, 1, data(1, group, session, 2), &expected)?;
            let (other, session) = good;
            assert_eq!(requester.state(group), GroupState::Local);
            assert_eq!(requester.state(other), GroupState::Remote { station: 1, session });
            act(&mut requester, 1, data(1, other, session, 1), &[])?;
        }
    }
    Ok(())
}

/// `spec/2-offloading.md#quality-of-service.6`: "An element whose generation time is not later than
/// that of the last one used since the activation MUST be dropped" - and a new activation starts
/// anew.
#[test]
fn an_element_not_later_than_the_last_one_used_since_the_activation_is_dropped() -> TestResult {
    let mut table = FREE;
    let mut requester = remote(Profile::Paper, TIMES, &mut table)?;
    act(&mut requester, 10, data(1, MOT, 1, 10), &[])?;
    act(&mut requester, 10, data(1, MOT, 1, 10), &[Action::Drop(MOT)])?;
    act(&mut requester, 11, data(1, MOT, 1, 9), &[Action::Drop(MOT)])?;
    act(&mut requester, 11, data(1, PLAN, 2, 9), &[])?;
    assert_eq!(requester.dropped(MOT), 0, "counted are data of other sessions");
    act(&mut requester, 11, lost(1), &[Action::Activate(MOT), Action::Activate(PLAN)])?;
    act(&mut requester, 11, offer(1, only(MOT)), &[])?;
    act(&mut requester, 11, TICK, &[request(1, MOT, 3)])?;
    act(&mut requester, 12, confirm(1, MOT, 3), &[Action::Deactivate(MOT)])?;
    act(&mut requester, 12, data(1, MOT, 3, 8), &[])?;
    act(&mut requester, 12, data(1, MOT, 3, 8), &[Action::Drop(MOT)])
}
