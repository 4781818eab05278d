//! The monitor around the requester, event by event (`spec/monitor.md#monitor`): which session it counts the use of,
//! and when a station may be asked again. That every state is valid is an induction: a new monitor is valid, and each
//! event keeps that.
//!
//! Domain: all valid states of the monitor, of the requester all, valid or not, all times of 64 bits, a period from
//! 1 ns; the table of stations is empty. Not covered: offers of stations (`ticks`, `table`), the time since the last tick.

use mufasa::offloading::requester::{
    Event, EventKind, GroupRecord, Parts, Requester, StationRecord, Suspended,
};
use mufasa::parts::monitor::{Released, Served, step};

use super::any::{groups, integer_within, near_integer, option, time_ns};
use super::monitor_released::cycle_of;
use super::seen::{GROUPS, REQUESTS, any_verdict, each};
use super::states::{any_parameters, any_record, any_state, any_station, withdrawal};
#[cfg(not(kani))]
use crate::kani;

/// A new monitor is valid: nothing runs, and of nothing the use is counted. The base of the induction.
///
/// Domain: both profiles, all times of 64 bits. Not covered: nothing of it.
#[cfg_attr(kani, kani::proof)]
pub fn verify_a_new_monitor_is_valid() {
    let fresh = Requester::new(super::any::profile(), any_parameters(), &mut []);
    let is_valid = fresh.is_ok_and(|it| is_valid(&it.suspend().parts(), [Served::default(); 2]));
    assert!(is_valid);
    kani::cover!(is_valid, "valid");
}

/// A change of the area keeps the monitor valid, and after a session nobody is asked for as long as it waits
/// [MON-34, MON-38].
#[cfg_attr(kani, kani::proof)]
pub fn verify_the_monitor_stays_valid_at_areas() {
    let step = Step::of(EventKind::Area { groups: groups() });
    step.keeps_the_monitor();
    kani::cover!(step.ends(0), "MOT is left");
    kani::cover!(step.ends(1) && !step.ends(0), "PLAN alone is left");
}

/// A verdict keeps the monitor valid, and after a session nobody is asked for as long as it waits [MON-34, MON-38].
#[cfg_attr(kani, kani::proof)]
pub fn verify_the_monitor_stays_valid_at_verdicts() {
    let step = Step::of(any_verdict());
    step.keeps_the_monitor();
    kani::cover!(step.ends(0) && step.ends(1), "an unsafe cycle");
    kani::cover!(!step.ends(0) && step.served[0].session.is_some(), "it goes on");
}

/// A confirmation keeps the monitor valid: a session that begins is counted from now, as one of which nothing was of
/// use [MON-31, MON-35].
#[cfg_attr(kani, kani::proof)]
pub fn verify_the_monitor_stays_valid_at_confirmations() {
    let (station, session) = (any_station(), near_integer(1, 6));
    let group = GROUPS[usize::from(kani::any::<bool>())];
    let step = Step::of(EventKind::Confirm { station, group, session });
    step.keeps_the_monitor();
    let begins = |at: usize| {
        step.served[at].session != step.before_served[at].session
            && step.served[at].session.is_some()
    };
    assert!(each(|at| !begins(at)
        || step.served[at]
            == Served {
                session: Some(session),
                first_ns: None,
                last_ns: step.event.t_ns,
                is_starved: false,
            }));
    kani::cover!(begins(0), "MOT begins");
    kani::cover!(begins(1), "PLAN begins");
}

/// A rejection keeps the monitor valid and ends no session [REQ-16].
#[cfg_attr(kani, kani::proof)]
pub fn verify_the_monitor_stays_valid_at_rejections() {
    let (station, session) = (any_station(), near_integer(1, 6));
    let group = GROUPS[usize::from(kani::any::<bool>())];
    let step = Step::of(EventKind::Reject { station, group, session });
    step.keeps_the_monitor();
    assert!(each(|at| !step.ends(at)));
    kani::cover!(step.served[0].session.is_some(), "one that runs stays");
}

/// Data keep the monitor valid, and after a violation nobody is asked for as long as it waits [MON-34, MON-38].
#[cfg_attr(kani, kani::proof)]
pub fn verify_the_monitor_stays_valid_at_data() {
    let (station, session, generated_ns) = (any_station(), near_integer(1, 6), time_ns());
    let group = GROUPS[usize::from(kani::any::<bool>())];
    let step = Step::of(EventKind::Data { station, group, session, generated_ns });
    step.keeps_the_monitor();
    kani::cover!(step.ends(0), "a violation of MOT");
    kani::cover!(step.ends(1), "a violation of PLAN");
}

/// A tick keeps the monitor valid, and after silence nobody is asked for as long as it waits [MON-34, MON-38].
#[cfg_attr(kani, kani::proof)]
pub fn verify_the_monitor_stays_valid_at_ticks() {
    let step = Step::of(EventKind::Tick);
    step.keeps_the_monitor();
    kani::cover!(step.ends(0), "MOT is silent");
    kani::cover!(!step.ends(1) && step.served[1].session.is_some(), "PLAN goes on");
}

/// A withdrawal and a loss keep the monitor valid, and after a session nobody is asked for as long as it waits
/// [MON-34, MON-38].
#[cfg_attr(kani, kani::proof)]
#[cfg_attr(kani, kani::unwind(9))]
pub fn verify_the_monitor_stays_valid_at_withdrawals() {
    let is_loss = kani::any();
    let (kind, _) = withdrawal(is_loss);
    let mut table = [any_record()];
    let step = Step::with(kind, &mut table, false);
    step.keeps_the_monitor();
    kani::cover!(is_loss && step.ends(0), "a loss");
    kani::cover!(!is_loss && step.ends(1), "a withdrawal");
}

/// At a tick without detections that reach back nobody is asked, and `hold_until` is at least 1 ns after it
/// [MON-43, MON-44].
///
/// Domain: all valid states of the monitor, of the requester all, valid or not, all times but the last of 64 bits, a table
/// of one place. Not covered: whether the kept detections reach back.
#[cfg_attr(kani, kani::proof)]
#[cfg_attr(kani, kani::unwind(9))]
pub fn verify_nobody_is_asked_before_half_a_second_was_seen() {
    let mut table = [any_record()];
    let is_blind = kani::any();
    let step = Step::with(EventKind::Tick, &mut table, is_blind);
    kani::assume(step.event.t_ns < i64::MAX);
    let asks = !each(|at| step.requests[at]);
    assert!(!is_blind || !asks);
    assert!(!is_blind || step.after.hold_until_ns.is_some_and(|it| it > step.event.t_ns));
    kani::cover!(asks, "asked");
    kani::cover!(is_blind, "blind");
}

/// After an unsafe cycle, whatever made it so, every group is local and nothing came out; after a safe one no session
/// has ended, and what came out names a session that runs [FALL-01, FALL-03, FALL-11, MON-01, MON-10, MON-11].
#[cfg_attr(kani, kani::proof)]
pub fn verify_the_requester_hears_what_came_out() {
    let (before, served) = any_valid_state();
    let in_use = running(&before);
    let cycle = cycle_of(in_use);
    let released = Released::of(&cycle.answer(), in_use, cycle.has_current, cycle.has_seen);
    let kind = EventKind::Verdict { safe: released.is_safe, sessions: released.sessions };
    let step = Step::from((before, served), kind, &mut [], false);
    let after = running(&step.after);
    if released.is_safe {
        assert!(after == in_use);
        assert!(released.sessions.mot.is_none_or(|it| after[0] == Some(it)));
        assert!(released.sessions.plan.is_none_or(|it| after[1] == Some(it)));
    } else {
        assert!(!released.tracks && !released.trajectory);
        assert!(each(|at| matches!(step.after.groups[at], GroupRecord::Local)));
        assert!(step.after.hold_until_ns.is_some());
    }
    step.keeps_the_monitor();
    kani::cover!(released.is_safe && released.tracks && released.trajectory, "both come out");
    kani::cover!(!released.is_safe && step.ends(0) && step.ends(1), "both are left");
}

/// The wait after a session is nine times the time without use, one period at least, less the time of use; where nothing
/// is left there is none [MON-34, MON-35, MON-36, MON-38].
///
/// Domain: all valid counts and times of 64 bits, a period from 1 ns. Not covered: nothing of this function.
#[cfg_attr(kani, kani::proof)]
pub fn verify_the_wait_is_nine_times_without_use() {
    let (served, now_ns, period_ns) = (any_served(None), time_ns(), period_ns());
    let [now, last] = [now_ns, served.last_ns].map(i128::from);
    let first = i128::from(served.first_ns.unwrap_or(served.last_ns));
    let since = now - last;
    let without = if since > i128::from(period_ns) { since } else { i128::from(period_ns) };
    let wait = (without << 3) + without - (last - first);
    let found = served.again_ns(now_ns, period_ns);
    assert!(found.is_some() == (wait > 0));
    assert!(found.is_none_or(|it| {
        i128::from(it) == now + wait || (it == i64::MAX && now + wait > i128::from(i64::MAX))
    }));
    kani::cover!(found.is_none(), "of use for long");
    kani::cover!(found == Some(i64::MAX), "saturated");
    kani::cover!(found.is_some() && since < i128::from(period_ns), "one period");
}

/// A cycle with something current counts as use, from the first such cycle; a group starves when none came for more than
/// `dt_max` [MON-31, MON-33, MON-35, MON-36].
///
/// Domain: all valid counts and times of 64 bits, the cycle not before the first of use. Not covered: which cycles count
/// (MON-69).
#[cfg_attr(kani, kani::proof)]
pub fn verify_a_cycle_counts_what_was_of_use() {
    let before = any_served(option(|| near_integer(1, 6)));
    let (now_ns, has_current, dt_max_ns) = (time_ns(), kani::any(), super::any::duration_ns());
    kani::assume(before.first_ns.is_none_or(|first_ns| first_ns <= now_ns));
    let mut after = before;
    after.cycle(now_ns, has_current, dt_max_ns);
    let without_ns = i128::from(now_ns) - i128::from(before.last_ns);
    let is_starved = before.is_starved || without_ns > i128::from(dt_max_ns);
    let expected = if has_current {
        let first_ns = before.first_ns.or(Some(now_ns));
        Served { first_ns, last_ns: now_ns, is_starved: false, ..before }
    } else {
        Served { is_starved, ..before }
    };
    assert!(after == expected && is_ordered(after));
    kani::cover!(!before.is_starved && after.is_starved, "it starves");
    kani::cover!(before.is_starved && !after.is_starved, "it is fed");
    kani::cover!(before.first_ns.is_none() && has_current, "the first of use");
}

/// An event, and what was seen of it.
struct Step {
    event: Event,
    before: Parts,
    before_served: [Served; 2],
    after: Parts,
    served: [Served; 2],
    /// Whether no request was sent for the group.
    requests: [bool; 2],
    period_ns: i64,
}

impl Step {
    fn of(kind: EventKind) -> Self {
        Self::with(kind, &mut [], false)
    }

    fn with(kind: EventKind, table: &mut [StationRecord], is_blind: bool) -> Self {
        Self::from(any_valid_state(), kind, table, is_blind)
    }

    fn from(
        (before, before_served): (Parts, [Served; 2]),
        kind: EventKind,
        table: &mut [StationRecord],
        is_blind: bool,
    ) -> Self {
        let (event, period_ns) = (Event { t_ns: time_ns(), kind }, period_ns());
        let mut requester = Requester::resume(Suspended::from_parts(&before), table);
        let mut served = before_served;
        let answer = step(&mut requester, &mut served, &event, is_blind, period_ns);
        let Ok(done) = answer else { unreachable!("no event is refused") };
        let after = requester.suspend().parts();
        let requests = [0, 1].map(|at| done[REQUESTS][at].is_none());
        Self { event, before, before_served, after, served, requests, period_ns }
    }

    /// Whether a session of the group ran before and does not any more.
    fn ends(&self, at: usize) -> bool {
        let before = self.before_served[at].session;
        before.is_some() && running(&self.after)[at] != before
    }

    /// It stays valid; the count of a session that goes on stays; `hold_until` never falls, and after one that
    /// ends it is the end of its wait or later. That no request is sent before is `ticks::verify_t_wait_bars_requests`.
    fn keeps_the_monitor(&self) {
        assert!(is_valid(&self.after, self.served));
        let (old, new) = (self.before.hold_until_ns, self.after.hold_until_ns);
        assert!(old.is_none_or(|old| new.is_some_and(|new| new >= old)));
        assert!(each(|at| {
            let before = self.before_served[at];
            if !self.ends(at) {
                return self.served[at].session != before.session || self.served[at] == before;
            }
            let again = before.again_ns(self.event.t_ns, self.period_ns);
            again.is_none_or(|again| new.is_some_and(|new| new >= again))
        }));
    }
}

/// The session that is counted is the one that runs, and it began to be of use before it was last.
fn is_valid(requester: &Parts, served: [Served; 2]) -> bool {
    let running = running(requester);
    each(|at| served[at].session == running[at] && is_ordered(served[at]))
}

fn is_ordered(served: Served) -> bool {
    served.first_ns.is_none_or(|first_ns| first_ns <= served.last_ns)
}

fn running(requester: &Parts) -> [Option<i64>; 2] {
    requester.groups.map(|group| match group {
        GroupRecord::Local | GroupRecord::Requested { .. } => None,
        GroupRecord::Remote(running) => Some(running.session),
    })
}

pub(super) fn any_valid_state() -> (Parts, [Served; 2]) {
    let state = any_state();
    (state, running(&state).map(any_served))
}

/// A valid count of this session.
fn any_served(session: Option<i64>) -> Served {
    let (first_ns, last_ns) = (option(time_ns), time_ns());
    let served = Served { session, first_ns, last_ns, is_starved: kani::any() };
    kani::assume(is_ordered(served));
    served
}

pub(super) fn period_ns() -> i64 {
    integer_within(1, i64::MAX)
}
