//! What the requester remembers of stations (`spec/2-offloading.md#requester`) after events that
//! change it. That the others leave it as it is, is asserted in `group`: `verify_every_law_at_areas` and
//! `_at_verdicts`, and the three harnesses `verify_the_other_group_is_untouched`.

use mufasa::offloading::requester::{Action, Event, EventKind, GroupRecord, Groups, StationRecord};

use super::any::{below, groups, time_ns};
use super::seen::{GROUPS, REQUESTS, after, answered, each, in_use};
use super::states::{any_record, any_state, any_station, withdrawal};
#[cfg(not(kani))]
use crate::kani;

/// After a withdrawal or a loss the station offers nothing; when it was asked, and all that is remembered
/// of the other station, stays [REQ-09, REQ-22, REQ-24].
///
/// Domain: tables of two different stations, all states, valid or not, all times of 64 bits. Not covered:
/// larger tables.
#[cfg_attr(kani, kani::proof)]
#[cfg_attr(kani, kani::unwind(4))]
pub fn verify_a_withdrawal_forgets_the_offer_alone() {
    let records = two_stations();
    let is_loss = kani::any();
    let (kind, station) = withdrawal(is_loss);
    let mut table = records;
    after(kind, &mut table);
    let expected = |record: StationRecord| {
        if record.station() == Some(station) {
            holds(record, Groups::NONE, [None; 2])
        } else {
            record
        }
    };
    assert!(table[0] == expected(records[0]) && table[1] == expected(records[1]));
    let withdraws = |at: usize| table[at].offer() != records[at].offer();
    kani::cover!(is_loss && withdraws(0), "a loss");
    kani::cover!(!is_loss && withdraws(1), "a withdrawal");
    kani::cover!(table[0].last_request(GROUPS[0]).is_some() && withdraws(0), "it was asked");
}

/// The session of a request is remembered of the station asked, for the group asked for; nothing else
/// in the table changes at a tick [REQ-07, REQ-08].
///
/// Domain: tables of two different stations, all states, valid or not, all times of 64 bits. Not covered:
/// larger tables; sessions numbered 0, which stands for none.
#[cfg_attr(kani, kani::proof)]
#[cfg_attr(kani, kani::unwind(4))]
pub fn verify_a_request_is_remembered() {
    let records = two_stations();
    let mut table = records;
    let step = after(EventKind::Tick, &mut table);
    kani::assume(step.before.sessions >= 0);
    let expected = |record: StationRecord| {
        let asked = [0, 1].map(|at| match step.done[REQUESTS][at] {
            Some(Action::Request { station, session, .. }) if record.station() == Some(station) => {
                Some(session)
            }
            _ => None,
        });
        holds(record, record.offer(), asked)
    };
    assert!(table[0] == expected(records[0]) && table[1] == expected(records[1]));
    kani::cover!(each(|at| step.done[REQUESTS][at].is_some()), "both asked for");
    kani::cover!(!each(|at| step.done[REQUESTS][at].is_none()), "asked");
}

/// A valid table stays valid at a tick: no station and no session is in two places, and every session is
/// one of those so far. `proofs/HARNESSES.md` says what else makes the induction that every reachable state
/// is valid.
///
/// Domain: valid tables of two places, all states, valid or not, with sessions from 0, all times of 64 bits.
/// Not covered: larger tables.
#[cfg_attr(kani, kani::proof)]
#[cfg_attr(kani, kani::unwind(4))]
pub fn verify_the_table_stays_valid_at_ticks() {
    let records = [any_record(), any_record()];
    let mut table = records;
    let step = after(EventKind::Tick, &mut table);
    kani::assume(step.before.sessions >= 0 && is_valid(records, step.before.sessions));
    assert!(is_valid(table, step.after.sessions));
    kani::cover!(each(|at| step.done[REQUESTS][at].is_some()), "both asked for");
}

/// What is in use after a tick is offered by its station, which was asked for it last in this session [REQ-03].
///
/// Domain: valid tables of two places, all states in which this holds of the group, each of the two groups,
/// all times of 64 bits. Not covered: larger tables.
#[cfg_attr(kani, kani::proof)]
#[cfg_attr(kani, kani::unwind(4))]
pub fn verify_what_is_in_use_stays_offered_at_ticks() {
    // The group is a constant in each of the two branches.
    if kani::any() { stays_offered_at_ticks(0) } else { stays_offered_at_ticks(1) }
}

fn stays_offered_at_ticks(at: usize) {
    let records = [any_record(), any_record()];
    let mut table = records;
    let step = after(EventKind::Tick, &mut table);
    kani::assume(step.before.sessions >= 0 && is_valid(records, step.before.sessions));
    kani::assume(is_offered_and_asked(step.before.groups[at], at, records));
    assert!(is_offered_and_asked(step.after.groups[at], at, table));
    let stays = in_use(step.after.groups[at]).is_some() && step.done[REQUESTS][at].is_none();
    kani::cover!(at == 0 && stays, "MOT stays in use");
    kani::cover!(at == 1 && step.done[REQUESTS][at].is_some(), "PLAN is asked for");
}

/// After an offer, a withdrawal or a loss the table is valid, and what is in use is offered
/// by its station, which was asked for it last in this session [REQ-02, REQ-23, REQ-24].
///
/// Domain: valid tables of two places, all states in which what is in use is offered and asked for, all
/// times of 64 bits. Not covered: larger tables; offers that are refused, for which see `requester`.
#[cfg_attr(kani, kani::proof)]
#[cfg_attr(kani, kani::unwind(4))]
pub fn verify_the_table_stays_valid_at_offers() {
    let station = any_station();
    let kind = match below(3) {
        0 => EventKind::Lost { station },
        1 => EventKind::Withdraw { station },
        _ => EventKind::Offer { station, groups: groups() },
    };
    let before = any_state();
    let records = [any_record(), any_record()];
    kani::assume(before.sessions >= 0 && is_valid(records, before.sessions));
    kani::assume(each(|at| is_offered_and_asked(before.groups[at], at, records)));
    let mut table = records;
    let event = Event { t_ns: time_ns(), kind };
    let (Ok(_), after) = answered(&before, event, &mut table) else { return };
    assert!(is_valid(table, after.sessions));
    assert!(each(|at| is_offered_and_asked(after.groups[at], at, table)));
    kani::cover!(in_use(after.groups[0]).is_some(), "MOT stays in use");
    let is_left = in_use(before.groups[0]).is_some() && in_use(after.groups[0]).is_none();
    kani::cover!(is_left, "MOT is left");
    kani::cover!(table[1] != records[1], "the table changes");
}

/// Stations from 1, each in one place; sessions from 1 and no more than there were, each in one place.
fn is_valid([a, b]: [StationRecord; 2], sessions: i64) -> bool {
    let is_numbered = |session: Option<i64>| session.is_none_or(|it| 1 <= it && it <= sessions);
    let place_is_valid = |record: StationRecord| {
        let [mot, plan] = GROUPS.map(|group| record.last_request(group));
        is_numbered(mot)
            && is_numbered(plan)
            && record.station().is_none_or(|station| station >= 1)
            && (mot.is_none() || mot != plan)
    };
    let differ = |one: Option<i64>, other: Option<i64>| one.is_none() || one != other;
    let [of_a, of_b] = [a, b].map(|record| GROUPS.map(|group| record.last_request(group)));
    place_is_valid(a)
        && place_is_valid(b)
        && differ(a.station(), b.station())
        && each(|at| differ(of_a[at], of_b[0]) && differ(of_a[at], of_b[1]))
}

/// The station in use offers the group, and this session was its last request for it.
fn is_offered_and_asked(group: GroupRecord, at: usize, table: [StationRecord; 2]) -> bool {
    let Some((station, session)) = in_use(group) else { return true };
    let is_it = |record: StationRecord| {
        record.station() == Some(station)
            && record.offer().contains(GROUPS[at])
            && record.last_request(GROUPS[at]) == Some(session)
    };
    is_it(table[0]) || is_it(table[1])
}

/// What is remembered, with another offer and these sessions where there are any.
fn holds(record: StationRecord, offer: Groups, asked: [Option<i64>; 2]) -> StationRecord {
    let last_request = [0, 1].map(|at| asked[at].or(record.last_request(GROUPS[at])));
    StationRecord::from_parts(record.station().unwrap_or(0), offer, last_request)
}

/// Neither place is free.
fn two_stations() -> [StationRecord; 2] {
    let records = [any_record(), any_record()];
    let [a, b] = records;
    kani::assume(a.station().is_some() && b.station().is_some() && a.station() != b.station());
    records
}
