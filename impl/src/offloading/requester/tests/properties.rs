//! `spec/2-offloading.md#properties-of-the-whole-protocol`, as far as they are the requester's;
//! H-08; and a walk through random events that compares every step with an observer who sees
//! events and actions only.

use super::super::{Actions, GroupState, Source};
use super::*;
use crate::services::configuration::Configuration;

/// `spec/2-offloading.md#properties-of-the-whole-protocol.6`: H-08 and "In the hardened profile the
/// local services of a group MUST NOT be stopped while no result of the running session was in a
/// safe cycle": make before break.
#[test]
fn local_services_stop_only_at_the_first_safe_verdict_that_names_the_group_after_a_used_result()
-> TestResult {
    let mut table = FREE;
    let mut requester = Requester::new(Profile::Hardened, TIMES, &mut table)?;
    act(&mut requester, 0, offer(1, Groups::ALL), &[])?;
    act(&mut requester, 0, TICK, &[request(1, MOT, 1), request(1, PLAN, 2)])?;
    act(&mut requester, 0, confirm(1, MOT, 1), &[])?;
    act(&mut requester, 0, confirm(1, PLAN, 2), &[])?;
    act(&mut requester, 1, SAFE, &[])?;
    act(&mut requester, 2, data(1, MOT, 1, 2), &[])?;
    act(&mut requester, 3, safe(Groups::NONE), &[])?;
    act(&mut requester, 3, safe(only(PLAN)), &[])?;
    assert_eq!(requester.configuration(), Configuration::AllRemote);
    assert_eq!(requester.source(MOT), Source::Local, "make before break");
    act(&mut requester, 4, safe(Groups::ALL), &[Action::Deactivate(MOT)])?;
    assert_eq!(requester.source(MOT), Source::Remote { station: 1 });
    assert_eq!(requester.source(PLAN), Source::Local);
    act(&mut requester, 5, safe(Groups::ALL), &[])?;
    // A used result of an earlier session is none of this one.
    act(&mut requester, 6, lost(1), &[Action::Activate(MOT)])?;
    act(&mut requester, 6, offer(1, only(MOT)), &[])?;
    act(&mut requester, 6, TICK, &[request(1, MOT, 3)])?;
    act(&mut requester, 6, confirm(1, MOT, 3), &[])?;
    act(&mut requester, 7, safe(Groups::ALL), &[])
}

/// H-08: "leaving before that needs no activation" - whatever the way back.
#[test]
fn leaving_before_the_local_services_stopped_needs_no_activation() -> TestResult {
    let released = [release(1, MOT, 1)];
    let dropped = [Action::Drop(MOT), release(1, MOT, 1)];
    let ways: [(EventKind, &[Action]); 7] = [
        (withdraw(1), &released),
        (lost(1), &[]),
        (offer(1, only(PLAN)), &released),
        (area(only(PLAN)), &released),
        (data(1, MOT, 1, 999), &dropped),
        (UNSAFE, &released),
        (TICK, &released),
    ];
    for (kind, expected) in ways {
        let mut table = FREE;
        let mut requester = Requester::new(Profile::Hardened, TIMES, &mut table)?;
        act(&mut requester, 0, offer(1, only(MOT)), &[])?;
        act(&mut requester, 0, TICK, &[request(1, MOT, 1)])?;
        act(&mut requester, 0, confirm(1, MOT, 1), &[])?;
        act(&mut requester, 0, data(1, MOT, 1, 0), &[])?;
        act(&mut requester, 101, kind, expected)?;
        assert_eq!(requester.state(MOT), GroupState::Local, "{kind:?}");
    }
    Ok(())
}

/// `spec/1-services.md#configuration.2`: "The local services of a group that becomes remote MUST
/// stop at the confirmation in the paper profile, and at the first safe verdict after a used result
/// in the hardened profile (H-08)."
#[test]
fn in_the_paper_profile_local_services_stop_at_the_confirmation() -> TestResult {
    let mut table = FREE;
    let mut requester = Requester::new(Profile::Paper, TIMES, &mut table)?;
    act(&mut requester, 0, offer(1, only(MOT)), &[])?;
    act(&mut requester, 0, TICK, &[request(1, MOT, 1)])?;
    assert_eq!(requester.source(MOT), Source::Local, "requested is not remote");
    act(&mut requester, 0, confirm(1, MOT, 1), &[Action::Deactivate(MOT)])?;
    assert_eq!(requester.source(MOT), Source::Remote { station: 1 });
    assert_eq!(requester.configuration(), Configuration::MotRemote);
    act(&mut requester, 0, data(1, MOT, 1, 0), &[])?;
    act(&mut requester, 0, SAFE, &[])
}

/// `spec/2-offloading.md#properties-of-the-whole-protocol.7`: "A message of an ended session MUST
/// NOT change a later one."
#[test]
fn a_message_of_an_ended_session_does_not_change_a_later_one() -> TestResult {
    let mut table = FREE;
    let mut requester = remote(Profile::Paper, TIMES, &mut table)?;
    act(&mut requester, 1, area(only(PLAN)), &[release(1, MOT, 1), Action::Activate(MOT)])?;
    act(&mut requester, 1, area(Groups::ALL), &[])?;
    act(&mut requester, 1, TICK, &[request(1, MOT, 3)])?;
    let later = requester.state(MOT);
    act(&mut requester, 1, confirm(1, MOT, 1), &[release(1, MOT, 1)])?;
    act(&mut requester, 1, reject(1, MOT, 1), &[])?;
    act(&mut requester, 1, data(1, MOT, 1, 900), &[Action::Drop(MOT)])?;
    assert_eq!(requester.state(MOT), later);
    act(&mut requester, 1, confirm(1, MOT, 3), &[Action::Deactivate(MOT)])?;
    let later = requester.state(MOT);
    act(&mut requester, 90, confirm(1, MOT, 1), &[release(1, MOT, 1)])?;
    act(&mut requester, 90, reject(1, MOT, 1), &[])?;
    act(&mut requester, 90, data(1, MOT, 1, 900), &[Action::Drop(MOT)])?;
    assert_eq!(requester.state(MOT), later);
    Ok(())
}

/// What an observer has seen of one group.
#[derive(Clone, Copy, Debug, Default)]
struct Seen {
    /// Station and session of the last request.
    asked: Option<(i64, i64)>,
    local_stopped: bool,
    stops: u32,
    starts: u32,
}

/// Pseudo-random numbers (Marsaglia's xorshift), the same in every run.
fn draw(state: &mut u64, below: u64) -> u64 {
    *state ^= *state << 13;
    *state ^= *state >> 7;
    *state ^= *state << 17;
    state.wrapping_mul(0x2545_F491_4F6C_DD1D).checked_rem(below).unwrap_or(0)
}

fn random_event(state: &mut u64, t_ns: i64, sessions: i64) -> EventKind {
    let mut number = |below| i64::try_from(draw(state, below)).unwrap_or(0);
    let station = number(3).saturating_add(1);
    let group = if number(2) == 0 { MOT } else { PLAN };
    let groups = Groups { mot: number(4) != 0, plan: number(4) != 0 };
    let session = sessions.saturating_sub(number(4));
    let generated_ns = t_ns.saturating_sub(number(23)).saturating_add(1);
    match number(100) {
        0..=5 => offer(station, groups),
        6 => withdraw(station),
        7 => lost(station),
        8 => area(groups),
        9..=20 => TICK,
        21..=48 => confirm(station, group, session),
        49..=50 => reject(station, group, session),
        51 => EventKind::Verdict { safe: false, groups },
        52..=60 => safe(groups),
        _ => data(station, group, session, generated_ns),
    }
}

/// What every step must keep, told from the event, the actions and the states alone.
fn observe(
    requester: &Requester<'_>,
    profile: Profile,
    event: &Event,
    actions: &Actions,
    seen: &mut [(Group, Seen); 2],
) {
    assert!(requester.is_valid(), "{event:?}: {requester:?}");
    let rank = |action: &Action| match *action {
        Action::Drop(group) => (0, group),
        Action::Release { group, .. } => (1, group),
        Action::Activate(group) | Action::Deactivate(group) => (2, group),
        Action::Request { group, .. } => (3, group),
    };
    assert!(actions.is_sorted_by(|one, other| rank(one) < rank(other)), "{actions:?}");
    for (group, seen) in seen {
        let group = *group;
        for action in actions {
            match *action {
                Action::Request { station, group: of, session } if of == group => {
                    assert_eq!(event.kind, TICK);
                    assert!(requester.hold_until_ns().is_none_or(|until| event.t_ns >= until));
                    seen.asked = Some((station, session));
                }
                Action::Activate(of) if of == group => {
                    assert!(seen.local_stopped, "only what was stopped is started");
                    seen.local_stopped = false;
                    seen.starts = seen.starts.saturating_add(1);
                }
                Action::Deactivate(of) if of == group => {
                    let at_verdict = matches!(event.kind, EventKind::Verdict { safe: true, .. });
                    assert_eq!(at_verdict, profile == Profile::Hardened);
                    assert!(!seen.local_stopped);
                    seen.local_stopped = true;
                    seen.stops = seen.stops.saturating_add(1);
                }
                Action::Request { .. }
                | Action::Release { .. }
                | Action::Activate(_)
                | Action::Deactivate(_)
                | Action::Drop(_) => {}
            }
        }
        match requester.state(group) {
            GroupState::Local => assert!(!seen.local_stopped),
            GroupState::Requested { station, session, .. } => {
                assert_eq!(seen.asked, Some((station, session)));
                assert!(!seen.local_stopped);
            }
            GroupState::Remote { station, session } => {
                assert_eq!(seen.asked, Some((station, session)), "its last request");
            }
        }
        assert_eq!(requester.source(group) == Source::Local, !seen.local_stopped);
        if matches!(event.kind, EventKind::Verdict { safe: false, .. }) {
            assert_eq!(requester.state(group), GroupState::Local);
        }
    }
}

/// `spec/2-offloading.md#properties-of-the-whole-protocol.1`,
/// `spec/2-offloading.md#properties-of-the-whole-protocol.2`: "At every time each group MUST have
/// exactly one source", "After a safety issue no remote result MUST reach control before
/// `hold_until`", and the order of actions, along random events.
#[test]
fn random_events_keep_the_properties() -> TestResult {
    let mut state = 0x9E37_79B9_7F4A_7C15;
    let mut back = (0_u32, 0_u32);
    for round in 0..200 {
        let profile = if round % 2 == 0 { Profile::Paper } else { Profile::Hardened };
        let parameters = Parameters { qos_hold: round % 4 >= 2, t_wait_ns: 30, ..TIMES };
        let mut table = FREE;
        let mut requester = Requester::new(profile, parameters, &mut table)?;
        let mut seen = [(MOT, Seen::default()), (PLAN, Seen::default())];
        // The end of the last hold that a verdict started.
        let mut barred_until_ns = i64::MIN;
        let mut t_ns = 0_i64;
        for _ in 0..2000 {
            t_ns = t_ns.saturating_add(i64::try_from(draw(&mut state, 4)).unwrap_or(0));
            let event = Event { t_ns, kind: random_event(&mut state, t_ns, requester.sessions()) };
            let actions = requester.step(&event)?;
            observe(&requester, profile, &event, &actions, &mut seen);
            if matches!(event.kind, EventKind::Verdict { safe: false, .. }) {
                barred_until_ns = t_ns.saturating_add(30);
            }
            if t_ns < barred_until_ns {
                assert_eq!(requester.configuration(), Configuration::Local);
            }
        }
        for (group, seen) in seen {
            let times = match profile {
                Profile::Paper => &mut back.0,
                Profile::Hardened => &mut back.1,
            };
            *times = times.saturating_add(seen.starts);
            assert!(seen.stops >= seen.starts, "{group:?} in round {round}: {seen:?}");
        }
    }
    assert!(back.0 > 200 && back.1 > 200, "groups went away and came back: {back:?}");
    Ok(())
}
