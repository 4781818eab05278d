//! Parts of the monitor (`spec/monitor.md#monitor`).

pub use crate::monitor::arriving::Arriving;
pub use crate::monitor::memory::Lengths;
pub use crate::monitor::released::{Released, if_kept, is_last_used, is_ticked};
pub use crate::monitor::served::Served;

use crate::input::cycle::{CrossSection, Route};
use crate::input::route_index::Block;
use crate::monitor::route::KeptRoute;
use crate::monitor::{DropReason, Settings, Time};
use crate::offloading::requester::per_group::PerGroup;
use crate::offloading::requester::{Action, Event, Requester, RequesterError};
use crate::services::configuration::Group;

/// What has to be done, kind by kind, for MOT and PLAN.
type ByKind = [[Option<Action>; 2]; 4];

/// An event of the requester of a monitor, as `decide`, and what follows from it for MOT and PLAN. `is_blind`: the kept
/// detections do not reach back. Source: `spec/monitor.md#monitor`.
pub fn step(
    requester: &mut Requester<'_>,
    served: &mut [Served; 2],
    event: &Event,
    is_blind: bool,
    period_ns: i64,
) -> Result<ByKind, RequesterError> {
    with(served, |groups| groups.step(requester, event, is_blind, || period_ns))
}

/// A message that reaches a monitor: why it is dropped, if it is, and what has to be done. Source:
/// `spec/monitor.md#monitor`.
pub fn receive(
    requester: &mut Requester<'_>,
    served: &mut [Served; 2],
    now_ns: i64,
    message: &Arriving,
    [max_age_ns, period_ns]: [i64; 2],
) -> Result<(Option<DropReason>, ByKind), RequesterError> {
    with(served, |it| it.receive(requester, now_ns, message, max_age_ns, || period_ns))
}

fn with<T>(served: &mut [Served; 2], act: impl FnOnce(&mut PerGroup<Served>) -> T) -> T {
    let [mot, plan] = *served;
    let mut groups = PerGroup::new(mot, plan);
    let answer = act(&mut groups);
    *served = [*groups.get(Group::Mot), *groups.get(Group::Plan)];
    answer
}

/// Gives a monitor whose memory is full of a route another one: whether it takes it. `closed`: that of the first, then of
/// the one that it has. Source: `spec/monitor.md#monitor`.
pub fn set_route(
    cross_sections: &mut [CrossSection],
    blocks: &mut [Block],
    closed: &mut bool,
    route: &Route<'_>,
) -> (bool, usize) {
    let count = cross_sections.len();
    let mut kept = KeptRoute { cross_sections, blocks, count, closed: *closed };
    let is_taken = kept.set(route).is_ok();
    *closed = kept.closed;
    (is_taken, kept.count)
}

/// The time by which control has to brake along what comes out of a cycle at this time. Source:
/// `spec/monitor.md#monitor`.
pub fn brake_by(settings: &Settings, now_ns: i64) -> Option<i64> {
    settings.brake_by(now_ns).map(Time::as_nanoseconds)
}
