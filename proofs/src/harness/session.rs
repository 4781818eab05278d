//! Data of the running session (`spec/2-offloading.md#quality-of-service`).

use mufasa::offloading::requester::{Action, EventKind, GroupRecord, Running};

use super::seen::{DROPS, GROUPS, Seen, data_of, same};
#[cfg(not(kani))]
use crate::kani;

/// Data of the running session: a violation (from the future, `l > l_max`, `dt > dt_max`), and nothing
/// else, makes the group local; violating and stale elements are dropped; of a group that stays the
/// times alone change: a stale element is an arrival, and a used one is the last one used, too [QOS-01, QOS-02, QOS-03,
/// QOS-05, QOS-06, QOS-07, QOS-08, FALL-10].
///
/// Domain: all states with a remote group, valid or not, both groups, a table of one station, all times
/// of 64 bits. Not covered: larger tables.
#[cfg_attr(kani, kani::proof)]
pub fn verify_data_of_the_running_session_are_judged() {
    data_of(&|step: &Seen, at: usize, named: (i64, i64)| {
        let GroupRecord::Remote(running) = step.before.groups[at] else { return };
        let EventKind::Data { generated_ns, .. } = step.event.kind else { return };
        if (running.station, running.session) != named {
            return;
        }
        let (t_ns, limits) = (step.event.t_ns, step.before.parameters);
        let latency_ns = i128::from(t_ns) - i128::from(generated_ns);
        let silence_ns = i128::from(t_ns) - i128::from(running.last_arrival_ns);
        let is_late = latency_ns > i128::from(limits.l_max_ns);
        let was_silent = silence_ns > i128::from(limits.dt_max_ns);
        let violates = generated_ns > t_ns || is_late || was_silent;
        let is_stale = running.last_used_ns.is_some_and(|last_ns| generated_ns <= last_ns);
        let last_used_ns = if is_stale { running.last_used_ns } else { Some(generated_ns) };
        let expected = if violates {
            GroupRecord::Local
        } else {
            GroupRecord::Remote(Running { last_arrival_ns: t_ns, last_used_ns, ..running })
        };
        assert!(same(step.after.groups[at], expected));
        let dropped = step.done[DROPS][at] == Some(Action::Drop(GROUPS[at]));
        assert!(dropped == (violates || is_stale));
        kani::cover!(at == 0 && !dropped, "tracks are used");
        kani::cover!(at == 1 && !dropped, "a trajectory is used");
        kani::cover!(dropped && !violates, "stale");
        kani::cover!(is_late && !was_silent, "late");
        kani::cover!(was_silent && !is_late && generated_ns <= t_ns, "after silence");
        kani::cover!(generated_ns > t_ns && !was_silent, "from the future");
    });
}
