//! Parts of the monitor (`spec/monitor.md#monitor`).

pub use crate::monitor::arriving::Arriving;
pub use crate::monitor::memory::Lengths;
pub use crate::monitor::released::{Released, if_kept, is_last_used, is_ticked};
pub use crate::monitor::served::Served;

use crate::input::cycle::{CrossSection, DetectionList, Route};
use crate::input::detection_index::DetectionIndex;
use crate::input::route_index::Block;
use crate::monitor::history::{self, History, Kept};
use crate::monitor::memory::PLACES;
use crate::monitor::route::KeptRoute;
use crate::monitor::stall::Progress;
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

/// The kept lists of detections by their stamps, ns. Source: `spec/monitor.md#monitor`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Stamps {
    /// That of the list in each place.
    pub kept: [Option<i64>; PLACES],
    /// The next place to be taken.
    pub next: usize,
    /// That of the last list kept.
    pub youngest_ns: Option<i64>,
}

impl Stamps {
    fn lists(&self) -> [Option<Kept>; PLACES] {
        let shape = DetectionIndex::EMPTY.shape();
        self.kept.map(|stamp_ns| stamp_ns.map(|stamp_ns| Kept { stamp_ns, count: 0, shape }))
    }

    fn history(&self) -> Option<History<'_>> {
        let mut history = History::new(&mut [], &mut [], 0)?;
        (history.kept, history.next, history.youngest_ns) =
            (self.lists(), self.next, self.youngest_ns);
        Some(history)
    }

    /// What is kept when a current and valid list with this stamp comes. Source: `spec/monitor.md#monitor`.
    pub fn keep(&self, stamp_ns: i64) -> Option<Self> {
        let mut history = self.history()?;
        let list = DetectionList { stamp_ns, items: &[] };
        history.keep(&list, DetectionIndex::EMPTY.shape());
        let kept = history.kept.map(|kept| kept.map(|kept| kept.stamp_ns));
        Some(Self { kept, next: history.next, youngest_ns: history.youngest_ns })
    }

    /// The places of the lists that a cycle with detections of this stamp looks at, for each wanted age. Source:
    /// `spec/monitor.md#monitor`.
    pub fn nearest(&self, stamp_ns: i64) -> [Option<usize>; 3] {
        history::nearest(&self.lists(), stamp_ns)
    }

    /// Whether a station may be asked at this time. Source: `spec/monitor.md#monitor`.
    pub fn reaches_back(&self, now_ns: i64) -> Option<bool> {
        Some(self.history()?.reaches_back(now_ns))
    }
}

/// Where the CAV was last seen to get on, for how long PLAN has been remote since, and the last cycle with PLAN remote,
/// ns; after a cycle that finds it at a place, for a `stall` of this way. Source: `spec/monitor.md#monitor`.
pub fn get_on(
    (place, remote_ns, last_ns): ([f64; 2], i64, Option<i64>),
    now_ns: i64,
    found: Option<[f64; 2]>,
    is_remote: bool,
    way_m: f64,
) -> ([f64; 2], i64, Option<i64>) {
    let mut progress = Progress { place, remote_ns, last_ns, given_back: None };
    progress.cycle(now_ns, found, is_remote, way_m);
    (progress.place, progress.remote_ns, progress.last_ns)
}
