//! The requester (`spec/2-offloading.md`) by induction: from every valid state every event keeps
//! all laws and leads to a valid state, so they hold after any number of events.

use mufasa::configuration::Group;
use mufasa::cycle::Profile;
use mufasa::requester::{
    Event, EventKind, GroupRecord, GroupState, Parameters, Parts, Requester, RequesterError,
    Running, StationRecord, Suspended,
};

use super::any::{below, duration_ns, group, groups, near_integer, option, profile, time_ns};
use super::bounds::STATIONS;
#[cfg(not(kani))]
use crate::kani;
use crate::law::requester::{self as law, Seen, Step};

/// The first state is valid: the base of the induction.
///
/// Domain: both profiles, all times >= 0, any content of the table. Not covered: larger tables.
#[cfg_attr(kani, kani::proof)]
#[cfg_attr(kani, kani::unwind(4))]
pub fn verify_requester_starts_valid() {
    let parameters = parameters();
    let mut table = [any_record(), any_record()];
    let requester = Requester::new(profile(), parameters, &mut table);
    let Ok(requester) = requester else { unreachable!("times are >= 0") };
    assert!(requester.is_valid());
    assert!(Seen::of(&requester).states == [GroupState::Local; 2]);
    assert!(requester.hold_until_ns().is_none() && requester.sessions() == 0);
    kani::cover!(parameters.qos_hold, "a violation starts a hold");
    kani::cover!(!parameters.qos_hold, "a violation starts no hold");
}

/// Every event in every valid state keeps the laws of `law::requester` and leads to a valid state:
/// no request before `hold_until`, a safety issue makes every group local and holds, no hold is
/// ever shortened, whatever time does.
///
/// Domain: all valid states of a table of two stations, all events, all times of 64 bits. Not
/// covered: larger tables.
#[cfg_attr(kani, kani::proof)]
#[cfg_attr(kani, kani::unwind(10))]
pub fn verify_requester_keeps_every_law() {
    let (mut table, aside, profile, parameters) = any_state();
    let mut requester = Requester::resume(aside, &mut table);
    kani::assume(requester.is_valid());
    let before = Seen::of(&requester);
    let event = any_event(&before);
    let Ok(actions) = requester.step(&event) else {
        kani::cover!(true, "an event that is refused");
        return;
    };
    let after = Seen::of(&requester);
    let step = Step { profile, parameters, before, event, actions: &actions, after };
    assert!(law::every_reachable_state_is_valid(&step));
    assert!(law::t_wait_blocks_offloading(&step));
    assert!(law::requests_are_decided_at_ticks_only(&step));
    assert!(law::a_safety_issue_ends_every_remote_service(&step));
    assert!(law::a_hold_is_never_shortened(&step));
    assert!(law::a_session_left_is_released_exactly_once(&step));
    assert!(law::actions_come_in_their_order(&step));
    assert!(law::local_services_stop_when_the_profile_says(&step));
    assert!(law::a_group_becomes_remote_by_confirmation_only(&step));
    cover_steps(&step);
}

fn cover_steps(step: &Step<'_>) {
    let is_tick = step.event.kind == EventKind::Tick;
    let was_local = step.before.states == [GroupState::Local; 2];
    let is_local = step.after.states == [GroupState::Local; 2];
    let is_unsafe = matches!(step.event.kind, EventKind::Verdict { safe: false, .. });
    kani::cover!(is_tick && was_local && !is_local, "a request");
    kani::cover!(is_tick && !was_local && is_local, "a request or a session ends at a tick");
    kani::cover!(is_unsafe && !was_local, "a fallback");
    kani::cover!(is_unsafe && step.after.hold_until_ns == Some(i64::MAX), "a hold saturates");
    kani::cover!(
        matches!(step.event.kind, EventKind::Confirm { .. }) && step.after != step.before,
        "a confirmation"
    );
    kani::cover!(
        matches!(step.event.kind, EventKind::Data { .. })
            && step.after.states != step.before.states,
        "a violation of quality of service"
    );
    kani::cover!(step.after.sources != step.before.sources && !is_local, "a source changes");
}

/// An event that is refused changes nothing, and only a station below 1 or an offer without a
/// place is refused.
///
/// Domain: all valid states of a table of two stations, all events, all times of 64 bits. Not
/// covered: larger tables.
#[cfg_attr(kani, kani::proof)]
#[cfg_attr(kani, kani::unwind(10))]
pub fn verify_requester_refuses_without_a_trace() {
    let (mut table, aside, _, _) = any_state();
    let records = table;
    let mut requester = Requester::resume(aside, &mut table);
    kani::assume(requester.is_valid());
    let before = Seen::of(&requester);
    let event = any_event(&before);
    let Err(error) = requester.step(&event) else {
        kani::cover!(true, "an event that is taken");
        return;
    };
    assert!(requester.suspend().parts() == aside.parts());
    assert!(requester.stations() == records.as_slice());
    let station = event.kind.station();
    let known = records.iter().any(|record| record.station() == station);
    match error {
        RequesterError::Station { station: named } => {
            assert!(station == Some(named) && named < 1);
        }
        RequesterError::TableFull { station: named, capacity } => {
            assert!(station == Some(named) && capacity == STATIONS && !known);
            assert!(matches!(event.kind, EventKind::Offer { .. }));
        }
        RequesterError::NegativeParameter { .. } => unreachable!("times are >= 0"),
    }
    kani::cover!(matches!(error, RequesterError::Station { .. }), "a station below 1");
    kani::cover!(matches!(error, RequesterError::TableFull { .. }), "a full table");
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

fn station() -> i64 {
    near_integer(1, 3)
}

fn session() -> i64 {
    near_integer(1, 6)
}

fn any_record() -> StationRecord {
    let last_request = [option(session), option(session)];
    StationRecord::from_parts(station(), groups(), last_request)
}

/// Any state at all; `is_valid` has to be assumed. That a group in use names a station of the
/// table and its last request is only one of the choices.
fn any_state() -> ([StationRecord; STATIONS], Suspended, Profile, Parameters) {
    let table = [any_record(), any_record()];
    let (profile, parameters) = (profile(), parameters());
    let parts = Parts {
        profile,
        parameters,
        groups: [any_group(&table, Group::Mot), any_group(&table, Group::Plan)],
        hold_until_ns: option(time_ns),
        area: groups(),
        sessions: near_integer(4, 8),
        dropped: [kani::any(), kani::any()],
    };
    (table, Suspended::from_parts(&parts), profile, parameters)
}

fn any_group(table: &[StationRecord; STATIONS], group: Group) -> GroupRecord {
    let place = if kani::any() { table[0] } else { table[1] };
    let (station, session) = if kani::any() {
        (place.station().unwrap_or(0), place.last_request(group).unwrap_or(0))
    } else {
        (station(), session())
    };
    match below(3) {
        0 => GroupRecord::Local,
        1 => GroupRecord::Requested { station, session, deadline_ns: time_ns() },
        _ => GroupRecord::Remote(Running {
            station,
            session,
            last_arrival_ns: time_ns(),
            last_used_ns: option(time_ns),
            local_computes: kani::any(),
        }),
    }
}

/// Any event; that it names what is in use is only one of the choices.
fn any_event(before: &Seen) -> Event {
    let group = group();
    let [mot, plan] = before.states;
    let state = if group == Group::Mot { mot } else { plan };
    let (station, session) = match state {
        GroupState::Requested { station, session, .. }
        | GroupState::Remote { station, session }
            if kani::any() =>
        {
            (station, session)
        }
        GroupState::Local | GroupState::Requested { .. } | GroupState::Remote { .. } => {
            (station(), session())
        }
    };
    let kind = match below(9) {
        0 => EventKind::Offer { station, groups: groups() },
        1 => EventKind::Withdraw { station },
        2 => EventKind::Lost { station },
        3 => EventKind::Area { groups: groups() },
        4 => EventKind::Tick,
        5 => EventKind::Confirm { station, group, session },
        6 => EventKind::Reject { station, group, session },
        7 => EventKind::Data { station, group, session, generated_ns: time_ns() },
        _ => EventKind::Verdict { safe: kani::any(), groups: groups() },
    };
    Event { t_ns: time_ns(), kind }
}
