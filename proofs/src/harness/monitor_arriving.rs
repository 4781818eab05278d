//! What becomes of a message at the monitor (`spec/monitor.md#monitor`).
//!
//! Domain: all valid states of the monitor, of the requester all, valid or not, with sessions from 1, messages of
//! either group, all times of 64 bits, each `max_age` of the domain (0 to 60 s), `l_max` at most that, as settings have
//! to be. Not covered: the table of stations.

use mufasa::monitor::DropReason;
use mufasa::offloading::requester::{GroupRecord, Requester, Running, Suspended};
use mufasa::parts::monitor::{Arriving, receive};

use super::any::{integer_within, near_integer, time_ns};
use super::monitor_served::{any_valid_state, period_ns};
use super::seen::GROUPS;
use super::states::any_station;
#[cfg(not(kani))]
use crate::kani;

/// A message is accepted exactly when it is of the running session, generated within `l_max`, stamped at most `max_age`
/// ago, newer than the last one used, not after silence, of a group that does not starve, and no longer than the memory
/// [REQ-20, QOS-07, QOS-08, MON-20, MON-30, MON-32].
#[cfg_attr(kani, kani::proof)]
pub fn verify_a_message_is_accepted_exactly_when_it_is_of_use() {
    let it = Arrived::any();
    let expected = it.runs()
        && it.is_in_time()
        && !it.is_too_old()
        && !it.is_starved
        && !it.message.is_too_long
        && !it.is_after_silence()
        && it.is_newer();
    assert!(it.why.is_none() == expected);
    kani::cover!(expected, "accepted");
    kani::cover!(it.runs() && it.message.is_too_long, "too long");
    kani::cover!(it.runs() && it.is_starved, "starved");
}

/// The reason of a drop is the first that holds [MON-09].
#[cfg_attr(kani, kani::proof)]
pub fn verify_the_reason_of_a_drop_is_the_first_that_holds() {
    let it = Arrived::any();
    let reasons = [
        (!it.runs(), DropReason::OtherSession),
        (it.message.is_too_long, DropReason::TooLong),
        (it.message.generated_ns > it.now_ns, DropReason::FromTheFuture),
        (!it.is_in_time(), DropReason::Late),
        (it.is_too_old(), DropReason::TooOld),
        (it.is_starved, DropReason::Starved),
        (it.is_after_silence(), DropReason::AfterSilence),
        (!it.is_newer(), DropReason::NotNewer),
    ];
    let mut expected = None;
    for (holds, why) in reasons.into_iter().rev() {
        if holds {
            expected = Some(why);
        }
    }
    assert!(it.why == expected);
    kani::cover!(it.why == Some(DropReason::TooLong), "too long");
    kani::cover!(it.why == Some(DropReason::OtherSession), "another session");
    kani::cover!(it.why == Some(DropReason::FromTheFuture), "from the future");
    kani::cover!(it.why == Some(DropReason::Late), "late");
    kani::cover!(it.why == Some(DropReason::TooOld), "too old");
    kani::cover!(it.why == Some(DropReason::Starved), "starved");
    kani::cover!(it.why == Some(DropReason::AfterSilence), "after silence");
    kani::cover!(it.why == Some(DropReason::NotNewer), "not newer");
}

/// A message that does not fit, and one in time that is too old for every cycle or of a starved group, is no arrival:
/// the running session is as it was [MON-20, MON-30, MON-32].
#[cfg_attr(kani, kani::proof)]
pub fn verify_what_no_cycle_can_use_is_no_arrival() {
    let it = Arrived::any();
    let is_of_no_use = it.is_in_time() && (it.is_too_old() || it.is_starved);
    let is_none = it.message.is_too_long || is_of_no_use;
    assert!(!is_none || (it.why.is_some() && it.after == it.before));
    kani::cover!(is_none && it.runs(), "no arrival");
    kani::cover!(!is_none && it.runs() && it.after != it.before, "an arrival");
}

/// A message, and what was seen of it.
struct Arrived {
    message: Arriving,
    now_ns: i64,
    max_age_ns: i64,
    l_max_ns: i64,
    dt_max_ns: i64,
    is_starved: bool,
    before: Option<Running>,
    after: Option<Running>,
    why: Option<DropReason>,
}

impl Arrived {
    fn any() -> Self {
        // The group is a constant in each of the two branches.
        if kani::any() { Self::of(0) } else { Self::of(1) }
    }

    fn of(at: usize) -> Self {
        let (state, mut served) = any_valid_state();
        let before = running(state.groups[at]);
        kani::assume(before.is_none_or(|it| it.session >= 1));
        let message = Arriving {
            station: any_station(),
            group: GROUPS[at],
            session: near_integer(1, 6),
            generated_ns: time_ns(),
            stamp_ns: time_ns(),
            is_too_long: kani::any(),
        };
        let (now_ns, max_age_ns) = (time_ns(), integer_within(0, 60_000_000_000));
        kani::assume(state.parameters.l_max_ns <= max_age_ns);
        let is_starved = served[at].is_starved;
        let mut requester = Requester::resume(Suspended::from_parts(&state), &mut []);
        let limits = [max_age_ns, period_ns()];
        let answer = receive(&mut requester, &mut served, now_ns, &message, limits);
        let Ok((why, _)) = answer else { unreachable!("no message is refused") };
        let after = running(requester.suspend().parts().groups[at]);
        let (l_max_ns, dt_max_ns) = (state.parameters.l_max_ns, state.parameters.dt_max_ns);
        Self { message, now_ns, max_age_ns, l_max_ns, dt_max_ns, is_starved, before, after, why }
    }

    fn runs(&self) -> bool {
        let Arriving { station, session, .. } = self.message;
        self.before.is_some_and(|it| it.station == station && it.session == session)
    }

    fn age_ns(&self, of_ns: i64) -> i128 {
        i128::from(self.now_ns) - i128::from(of_ns)
    }

    fn is_in_time(&self) -> bool {
        let latency_ns = self.age_ns(self.message.generated_ns);
        0 <= latency_ns && latency_ns <= i128::from(self.l_max_ns)
    }

    fn is_too_old(&self) -> bool {
        self.age_ns(self.message.stamp_ns) > i128::from(self.max_age_ns)
    }

    fn is_after_silence(&self) -> bool {
        let since_ns = self.before.map(|it| self.age_ns(it.last_arrival_ns));
        since_ns.is_some_and(|it| it > i128::from(self.dt_max_ns))
    }

    fn is_newer(&self) -> bool {
        let last_ns = self.before.and_then(|it| it.last_used_ns);
        last_ns.is_none_or(|last_ns| self.message.generated_ns > last_ns)
    }
}

fn running(group: GroupRecord) -> Option<Running> {
    match group {
        GroupRecord::Local | GroupRecord::Requested { .. } => None,
        GroupRecord::Remote(running) => Some(running),
    }
}
