//! One group of the requester (`spec/2-offloading.md`), law by law.

use mufasa::offloading::requester::{
    Event, EventKind, GroupRecord, Parameters, Parts, Requester, Running, Sessions,
    StationRecord, Suspended,
};
use mufasa::services::configuration::Group;

use crate::law::requester::{self as law, Seen, Step};
use super::any::{below, duration_ns, group, groups, near_integer, option, profile, time_ns};
#[cfg(not(kani))]
use crate::kani;

/// x
///
/// Domain: all
#[cfg_attr(kani, kani::proof)]
#[cfg_attr(kani, kani::unwind(9))]
pub fn verify_t_wait_blocks_offloading() {
    let mut table = [];
    holds_after_any_event(&mut table, law::t_wait_blocks_offloading);
}

/// x
///
/// Domain: all
#[cfg_attr(kani, kani::proof)]
#[cfg_attr(kani, kani::unwind(9))]
pub fn verify_requests_are_decided_at_ticks_only() {
    let mut table = [];
    holds_after_any_event(&mut table, law::requests_are_decided_at_ticks_only);
}

/// x
///
/// Domain: all
#[cfg_attr(kani, kani::proof)]
#[cfg_attr(kani, kani::unwind(9))]
pub fn verify_a_safety_issue_ends_every_remote_service() {
    let mut table = [];
    holds_after_any_event(&mut table, law::a_safety_issue_ends_every_remote_service);
}

/// x
///
/// Domain: all
#[cfg_attr(kani, kani::proof)]
#[cfg_attr(kani, kani::unwind(9))]
pub fn verify_a_hold_is_never_shortened() {
    let mut table = [];
    holds_after_any_event(&mut table, law::a_hold_is_never_shortened);
}

/// x
///
/// Domain: all
#[cfg_attr(kani, kani::proof)]
#[cfg_attr(kani, kani::unwind(9))]
pub fn verify_a_session_left_is_released_exactly_once() {
    let mut table = [];
    holds_after_any_event(&mut table, law::a_session_left_is_released_exactly_once);
}

/// x
///
/// Domain: all
#[cfg_attr(kani, kani::proof)]
#[cfg_attr(kani, kani::unwind(9))]
pub fn verify_actions_come_in_their_order() {
    let mut table = [];
    holds_after_any_event(&mut table, law::actions_come_in_their_order);
}

/// x
///
/// Domain: all
#[cfg_attr(kani, kani::proof)]
#[cfg_attr(kani, kani::unwind(9))]
pub fn verify_local_services_stop_when_the_profile_says() {
    let mut table = [];
    holds_after_any_event(&mut table, law::local_services_stop_when_the_profile_says);
}

/// x
///
/// Domain: all
#[cfg_attr(kani, kani::proof)]
#[cfg_attr(kani, kani::unwind(9))]
pub fn verify_a_group_becomes_remote_by_confirmation_only() {
    let mut table = [];
    holds_after_any_event(&mut table, law::a_group_becomes_remote_by_confirmation_only);
}

fn holds_after_any_event(table: &mut [StationRecord], law: impl Fn(&Step<'_>) -> bool) {
    let (aside, parts) = any_state();
    let mut requester = Requester::resume(aside, table);
    let before = Seen { valid: true, ..seen(&requester) };
    let event = any_event();
    let Ok(actions) = requester.step(&event) else { return };
    let after = Seen { valid: true, ..seen(&requester) };
    let step = Step {
        profile: parts.profile,
        parameters: parts.parameters,
        before,
        event,
        actions: &actions,
        after,
    };
    assert!(law(&step));
    kani::cover!(before.states != after.states, "a group changes");
}

fn seen(requester: &Requester<'_>) -> Seen {
    Seen {
        states: [requester.state(Group::Mot), requester.state(Group::Plan)],
        sources: [requester.source(Group::Mot), requester.source(Group::Plan)],
        hold_until_ns: requester.hold_until_ns(),
        valid: true,
    }
}

fn any_event() -> Event {
    let (station, session, generated_ns, t_ns) =
        (near_integer(1, 3), near_integer(1, 6), time_ns(), time_ns());
    let (groups, group) = (groups(), group());
    let sessions = Sessions { mot: option(|| near_integer(1, 6)), plan: option(|| near_integer(1, 6)) };
    let kind = match below(9) {
        0 => EventKind::Offer { station, groups },
        1 => EventKind::Withdraw { station },
        2 => EventKind::Lost { station },
        3 => EventKind::Area { groups },
        4 => EventKind::Tick,
        5 => EventKind::Confirm { station, group, session },
        6 => EventKind::Reject { station, group, session },
        7 => EventKind::Data { station, group, session, generated_ns },
        _ => EventKind::Verdict { safe: kani::any(), sessions },
    };
    Event { t_ns, kind }
}

fn parameters() -> Parameters {
    Parameters {
        t_wait_ns: duration_ns(),
        request_timeout_ns: duration_ns(),
        l_max_ns: duration_ns(),
        dt_max_ns: duration_ns(),
        qos_hold: kani::any(),
    }
}

fn any_state() -> (Suspended, Parts) {
    let parts = Parts {
        profile: profile(),
        parameters: parameters(),
        groups: [any_group(), any_group()],
        hold_until_ns: option(time_ns),
        area: groups(),
        sessions: near_integer(4, 8),
        dropped: [kani::any(), kani::any()],
    };
    (Suspended::from_parts(&parts), parts)
}

fn any_group() -> GroupRecord {
    let (kind, station, session) = (below(3), near_integer(1, 3), near_integer(1, 6));
    let (deadline_ns, last_arrival_ns, last_used_ns) = (time_ns(), time_ns(), option(time_ns));
    let local_computes = kani::any();
    match kind {
        0 => GroupRecord::Local,
        1 => GroupRecord::Requested { station, session, deadline_ns },
        _ => GroupRecord::Remote(Running {
            station,
            session,
            last_arrival_ns,
            last_used_ns,
            local_computes,
        }),
    }
}
