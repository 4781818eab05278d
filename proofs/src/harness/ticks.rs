//! Ticks at which stations offer groups (`spec/2-offloading.md#requester`), law by law, from any state
//! at all.

use mufasa::offloading::requester::{Action, EventKind, GroupRecord, Groups, StationRecord};

use super::seen::{GROUPS, RELEASES, REQUESTS, Seen, after, each, in_use, same};
use super::states::any_record;
#[cfg(not(kani))]
use crate::kani;

/// At a tick before `hold_until`, as it is after the tick, nothing is asked for, whoever offers, and no
/// session is numbered: a hold that begins with a violation of this tick bars its requests. The hold
/// changes by a violation with `qos_hold` alone [REQ-03, FALL-05, FALL-06, FALL-07, FALL-08, FALL-09, FALL-12].
///
/// Domain: all states, valid or not, of a table of two stations, all times of 64 bits. Not
/// covered: larger tables.
#[cfg_attr(kani, kani::proof)]
#[cfg_attr(kani, kani::unwind(4))]
pub fn verify_t_wait_bars_requests() {
    let mut table = [any_record(), any_record()];
    let step = after(EventKind::Tick, &mut table);
    let asks = step.done[REQUESTS][0].is_some() || step.done[REQUESTS][1].is_some();
    let held = is_held(&step);
    assert!(!held || (!asks && step.after.sessions == step.before.sessions));
    assert!(step.keeps_the_hold());
    kani::cover!(held && step.done[RELEASES][0].is_some(), "a group is left during a hold");
    kani::cover!(held && step.before.hold_until_ns.is_none(), "a hold of this tick");
    kani::cover!(asks && step.before.hold_until_ns == Some(step.event.t_ns), "the end of a hold");
    kani::cover!(asks && step.before.hold_until_ns.is_none(), "no hold");
}

fn is_held(step: &Seen) -> bool {
    step.after.hold_until_ns.is_some_and(|until_ns| step.event.t_ns < until_ns)
}

/// Who is asked offers the group, which was local and is in the area; the session is the next
/// number, MOT's before PLAN's; the deadline is now + `request_timeout`. A group is asked for whenever it
/// was local and is in the area, a station offers it, nothing is held and a number is left; one that is
/// not asked for is not in use anew [REQ-03, REQ-04, REQ-05, REQ-06, FALL-05, FALL-09, FALL-13, H-08.3, MON-61].
///
/// Domain: all states, valid or not, of a table of two stations, all times of 64 bits, both groups.
/// Not covered: larger tables.
#[cfg_attr(kani, kani::proof)]
#[cfg_attr(kani, kani::unwind(4))]
pub fn verify_a_request_goes_to_who_offers() {
    let records = [any_record(), any_record()];
    let mut table = records;
    let step = after(EventKind::Tick, &mut table);
    assert!(each(|at| step.lists_actions_by_kind(at)
        && step.says_what_services_do(at)
        && asks_who_offers(&step, at, &records)));
    let asks = [step.done[REQUESTS][0].is_some(), step.done[REQUESTS][1].is_some()];
    let number = i64::from(asks[0]) + i64::from(asks[1]);
    assert!(step.before.sessions.checked_add(number) == Some(step.after.sessions));
    kani::cover!(asks[0] && !asks[1], "MOT asked");
    kani::cover!(!asks[0] && asks[1], "PLAN asked");
    kani::cover!(asks[0] && asks[1], "both asked");
    kani::cover!(!asks[0] && !asks[1], "not asked");
}

#[allow(
    clippy::inline_always,
    reason = "a call copies the step to memory, which CBMC has to follow"
)]
#[inline(always)]
fn asks_who_offers(step: &Seen, at: usize, [one, other]: &[StationRecord; 2]) -> bool {
    let (before, after) = (step.before.groups[at], step.after.groups[at]);
    let of = |groups: Groups| if at == 0 { groups.mot } else { groups.plan };
    let first = if at == 1 && step.done[REQUESTS][0].is_some() { 2 } else { 1 };
    let next = step.before.sessions.checked_add(first);
    let may = in_use(before).is_none() && of(step.before.area) && !is_held(step);
    let is_offered = of(one.offer()) || of(other.offer());
    let (station, session) = match step.done[REQUESTS][at] {
        Some(Action::Request { station, group, session }) if group == GROUPS[at] => {
            (station, session)
        }
        Some(_) => return false,
        None => {
            let is_as_before = in_use(after).is_none() || in_use(after) == in_use(before);
            return is_as_before && !(may && is_offered && next.is_some());
        }
    };
    let offers = |record: &StationRecord| record.station() == Some(station) && of(record.offer());
    let deadline_ns = step.event.t_ns.saturating_add(step.before.parameters.request_timeout_ns);
    may && next == Some(session)
        && same(after, GroupRecord::Requested { station, session, deadline_ns })
        && (offers(one) || offers(other))
}

/// A tick at which stations offer groups leaves exactly the groups that are overdue or silent, with one
/// release of the session; what stays is as it was; area, times and counts stay [REQ-14, QOS-04, QOS-06, FALL-10].
///
/// Domain: all states, valid or not, of a table of two stations, all times of 64 bits, each of the two
/// groups. Not covered: larger tables.
#[cfg_attr(kani, kani::proof)]
#[cfg_attr(kani, kani::unwind(4))]
pub fn verify_what_is_not_due_stays_at_ticks() {
    // The group is a constant in each of the two branches.
    if kani::any() { what_is_not_due_stays(0) } else { what_is_not_due_stays(1) }
}

fn what_is_not_due_stays(at: usize) {
    let mut table = [any_record(), any_record()];
    let step = after(EventKind::Tick, &mut table);
    let asks = step.done[REQUESTS][at].is_some();
    assert!(step.leaves(at) == step.is_due(at) && step.releases_what_it_leaves(at));
    assert!(asks || step.keeps_what_stays(at));
    assert!(step.keeps_the_rest() && step.drops_nothing());
    let other_asks = step.done[REQUESTS][1 - at].is_some();
    kani::cover!(at == 0 && other_asks && in_use(step.after.groups[0]).is_some(), "MOT stays");
    kani::cover!(at == 1 && other_asks && step.leaves(1), "PLAN is left");
}
