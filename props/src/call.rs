//! Events as calls of a monitor, for who has them as data.

use mufasa::monitor::{Monitor, Time};
use mufasa::offloading::requester::{Actions, EventKind, RequesterError};

/// Makes the call that the event is; none for data, which come with their contents, and for verdicts, which are the
/// monitor's own.
pub fn event(
    monitor: &mut Monitor<'_>,
    now: Time,
    kind: EventKind,
) -> Option<Result<Actions, RequesterError>> {
    Some(match kind {
        EventKind::Offer { station, groups } => monitor.offer(now, station, groups),
        EventKind::Withdraw { station } => monitor.withdraw(now, station),
        EventKind::Lost { station } => monitor.lost(now, station),
        EventKind::Area { groups } => Ok(monitor.area(now, groups)),
        EventKind::Tick => Ok(monitor.tick(now)),
        EventKind::Confirm { station, group, session } => {
            monitor.confirm(now, station, group, session)
        }
        EventKind::Reject { station, group, session } => {
            monitor.reject(now, station, group, session)
        }
        EventKind::Data { .. } | EventKind::Verdict { .. } => return None,
    })
}
