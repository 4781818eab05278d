//! What the requester remembers of stations (`spec/2-offloading.md#requester`) after events that
//! change it. That the others leave it as it is, is asserted in every harness of `group` that has a table.

use mufasa::offloading::requester::{Action, EventKind, Groups, StationRecord};

use super::any::near_integer;
use super::seen::{GROUPS, REQUESTS, after, each};
use super::states::any_record;
#[cfg(not(kani))]
use crate::kani;

/// After a withdrawal or a loss the station offers nothing; when it was asked, and all that is remembered
/// of the other station, stays.
///
/// Domain: tables of two different stations, all states, valid or not, all times of 64 bits. Not covered:
/// larger tables.
#[cfg_attr(kani, kani::proof)]
#[cfg_attr(kani, kani::unwind(4))]
pub fn verify_a_withdrawal_forgets_the_offer_alone() {
    let records = two_stations();
    let (station, is_loss) = (near_integer(1, 3), kani::any());
    kani::assume(station >= 1);
    let kind = if is_loss { EventKind::Lost { station } } else { EventKind::Withdraw { station } };
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
/// in the table changes at a tick.
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
