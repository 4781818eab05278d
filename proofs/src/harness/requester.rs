//! The requester with its table (`spec/2-offloading.md`): its first state, offers, and whose turn it
//! is. What holds of one group at a time, from any state at all, is in `group`.

use mufasa::offloading::requester::{
    Event, EventKind, Group, GroupRecord, GroupState, Groups, Parameters, Parts, Requester,
    RequesterError, Sessions, StationRecord, Suspended,
};
use mufasa::report::{FailedStage, InvalidInput, Outcome, Problem, Report, Stage};

use super::any::{below, groups, near_integer, profile, time_ns};
use super::bounds::CROSS_SECTIONS;
use super::seen::{GROUPS, REQUESTS, after, after_in, answered, each, in_use, same};
use super::states::{
    any_parameters, any_record, any_record_of, any_state, any_state_with, any_station, withdrawal,
};
#[cfg(not(kani))]
use crate::kani;

/// The first state is valid: the base of the induction. All groups are in the area, nothing was
/// dropped, and the table is empty [REQ-17].
///
/// Domain: both profiles, all times >= 0, any content of the table. Not covered: larger tables.
#[cfg_attr(kani, kani::proof)]
#[cfg_attr(kani, kani::unwind(4))]
pub fn verify_requester_starts_valid() {
    let parameters = any_parameters();
    let mut table = [(); CROSS_SECTIONS].map(|()| any_record());
    let requester = Requester::new(profile(), parameters, &mut table);
    let Ok(requester) = requester else { unreachable!("times are >= 0") };
    assert!(requester.is_valid());
    assert!(requester.state(Group::Mot) == GroupState::Local);
    assert!(requester.state(Group::Plan) == GroupState::Local);
    assert!(requester.hold_until_ns().is_none() && requester.sessions() == 0);
    assert!(requester.area() == Groups::ALL);
    assert!(requester.dropped(Group::Mot) == 0 && requester.dropped(Group::Plan) == 0);
    assert!(table[0] == StationRecord::FREE && table[1] == StationRecord::FREE);
    kani::cover!(parameters.qos_hold, "a violation starts a hold");
    kani::cover!(!parameters.qos_hold, "a violation starts no hold");
}

/// A requester is refused exactly when one of its times is below 0 [DOM-01].
///
/// Domain: both profiles, all times of 64 bits, any content of the table. Not covered: which of several is named.
#[cfg_attr(kani, kani::proof)]
#[cfg_attr(kani, kani::unwind(4))]
pub fn verify_a_time_below_0_is_refused() {
    let [t_wait_ns, request_timeout_ns, l_max_ns, dt_max_ns] = [(); 4].map(|()| time_ns());
    let qos_hold = kani::any();
    let parameters = Parameters { t_wait_ns, request_timeout_ns, l_max_ns, dt_max_ns, qos_hold };
    let is_negative = t_wait_ns < 0 || request_timeout_ns < 0 || l_max_ns < 0 || dt_max_ns < 0;
    let mut table = [any_record()];
    let found = Requester::new(profile(), parameters, &mut table);
    assert!(match found {
        Ok(_) => !is_negative,
        Err(RequesterError::NegativeParameter { .. }) => is_negative,
        Err(_) => false,
    });
    kani::cover!(!is_negative, "taken");
    kani::cover!(dt_max_ns < 0 && t_wait_ns >= 0, "refused");
}

/// A hold that is begun from outside makes `hold_until` the later of its old value and the time given; nothing else
/// changes [FALL-08, MON-38, MON-39].
///
/// Domain: all states, valid or not, a table of one station, all times of 64 bits. Not covered: larger tables.
#[cfg_attr(kani, kani::proof)]
pub fn verify_a_hold_is_never_shortened() {
    let (before, until_ns, record) = (any_state(), time_ns(), any_record());
    let mut table = [record];
    let mut requester = Requester::resume(Suspended::from_parts(&before), &mut table);
    requester.hold(until_ns);
    let after = requester.suspend().parts();
    let later_ns = match before.hold_until_ns {
        Some(old_ns) if old_ns > until_ns => old_ns,
        _ => until_ns,
    };
    let expected = Parts { hold_until_ns: Some(later_ns), ..before };
    assert!(is_unchanged(&expected, &after) && table[0] == record);
    kani::cover!(before.hold_until_ns.is_some_and(|it| it < until_ns), "longer");
    kani::cover!(before.hold_until_ns.is_some_and(|it| it > until_ns), "as before");
}

/// An event that names a station below 1 is refused and changes nothing.
///
/// Domain: all states, valid or not, all times of 64 bits, confirmations and data of MOT, rejections of
/// PLAN. Not covered: the other group of each, a table.
#[cfg_attr(kani, kani::proof)]
pub fn verify_a_station_below_1_is_refused() {
    let before = any_state();
    let station = near_integer(-1, 1);
    kani::assume(station < 1);
    let (session, generated_ns) = (near_integer(1, 6), time_ns());
    let kind = match below(6) {
        0 => EventKind::Withdraw { station },
        1 => EventKind::Lost { station },
        2 => EventKind::Offer { station, groups: groups() },
        3 => EventKind::Confirm { station, group: Group::Mot, session },
        4 => EventKind::Reject { station, group: Group::Plan, session },
        _ => EventKind::Data { station, group: Group::Mot, session, generated_ns },
    };
    let (refused, after) = answered(&before, Event { t_ns: time_ns(), kind }, &mut []);
    assert!(matches!(refused, Err(RequesterError::Station { station: named }) if named == station));
    assert!(is_unchanged(&before, &after));
    kani::cover!(matches!(kind, EventKind::Withdraw { station: 0 }), "a withdrawal of the CAV");
    kani::cover!(matches!(kind, EventKind::Lost { .. }), "a loss");
    kani::cover!(matches!(kind, EventKind::Offer { .. }), "an offer");
    kani::cover!(matches!(kind, EventKind::Confirm { .. }), "a confirmation");
    kani::cover!(matches!(kind, EventKind::Reject { .. }), "a rejection");
    kani::cover!(matches!(kind, EventKind::Data { .. }), "data");
}

/// A tick keeps every law of a step: see `keeps_every_law` [REQ-03, FALL-06, FALL-07, FALL-08, FALL-09, FALL-10,
/// FALL-13, PROTO-08, H-08.2, H-08.3].
///
/// Domain: all states, valid or not, all times of 64 bits. Not covered: tables: nobody offers
/// anything.
#[cfg_attr(kani, kani::proof)]
#[cfg_attr(kani, kani::unwind(10))]
pub fn verify_every_law_at_ticks() {
    let step = after(EventKind::Tick, &mut []);
    assert!(step.keeps_every_law() && each(|at| step.lists_actions_by_kind(at)));
    kani::cover!(step.starts(0), "local services start");
    kani::cover!(step.has_hold(), "a hold");
}

/// A withdrawal and a loss keep every law of a step: see `keeps_every_law` [REQ-04, REQ-25, FALL-13, PROTO-08, H-08.2,
/// H-08.3].
///
/// Domain: all states, valid or not, a table of one place, free or the station's, all times of 64 bits.
/// Not covered: larger tables.
#[cfg_attr(kani, kani::proof)]
#[cfg_attr(kani, kani::unwind(10))]
pub fn verify_every_law_at_withdrawals() {
    let is_loss = kani::any();
    let (kind, station) = withdrawal(is_loss);
    let place = any_record_of(station);
    let step = after(kind, &mut [place]);
    assert!(step.keeps_every_law() && each(|at| step.lists_actions_by_kind(at)));
    let is_known = place.station().is_some();
    kani::cover!(is_loss && is_known && step.starts(0), "a loss");
    kani::cover!(!is_loss && is_known && step.starts(1), "a withdrawal");
}

/// An offer keeps every law of a step: see `keeps_every_law` [REQ-02, REQ-04, PROTO-08, H-08.2, H-08.3].
///
/// Domain: all states, valid or not, a table of one place, free or the station's, all times of 64 bits.
/// Not covered: larger tables.
#[cfg_attr(kani, kani::proof)]
#[cfg_attr(kani, kani::unwind(10))]
pub fn verify_every_law_at_offers() {
    let (station, groups) = (any_station(), groups());
    let place = any_record_of(station);
    let step = after(EventKind::Offer { station, groups }, &mut [place]);
    assert!(step.keeps_every_law());
    kani::cover!(step.starts(0) && place.station().is_some(), "local services start");
}

/// An offer leaves exactly what is in use of its station and no longer offered, with one release for each [REQ-02].
///
/// Domain: all states, valid or not, a table of one place, free or the station's, all times of 64 bits.
/// Not covered: larger tables.
#[cfg_attr(kani, kani::proof)]
#[cfg_attr(kani, kani::unwind(10))]
pub fn verify_a_session_left_is_released_at_offers() {
    let (station, groups) = (any_station(), groups());
    let place = any_record_of(station);
    let step = after(EventKind::Offer { station, groups }, &mut [place]);
    let lacks = [!groups.mot, !groups.plan];
    let uses = |at: usize| in_use(step.before.groups[at]).is_some_and(|(used, _)| used == station);
    assert!(each(|at| step.leaves(at) == (lacks[at] && uses(at))));
    assert!(each(|at| step.releases_what_it_leaves(at)));
    let is_known = place.station().is_some();
    kani::cover!(is_known && step.leaves(0) && !step.leaves(1), "a group is left");
    kani::cover!(is_known && uses(0) && !step.leaves(0), "a group stays");
}

fn is_unchanged(before: &Parts, after: &Parts) -> bool {
    each(|at| same(after.groups[at], before.groups[at]) && after.dropped[at] == before.dropped[at])
        && after.hold_until_ns == before.hold_until_ns
        && after.sessions == before.sessions
        && after.area == before.area
        && after.profile == before.profile
        && after.parameters == before.parameters
}

/// A cycle is told as safe exactly when it ended in a report without a failed stage; an error is unsafe [FALL-11].
///
/// Domain: a failed stage or none, an error. Not covered: nothing: no other part of a report is read.
#[cfg_attr(kani, kani::proof)]
pub fn verify_an_error_is_told_as_unsafe() {
    let failed_stage = match below(3) {
        0 => None,
        1 => Some(FailedStage::NoObstacleCheck),
        _ => Some(FailedStage::Stage(Stage::I)),
    };
    let report = Report { failed_stage, stages: [Outcome::NotScheduled; 5], input: None };
    let problem = InvalidInput { field: "now_ns", index: None, problem: Problem::NotFinite };
    let is_error: bool = kani::any();
    let answer = if is_error { Err(problem) } else { Ok(report) };
    let found = EventKind::of_cycle(&answer, Sessions::NONE);
    let expected = !is_error && failed_stage.is_none();
    assert!(matches!(found, EventKind::Verdict { safe, .. } if safe == expected));
    kani::cover!(expected, "safe");
    kani::cover!(is_error && failed_stage.is_none(), "an error");
    kani::cover!(!is_error && failed_stage.is_some(), "a failed stage");
}

/// An offer replaces what its station offered and nothing else; a new station takes the first free
/// place and was never asked. It is refused exactly when its station is in no place, no place is free,
/// and it is not empty, and then nothing changes [REQ-01, REQ-26].
///
/// Domain: tables of two stations, all states, valid or not, all times of 64 bits. Not covered: larger tables; what
/// becomes of groups in use, for which see `verify_every_law_at_offers`.
#[cfg_attr(kani, kani::proof)]
#[cfg_attr(kani, kani::unwind(4))]
pub fn verify_an_offer_is_taken_or_leaves_no_trace() {
    let records = [any_record(), any_record()];
    let [a, b] = records;
    let mut table = records;
    let (before, station, groups) = (any_state(), any_station(), groups());
    let known = [a.station() == Some(station), b.station() == Some(station)];
    let full = a.station().is_some() && b.station().is_some() && !known[0] && !known[1];
    let event = Event { t_ns: time_ns(), kind: EventKind::Offer { station, groups } };
    let (found, after) = answered(&before, event, &mut table);
    let refused = full && groups != Groups::NONE;
    assert!(match found {
        Ok(_) => !refused,
        Err(RequesterError::TableFull { station: named, capacity }) => {
            refused && named == station && capacity == 2 && is_unchanged(&before, &after)
        }
        Err(RequesterError::Station { .. } | RequesterError::NegativeParameter { .. }) => false,
    });
    let with_offer = |record: StationRecord| {
        let last_request = GROUPS.map(|group| record.last_request(group));
        StationRecord::from_parts(station, groups, last_request)
    };
    let new = StationRecord::from_parts(station, groups, [None, None]);
    let expected = if known[0] {
        [with_offer(a), b]
    } else if known[1] {
        [a, with_offer(b)]
    } else if refused || groups == Groups::NONE {
        [a, b]
    } else if a.station().is_none() {
        [new, b]
    } else {
        [a, new]
    };
    assert!(table[0] == expected[0] && table[1] == expected[1]);
    let uses = in_use(before.groups[0]).is_some_and(|(used, _)| used == station);
    kani::cover!(refused && uses, "a full table");
    kani::cover!(!refused && !known[0] && !known[1] && groups.mot, "a new station");
    kani::cover!(known[1] && !known[0] && uses, "a known station");
}

/// Among two stations that offer a group the one is asked whose last request for it is older, never
/// being the oldest; the smaller id of two never asked. After the last session nobody is [REQ-06, REQ-07, REQ-08,
/// MON-61].
///
/// Domain: tables of two different stations that both offer the group, each of the two groups, no hold or
/// one that is over, both local and in the area, all sessions. Not covered: larger tables.
#[cfg_attr(kani, kani::proof)]
#[cfg_attr(kani, kani::unwind(4))]
pub fn verify_the_station_asked_last_waits() {
    // The group is a constant in each of the two branches.
    if kani::any() { the_station_asked_last_waits(0) } else { the_station_asked_last_waits(1) }
}

fn the_station_asked_last_waits(at: usize) {
    let group = GROUPS[at];
    let records = [any_record(), any_record()];
    let [a, b] = records;
    kani::assume(a.offer().contains(group) && b.offer().contains(group));
    let mut table = records;
    let (Some(one), Some(other)) = (a.station(), b.station()) else { return };
    let asked = [a, b].map(|record| record.last_request(group).unwrap_or(0));
    kani::assume(asked[0] >= 0 && asked[1] >= 0);
    kani::assume(one != other && (asked[0] != asked[1] || asked[0] == 0));
    let local = any_state_with([GroupRecord::Local; 2]);
    let state = Parts { area: Groups::ALL, ..local };
    let event = Event { t_ns: time_ns(), kind: EventKind::Tick };
    kani::assume(state.hold_until_ns.is_none_or(|until_ns| until_ns <= event.t_ns));
    let step = after_in(state, event, &mut table);
    let first = asked[0] < asked[1] || (asked[0] == asked[1] && one < other);
    let expected = if first { one } else { other };
    let found = in_use(step.after.groups[at]);
    // The request for MOT has the number before.
    let number = if at == 1 && step.done[REQUESTS][0].is_some() { 2 } else { 1 };
    match step.before.sessions.checked_add(number) {
        None => assert!(found.is_none() && step.done[REQUESTS][at].is_none()),
        Some(session) => {
            assert!(found == Some((expected, session)));
            let asked = if first { table[0] } else { table[1] };
            assert!(asked.last_request(group) == Some(session) || session == 0);
        }
    }
    kani::cover!(at == 0 && asked[0] == asked[1] && found.is_some(), "never asked for MOT");
    kani::cover!(at == 1 && asked[0] == asked[1] && found.is_some(), "never asked for PLAN");
    kani::cover!(at == 0 && asked[0] > asked[1] && found.is_some(), "asked for MOT longer ago");
    kani::cover!(at == 1 && asked[0] > asked[1] && found.is_some(), "asked for PLAN longer ago");
    kani::cover!(at == 0 && found.is_none(), "after the last session");
    kani::cover!(at == 1 && number == 2 && found.is_none(), "MOT has the last session");
}
