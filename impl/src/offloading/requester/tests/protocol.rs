//! `spec/2-offloading.md#requester`.

use super::super::{GroupState, Source};
use super::*;

const LOCAL: GroupState = GroupState::Local;

/// `spec/2-offloading.md#requester.1`: "An offer MUST replace the station's previous offer; a group
/// in use that the new offer no longer contains MUST be left as by a withdrawal."
#[test]
fn an_offer_replaces_the_previous_one_and_what_it_lacks_is_left() -> TestResult {
    for profile in PROFILES {
        let mut table = FREE;
        let mut requester = remote(profile, TIMES, &mut table)?;
        let left = [release(1, MOT, 1), Action::Activate(MOT)];
        act(&mut requester, 1, offer(1, only(PLAN)), &left)?;
        assert_eq!(requester.state(MOT), LOCAL);
        assert_eq!(requester.state(PLAN), GroupState::Remote { station: 1, session: 2 });
        assert_eq!(requester.hold_until_ns(), None, "without a hold");
        act(&mut requester, 2, TICK, &[])?;
        act(&mut requester, 3, offer(1, Groups::ALL), &[])?;
        act(&mut requester, 4, TICK, &[request(1, MOT, 3)])?;
        act(&mut requester, 5, offer(1, only(PLAN)), &[release(1, MOT, 3)])?;
        let left = [release(1, PLAN, 2), Action::Activate(PLAN)];
        act(&mut requester, 6, offer(1, Groups::NONE), &left)?;
        act(&mut requester, 7, TICK, &[])?;
    }
    Ok(())
}

/// `spec/2-offloading.md#requester.2`: "A request MUST be sent only for a group in `Local`, to a
/// station whose current offer contains it, while the group is in the area (CODM), and not before
/// `hold_until`."
#[test]
fn a_request_is_sent_only_for_a_local_group_that_is_offered_in_the_area_without_hold() -> TestResult
{
    let mut table = FREE;
    let mut requester = Requester::new(Profile::Paper, TIMES, &mut table)?;
    act(&mut requester, 0, TICK, &[])?;
    act(&mut requester, 0, offer(2, only(PLAN)), &[])?;
    act(&mut requester, 0, offer(1, only(MOT)), &[])?;
    act(&mut requester, 0, withdraw(1), &[])?;
    act(&mut requester, 0, area(only(MOT)), &[])?;
    act(&mut requester, 1, TICK, &[])?;
    act(&mut requester, 1, area(Groups::ALL), &[])?;
    act(&mut requester, 1, UNSAFE, &[])?;
    act(&mut requester, 1000, TICK, &[])?;
    act(&mut requester, 1001, TICK, &[request(2, PLAN, 1)])?;
    act(&mut requester, 1002, TICK, &[])?;
    act(&mut requester, 1002, confirm(2, PLAN, 1), &[Action::Deactivate(PLAN)])?;
    act(&mut requester, 1003, TICK, &[])
}

/// `spec/2-offloading.md#requester.2`: "Requests MUST be decided at ticks only, MOT before PLAN; a
/// group that returned to local at this tick waits for the next."
#[test]
fn requests_are_decided_at_ticks_only_and_a_group_that_returned_at_this_tick_waits() -> TestResult {
    let mut table = FREE;
    let mut requester = Requester::new(Profile::Paper, TIMES, &mut table)?;
    act(&mut requester, 0, area(Groups::ALL), &[])?;
    act(&mut requester, 0, offer(1, only(PLAN)), &[])?;
    act(&mut requester, 0, offer(2, Groups::ALL), &[])?;
    act(&mut requester, 0, safe(Groups::ALL), &[])?;
    act(&mut requester, 0, TICK, &[request(2, MOT, 1), request(1, PLAN, 2)])?;
    act(&mut requester, 1, reject(2, MOT, 1), &[])?;
    act(&mut requester, 1, TICK, &[request(2, MOT, 3)])?;
    act(&mut requester, 50, TICK, &[release(1, PLAN, 2)])?;
    act(&mut requester, 50, TICK, &[request(2, PLAN, 4)])?;
    act(&mut requester, 50, confirm(2, MOT, 3), &[Action::Deactivate(MOT)])?;
    let silent = [release(2, MOT, 3), release(2, PLAN, 4), Action::Activate(MOT)];
    act(&mut requester, 151, TICK, &silent)?;
    act(&mut requester, 151, TICK, &[request(2, MOT, 5), request(1, PLAN, 6)])
}

/// "Requests of one requester are numbered 1, 2, 3, ...: that number is the session" - over both
/// groups and all stations; the last number there is does not come round again.
#[test]
fn sessions_are_numbered_over_all_groups_and_never_twice() -> TestResult {
    let mut table = FREE;
    let mut requester = Requester::new(Profile::Paper, TIMES, &mut table)?;
    act(&mut requester, 0, offer(1, only(MOT)), &[])?;
    act(&mut requester, 0, offer(2, only(PLAN)), &[])?;
    act(&mut requester, 0, TICK, &[request(1, MOT, 1), request(2, PLAN, 2)])?;
    act(&mut requester, 0, reject(2, PLAN, 2), &[])?;
    act(&mut requester, 0, TICK, &[request(2, PLAN, 3)])?;
    act(&mut requester, 0, reject(1, MOT, 1), &[])?;
    act(&mut requester, 0, reject(2, PLAN, 3), &[])?;
    requester.sessions = i64::MAX.saturating_sub(1);
    act(&mut requester, 0, TICK, &[request(1, MOT, i64::MAX)])?;
    assert!(requester.sessions_exhausted());
    act(&mut requester, 1, TICK, &[])?;
    act(&mut requester, 50, TICK, &[release(1, MOT, i64::MAX)])
}

/// `spec/2-offloading.md#requester.3`: "Among the stations that offer a group, one never asked for
/// this group MUST be taken first (the smallest id), then the one whose last request for this group
/// is the oldest in the order of the requests, not of their times; a withdrawal forgets nothing."
#[test]
fn one_never_asked_first_then_the_oldest_request_and_a_withdrawal_forgets_nothing() -> TestResult {
    for gone in [withdraw(1), lost(1), offer(1, Groups::NONE)] {
        let mut table = FREE;
        let mut requester = Requester::new(Profile::Paper, TIMES, &mut table)?;
        for station in [3, 1, 2] {
            act(&mut requester, 0, offer(station, only(MOT)), &[])?;
        }
        // Times run backwards; the order of the requests counts.
        for (t_ns, station, session) in [(9, 1, 1), (8, 2, 2), (7, 3, 3), (6, 1, 4)] {
            act(&mut requester, t_ns, TICK, &[request(station, MOT, session)])?;
            act(&mut requester, t_ns, reject(station, MOT, session), &[])?;
        }
        act(&mut requester, 5, gone, &[])?;
        act(&mut requester, 4, offer(1, only(MOT)), &[])?;
        for (t_ns, station, session) in [(3, 2, 5), (2, 3, 6), (1, 1, 7)] {
            act(&mut requester, t_ns, TICK, &[request(station, MOT, session)])?;
            act(&mut requester, t_ns, reject(station, MOT, session), &[])?;
        }
        act(&mut requester, 0, offer(4, only(MOT)), &[])?;
        act(&mut requester, 0, TICK, &[request(4, MOT, 8)])?;
    }
    Ok(())
}

/// `spec/2-offloading.md#requester.3`: "So a station that always rejects starves nobody": each
/// group has its own order.
#[test]
fn a_station_that_always_rejects_starves_nobody() -> TestResult {
    let mut table = FREE;
    let mut requester = Requester::new(Profile::Hardened, TIMES, &mut table)?;
    act(&mut requester, 0, offer(1, Groups::ALL), &[])?;
    act(&mut requester, 0, offer(2, Groups::ALL), &[])?;
    act(&mut requester, 0, TICK, &[request(1, MOT, 1), request(1, PLAN, 2)])?;
    act(&mut requester, 0, reject(1, MOT, 1), &[])?;
    act(&mut requester, 1, TICK, &[request(2, MOT, 3)])?;
    act(&mut requester, 1, reject(1, PLAN, 2), &[])?;
    act(&mut requester, 2, TICK, &[request(2, PLAN, 4)])
}

/// `spec/2-offloading.md#requester.4`: "A confirmation of the requested session, from its station,
/// before its deadline MUST move the group to `Remote`; a confirmation of the running session MUST
/// be ignored".
#[test]
fn a_confirmation_before_the_deadline_moves_to_remote_and_again_is_ignored() -> TestResult {
    for (profile, stop) in PROFILES.into_iter().zip([[Action::Deactivate(MOT)].as_slice(), &[]]) {
        let mut table = FREE;
        let mut requester = Requester::new(profile, TIMES, &mut table)?;
        act(&mut requester, 0, offer(1, only(MOT)), &[])?;
        act(&mut requester, 0, TICK, &[request(1, MOT, 1)])?;
        let requested = GroupState::Requested { station: 1, session: 1, deadline_ns: 50 };
        assert_eq!(requester.state(MOT), requested);
        act(&mut requester, 49, confirm(1, MOT, 1), stop)?;
        assert_eq!(requester.state(MOT), GroupState::Remote { station: 1, session: 1 });
        act(&mut requester, 60, confirm(1, MOT, 1), &[])?;
        assert_eq!(requester.state(MOT), GroupState::Remote { station: 1, session: 1 });
        // The repeated confirmation is neither an arrival nor an activation.
        act(&mut requester, 149, TICK, &[])?;
        let back = [release(1, MOT, 1), Action::Activate(MOT)];
        let stopped = stop.len();
        let back = back.get(..stopped.saturating_add(1)).unwrap_or(&back);
        act(&mut requester, 150, TICK, back)?;
    }
    Ok(())
}

/// `spec/2-offloading.md#requester.4`: "any other confirmation MUST be answered with a release of
/// the session it names and change nothing else."
#[test]
fn any_other_confirmation_is_answered_with_a_release_and_changes_nothing() -> TestResult {
    let mut table = FREE;
    let mut requester = Requester::new(Profile::Paper, TIMES, &mut table)?;
    act(&mut requester, 0, confirm(7, PLAN, -3), &[release(7, PLAN, -3)])?;
    act(&mut requester, 0, offer(1, Groups::ALL), &[])?;
    act(&mut requester, 0, offer(2, Groups::ALL), &[])?;
    act(&mut requester, 0, TICK, &[request(1, MOT, 1), request(1, PLAN, 2)])?;
    let requested = requester.state(MOT);
    act(&mut requester, 1, confirm(2, MOT, 1), &[release(2, MOT, 1)])?;
    act(&mut requester, 1, confirm(1, MOT, 2), &[release(1, MOT, 2)])?;
    act(&mut requester, 1, confirm(1, PLAN, 1), &[release(1, PLAN, 1)])?;
    act(&mut requester, 50, confirm(1, MOT, 1), &[release(1, MOT, 1)])?;
    assert_eq!(requester.state(MOT), requested, "the deadline itself is too late, not yet told");
    act(&mut requester, 49, confirm(1, MOT, 1), &[Action::Deactivate(MOT)])?;
    act(&mut requester, 49, confirm(2, MOT, 1), &[release(2, MOT, 1)])?;
    assert_eq!(requester.source(MOT), Source::Remote { station: 1 });
    assert_eq!(requester.hold_until_ns(), None);
    Ok(())
}

/// `spec/2-offloading.md#requester.5`: "A request not confirmed before its deadline MUST return the
/// group to `Local` at the first tick that can tell, with a release sent".
#[test]
fn a_request_not_confirmed_before_its_deadline_ends_at_the_first_tick_that_can_tell() -> TestResult
{
    let mut table = FREE;
    let mut requester = Requester::new(Profile::Hardened, TIMES, &mut table)?;
    act(&mut requester, 0, offer(1, only(PLAN)), &[])?;
    act(&mut requester, 0, TICK, &[request(1, PLAN, 1)])?;
    act(&mut requester, 49, TICK, &[])?;
    act(&mut requester, 51, offer(1, only(PLAN)), &[])?;
    assert_ne!(requester.state(PLAN), LOCAL, "at ticks only");
    act(&mut requester, 50, TICK, &[release(1, PLAN, 1)])?;
    assert_eq!(requester.state(PLAN), LOCAL);
    Ok(())
}

/// `spec/2-offloading.md#requester.5`: "a rejection of the requested session MUST return it at
/// once, without a release; any other rejection MUST be ignored."
#[test]
fn a_rejection_returns_the_group_without_a_release_and_any_other_is_ignored() -> TestResult {
    let mut table = FREE;
    let mut requester = Requester::new(Profile::Paper, TIMES, &mut table)?;
    act(&mut requester, 0, offer(1, Groups::ALL), &[])?;
    act(&mut requester, 0, TICK, &[request(1, MOT, 1), request(1, PLAN, 2)])?;
    act(&mut requester, 0, confirm(1, PLAN, 2), &[Action::Deactivate(PLAN)])?;
    let states = [MOT, PLAN].map(|group| requester.state(group));
    for other in [reject(1, MOT, 2), reject(2, MOT, 1), reject(1, PLAN, 1), reject(1, PLAN, 2)] {
        act(&mut requester, 1, other, &[])?;
        assert_eq!([MOT, PLAN].map(|group| requester.state(group)), states, "{other:?}");
    }
    act(&mut requester, 60, reject(1, MOT, 1), &[])?;
    assert_eq!(requester.state(MOT), LOCAL, "also after the deadline, while it is requested");
    assert_eq!(requester.hold_until_ns(), None);
    act(&mut requester, 60, reject(1, MOT, 1), &[])
}

/// `spec/2-offloading.md#requester.6`: "All groups are in the area until the first `area` event; an
/// `area` event replaces the set, and a group that is requested or remote and no longer in the area
/// MUST return to local with a release, without a hold."
#[test]
fn an_area_event_replaces_the_set_and_what_it_lacks_returns_without_a_hold() -> TestResult {
    for profile in PROFILES {
        let mut table = FREE;
        let mut requester = remote(profile, TIMES, &mut table)?;
        let left = [release(1, PLAN, 2), Action::Activate(PLAN)];
        act(&mut requester, 1, area(only(MOT)), &left)?;
        act(&mut requester, 1, TICK, &[])?;
        act(&mut requester, 2, area(Groups::ALL), &[])?;
        act(&mut requester, 3, TICK, &[request(1, PLAN, 3)])?;
        let left = [release(1, MOT, 1), release(1, PLAN, 3), Action::Activate(MOT)];
        act(&mut requester, 4, area(Groups::NONE), &left)?;
        act(&mut requester, 5, TICK, &[])?;
        assert_eq!(requester.hold_until_ns(), None);
    }
    Ok(())
}

/// `spec/2-offloading.md#requester.7`: "Data for a group MUST be used only when the group is
/// `Remote` and station and session are the running ones; all other data MUST be dropped and
/// counted."
#[test]
fn data_of_any_but_the_running_session_are_dropped_and_counted() -> TestResult {
    let mut table = FREE;
    let mut requester = Requester::new(Profile::Hardened, TIMES, &mut table)?;
    let dropped = [Action::Drop(MOT)];
    act(&mut requester, 0, data(1, MOT, 1, 0), &dropped)?;
    act(&mut requester, 0, offer(1, Groups::ALL), &[])?;
    act(&mut requester, 0, TICK, &[request(1, MOT, 1), request(1, PLAN, 2)])?;
    act(&mut requester, 0, data(1, MOT, 1, 0), &dropped)?;
    act(&mut requester, 0, confirm(1, MOT, 1), &[])?;
    for other in [data(2, MOT, 1, 0), data(1, MOT, 2, 0), data(1, MOT, 0, 900)] {
        act(&mut requester, 0, other, &dropped)?;
    }
    act(&mut requester, 0, data(1, PLAN, 1, 0), &[Action::Drop(PLAN)])?;
    assert_eq!((requester.dropped(MOT), requester.dropped(PLAN)), (5, 1));
    act(&mut requester, 0, SAFE, &[])?;
    act(&mut requester, 0, data(1, MOT, 1, 0), &[])?;
    act(&mut requester, 0, SAFE, &[Action::Deactivate(MOT)])?;
    assert_eq!(requester.dropped(MOT), 5, "an element that is used is not counted");
    Ok(())
}

/// `spec/2-offloading.md#requester.8`: "A withdrawal MUST remove the station's offer and return
/// every group that is requested from it or runs on it to local at once, with a release; a loss
/// does the same without a release; neither starts a hold."
#[test]
fn a_withdrawal_returns_its_groups_with_a_release_and_a_loss_without() -> TestResult {
    for profile in PROFILES {
        for (gone, released) in [(withdraw(1), true), (lost(1), false)] {
            let mut table = FREE;
            let mut requester = remote(profile, TIMES, &mut table)?;
            act(&mut requester, 1, withdraw(2), &[])?;
            act(&mut requester, 1, lost(3), &[])?;
            act(
                &mut requester,
                1,
                area(only(MOT)),
                &[release(1, PLAN, 2), Action::Activate(PLAN)],
            )?;
            act(&mut requester, 1, area(Groups::ALL), &[])?;
            act(&mut requester, 1, TICK, &[request(1, PLAN, 3)])?;
            let with = [release(1, MOT, 1), release(1, PLAN, 3), Action::Activate(MOT)];
            let expected = if released { with.as_slice() } else { &[Action::Activate(MOT)] };
            act(&mut requester, 2, gone, expected)?;
            assert_eq!([requester.state(MOT), requester.state(PLAN)], [LOCAL, LOCAL]);
            assert_eq!(requester.hold_until_ns(), None);
            act(&mut requester, 3, TICK, &[])?;
        }
    }
    Ok(())
}

/// `spec/2-offloading.md#requester.9`: "MOT and PLAN may run on different stations; one requester
/// MUST handle offers of several providers at the same time."
#[test]
fn mot_and_plan_may_run_on_different_stations() -> TestResult {
    let mut table = FREE;
    let mut requester = Requester::new(Profile::Paper, TIMES, &mut table)?;
    act(&mut requester, 0, offer(5, only(MOT)), &[])?;
    act(&mut requester, 0, offer(3, only(PLAN)), &[])?;
    act(&mut requester, 0, TICK, &[request(5, MOT, 1), request(3, PLAN, 2)])?;
    act(&mut requester, 0, confirm(3, PLAN, 2), &[Action::Deactivate(PLAN)])?;
    act(&mut requester, 0, confirm(5, MOT, 1), &[Action::Deactivate(MOT)])?;
    assert_eq!(requester.source(MOT), Source::Remote { station: 5 });
    assert_eq!(requester.source(PLAN), Source::Remote { station: 3 });
    act(&mut requester, 1, lost(5), &[Action::Activate(MOT)])?;
    assert_eq!(requester.source(PLAN), Source::Remote { station: 3 });
    Ok(())
}
