//! The requester (`spec/2-offloading.md`) by induction: from every valid state every event keeps
//! all laws and leads to a valid state, so they hold after any number of events.

use mufasa::input::profile::Profile;
use mufasa::offloading::requester::{
    Action, Event, EventKind, GroupRecord, GroupState, Parameters, Parts, Requester,
    RequesterError, Running, Sessions, StationRecord, Suspended,
};
use mufasa::services::configuration::{Group, Source};

use super::any::{
    below, duration_ns, group, groups, index, near_integer, option, profile, time_ns,
};
use super::bounds::CROSS_SECTIONS;
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
    let mut table = [(); CROSS_SECTIONS].map(|()| any_record());
    let requester = Requester::new(profile(), parameters, &mut table);
    let Ok(requester) = requester else { unreachable!("times are >= 0") };
    assert!(requester.is_valid());
    assert!(Seen::of(&requester).states == [GroupState::Local; 2]);
    assert!(requester.hold_until_ns().is_none() && requester.sessions() == 0);
    kani::cover!(parameters.qos_hold, "a violation starts a hold");
    kani::cover!(!parameters.qos_hold, "a violation starts no hold");
}

/// From every valid state an offer, a withdrawal and a loss keep every law of `law::requester` and
/// lead to a valid state.
///
/// Domain: all valid states of a table of two stations, all times of 64 bits. Not covered: larger
/// tables.
pub fn verify_requester_keeps_every_law_at_offers() {
    after_any_event(About::Offers, |step| {
        let left = step.after.states != step.before.states;
        let is_loss = matches!(step.event.kind, EventKind::Lost { .. });
        kani::cover!(left && !is_loss, "a group in use is left with a release");
        kani::cover!(left && is_loss, "a group in use is left without a release");
        kani::cover!(!left, "nothing is left");
    });
}

/// From every valid state a change of the area keeps every law of `law::requester` and leads to a
/// valid state.
///
/// Domain: all valid states of a table of two stations, all times of 64 bits. Not covered: larger
/// tables.
pub fn verify_requester_keeps_every_law_at_areas() {
    after_any_event(About::Area, |step| {
        let left = step.after.states != step.before.states;
        kani::cover!(left && step.after.states == [GroupState::Local; 2], "a group in use is left");
        kani::cover!(!left, "nothing is left");
    });
}

/// From every valid state a tick keeps every law of `law::requester` and leads to a valid state: no
/// request before `hold_until`, whatever time does.
///
/// Domain: all valid states of a table of two stations, all times of 64 bits. Not covered: larger
/// tables.
pub fn verify_requester_keeps_every_law_at_ticks() {
    after_any_event(About::Tick, |step| {
        let was_local = step.before.states == [GroupState::Local; 2];
        let is_local = step.after.states == [GroupState::Local; 2];
        let held_ns = step.before.hold_until_ns;
        kani::cover!(was_local && !is_local, "a request");
        kani::cover!(held_ns == Some(step.event.t_ns) && was_local && !is_local, "a hold ends");
        kani::cover!(!was_local && is_local, "what is overdue or silent ends");
        kani::cover!(step.after.hold_until_ns != held_ns, "silence starts a hold");
    });
}

/// From every valid state a confirmation and a rejection keep every law of `law::requester` and lead
/// to a valid state.
///
/// Domain: all valid states of a table of two stations, all times of 64 bits. Not covered: larger
/// tables.
pub fn verify_requester_keeps_every_law_at_answers() {
    after_any_event(About::Answer, |step| {
        let is_confirmation = matches!(step.event.kind, EventKind::Confirm { .. });
        let changed = step.after.states != step.before.states;
        kani::cover!(is_confirmation && changed, "a confirmation");
        kani::cover!(!is_confirmation && changed, "a rejection");
        kani::cover!(is_confirmation && !step.actions.is_empty() && !changed, "another session");
        kani::cover!(step.after.sources != step.before.sources, "break before make");
    });
}

/// From every valid state data keep every law of `law::requester` and lead to a valid state.
///
/// Domain: all valid states of a table of two stations, all times of 64 bits. Not covered: larger
/// tables.
pub fn verify_requester_keeps_every_law_at_data() {
    after_any_event(About::Data, |step| {
        let left = step.after.states != step.before.states;
        kani::cover!(left, "a violation of quality of service");
        kani::cover!(!left && step.actions.is_empty(), "an element that is used");
        kani::cover!(!left && !step.actions.is_empty(), "an element that is dropped");
        kani::cover!(step.after.hold_until_ns != step.before.hold_until_ns, "a violation holds");
    });
}

/// From every valid state a verdict keeps every law of `law::requester` and leads to a valid state:
/// a safety issue makes every group local and holds, and no hold is ever shortened.
///
/// Domain: all valid states of a table of two stations, all times of 64 bits. Not covered: larger
/// tables.
pub fn verify_requester_keeps_every_law_at_verdicts() {
    after_any_event(About::Verdict, |step| {
        let is_unsafe = matches!(step.event.kind, EventKind::Verdict { safe: false, .. });
        let left = step.after.states != step.before.states;
        kani::cover!(is_unsafe && left, "a fallback");
        kani::cover!(is_unsafe && step.after.hold_until_ns == Some(i64::MAX), "a hold saturates");
        kani::cover!(
            is_unsafe && step.after.hold_until_ns == step.before.hold_until_ns,
            "a later hold stays"
        );
        kani::cover!(!is_unsafe && !step.actions.is_empty(), "local services stop");
    });
}

/// Kinds of events.
#[derive(Clone, Copy, PartialEq, Eq)]
enum About {
    Offers,
    Area,
    Tick,
    Answer,
    Data,
    Verdict,
}

/// Asserts all laws of any event of these kinds in any valid state.
fn after_any_event(about: About, see: impl FnOnce(&Step<'_>)) {
    let (mut table, aside, profile, parameters) = any_state();
    let mut requester = Requester::resume(aside, &mut table);
    kani::assume(requester.is_valid());
    let before = Seen::of(&requester);
    let event = any_event(&before, about);
    let Ok(actions) = requester.step(&event) else { return };
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
    see(&step);
}

/// A safety issue makes every group local, its source too, releases what was in use, and holds until
/// now + t_wait or longer: from any state at all, even one that no events lead to.
///
/// Domain: all states, valid or not, all times of 64 bits. Not covered: nothing; the table is not
/// looked at.
#[cfg_attr(kani, kani::proof)]
#[cfg_attr(kani, kani::unwind(10))]
pub fn verify_a_safety_issue_ends_every_remote_service() {
    let (mut table, aside, _, parameters) = any_state();
    let mut requester = Requester::resume(aside, &mut table);
    let before = Group::ALL.map(|group| requester.state(group));
    let (t_ns, held_ns) = (time_ns(), requester.hold_until_ns());
    let kind = EventKind::Verdict {
        safe: false,
        sessions: Sessions { mot: option(session), plan: option(session) },
    };
    let Ok(actions) = requester.step(&Event { t_ns, kind }) else {
        unreachable!("a verdict names no station")
    };
    for (group, before) in Group::ALL.into_iter().zip(before) {
        assert!(requester.state(group) == GroupState::Local);
        assert!(requester.source(group) == Source::Local);
        let released = actions.iter().any(
            |action| matches!(action, Action::Release { group: released, .. } if *released == group),
        );
        assert!(released == (before != GroupState::Local));
    }
    let end_ns = t_ns.saturating_add(parameters.t_wait_ns);
    let Some(until_ns) = requester.hold_until_ns() else { unreachable!("there is a hold") };
    assert!(until_ns == end_ns.max(held_ns.unwrap_or(end_ns)));
    kani::cover!(before[0] != GroupState::Local && before[1] != GroupState::Local, "both leave");
    kani::cover!(before == [GroupState::Local; 2], "both are local already");
    kani::cover!(until_ns > end_ns, "a later hold stays");
    kani::cover!(until_ns == i64::MAX && t_ns < i64::MAX, "a hold saturates");
}

/// At a tick before `hold_until` nothing is asked for, and the hold does not end sooner: from any
/// state at all.
///
/// Domain: all states, valid or not, of a table of two stations, all times of 64 bits. Not covered:
/// larger tables.
pub fn verify_t_wait_blocks_offloading() {
    let (mut table, aside, _, _) = any_state();
    let mut requester = Requester::resume(aside, &mut table);
    let (t_ns, held_ns) = (time_ns(), requester.hold_until_ns());
    let sessions = requester.sessions();
    let Ok(actions) = requester.step(&Event { t_ns, kind: EventKind::Tick }) else {
        unreachable!("a tick names no station")
    };
    // Requests come last.
    let asks = matches!(actions.last(), Some(Action::Request { .. }));
    let held = held_ns.is_some_and(|until_ns| t_ns < until_ns);
    assert!(!held || (!asks && requester.sessions() == sessions));
    assert!(requester.hold_until_ns() >= held_ns);
    kani::cover!(held && !actions.is_empty(), "a group is left during a hold");
    kani::cover!(asks && held_ns == Some(t_ns), "a request at the end of a hold");
    kani::cover!(asks && held_ns.is_none(), "a request without a hold");
}

/// An event that is refused changes nothing, and only a station below 1 or an offer without a
/// place is refused.
///
/// Domain: all valid states of a table of two stations, all events but verdicts, all times of 64
/// bits. Not covered: larger tables.
pub fn verify_requester_refuses_without_a_trace() {
    let (mut table, aside, _, _) = any_state();
    let records = table;
    let mut requester = Requester::resume(aside, &mut table);
    kani::assume(requester.is_valid());
    let before = Seen::of(&requester);
    let about = [About::Offers, About::Area, About::Tick, About::Answer, About::Data];
    let event = any_event(&before, about[index(about.len())]);
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
            assert!(station == Some(named) && capacity == CROSS_SECTIONS && !known);
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
fn any_state() -> ([StationRecord; CROSS_SECTIONS], Suspended, Profile, Parameters) {
    let table = [(); CROSS_SECTIONS].map(|()| any_record());
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

/// Everything is drawn first and chosen from then; see `any::option`.
fn any_group(table: &[StationRecord; CROSS_SECTIONS], group: Group) -> GroupRecord {
    let ids = |place: &StationRecord| {
        (place.station().unwrap_or(0), place.last_request(group).unwrap_or(0))
    };
    let (first, last, free) =
        (ids(&table[0]), ids(&table[CROSS_SECTIONS - 1]), (station(), session()));
    let (kind, place, deadline_ns) = (below(3), below(4), time_ns());
    let (last_arrival_ns, last_used_ns) = (time_ns(), option(time_ns));
    let local_computes = kani::any();
    let (station, session) = match place {
        0 => free,
        1 => first,
        _ => last,
    };
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

/// Any event of these kinds; that it names what is in use is only one of the choices.
fn any_event(before: &Seen, about: About) -> Event {
    let (group, t_ns, generated_ns) = (group(), time_ns(), time_ns());
    let (free, groups) = ((station(), session()), groups());
    let (kind, named): (u8, bool) = (below(3), kani::any());
    let [mot, plan] = before.states;
    let state = if group == Group::Mot { mot } else { plan };
    let (station, session) = match state {
        GroupState::Requested { station, session, .. }
        | GroupState::Remote { station, session }
            if named =>
        {
            (station, session)
        }
        GroupState::Local | GroupState::Requested { .. } | GroupState::Remote { .. } => free,
    };
    let kind = match about {
        About::Offers => match kind {
            0 => EventKind::Offer { station, groups },
            1 => EventKind::Withdraw { station },
            _ => EventKind::Lost { station },
        },
        About::Area => EventKind::Area { groups },
        About::Tick => EventKind::Tick,
        About::Answer if kind == 0 => EventKind::Confirm { station, group, session },
        About::Answer => EventKind::Reject { station, group, session },
        About::Data => EventKind::Data { station, group, session, generated_ns },
        About::Verdict => EventKind::Verdict {
            safe: kind == 0,
            sessions: Sessions {
                mot: groups.mot.then_some(session),
                plan: groups.plan.then_some(free.1),
            },
        },
    };
    Event { t_ns, kind }
}
