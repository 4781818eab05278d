//! The monitor: the one way to use offloaded results (`spec/monitor.md#monitor`).
//!
//! [`Monitor`] owns what has to live between cycles: the requester, the CAV's own earlier detections,
//! the route with its index, scratch. Events go in, and actions come out; remote data come out of
//! [`Monitor::cycle`] alone, and only when it is safe. The functions beneath, [`crate::cycle::check`] and
//! [`crate::offloading::requester::Requester::step`], answer the same, and leave it to the caller to
//! bring them together.
//!
//! Two rules bar requests beside those of the requester. After a session no station is asked for nine times
//! as long as nothing of it was of use (at least one period), less the time for which it was: so that one
//! which sends nothing of use has a group for at most a tenth of the time (F-43). And in the hardened profile no station is asked
//! before the CAV's own detections reach back half a second: without them nothing that the station leaves
//! out is examined as moving (H-14). Both show in [`Requester::hold_until_ns`].

mod advice;
pub(crate) mod arriving;
mod calibration;
mod cycle;
mod decision;
mod element;
mod events;
pub(crate) mod history;
mod inputs;
pub(crate) mod memory;
mod own_plan;
pub(crate) mod released;
pub(crate) mod route;
pub(crate) mod served;
mod settings;
pub(crate) mod stall;
mod time;
mod unusual;

pub use self::advice::Advice;
pub use self::calibration::Calibration;
pub use self::decision::{Brake, Decision, Verified};
pub use self::element::{Accepted, Arrival, DropReason, Message};
pub use self::inputs::{Gap, GridMap, Inputs};
pub use self::memory::Memory;
pub use self::settings::{MonitorError, Settings};
pub use self::stall::Stall;
pub use self::time::{Time, TimeError};
pub use self::unusual::Unusual;

use self::advice::Watch;
use self::history::History;
use self::memory::Lengths;
use self::route::KeptRoute;
use self::served::Served;
use self::stall::Progress;
use crate::cycle::steps::Counts;
use crate::input::cycle::Route;
use crate::input::scratch::{Column, Row};
use crate::offloading::requester::per_group::PerGroup;
use crate::offloading::requester::{Requester, Source, StationRecord, Suspended};
use crate::report::InvalidInput;
use crate::services::configuration::{Configuration, Group};

/// The monitor of one CAV; see the [module](self), and the [crate] for a whole vehicle loop. Source:
/// `spec/monitor.md#monitor`.
#[derive(Debug)]
pub struct Monitor<'a> {
    settings: Settings,
    requester: Requester<'a>,
    served: PerGroup<Served>,
    /// The last tick since the last cycle.
    ticked: Option<Time>,
    /// The last cycle.
    cycled: Option<Time>,
    /// What the last cycle said of the CAV's own plan.
    brake: Option<Brake>,
    progress: Progress,
    watch: Watch,
    history: History<'a>,
    route: KeptRoute<'a>,
    /// Sizes that are checked in time, whatever a cycle of them holds.
    in_time: Counts,
    rows: &'a mut [Row],
    columns: &'a mut [Column],
}

impl<'a> Monitor<'a> {
    /// Everything local, no offers, no route, nothing seen yet; every group may be offloaded everywhere
    /// until the first `area`.
    ///
    /// Errors: settings that no monitor can keep, such as a `dt_max` that is not above the period; too
    /// little memory; more than is checked in `check_time` (`spec/4-arithmetic.md#steps`). Source: `spec/monitor.md#monitor`.
    pub fn new(settings: Settings, memory: Memory<'a>) -> Result<Self, MonitorError> {
        settings.check()?;
        let Memory { stations, rows, columns, detections, slots, cross_sections, blocks } = memory;
        let lengths = Lengths {
            stations: stations.len(),
            rows: rows.len(),
            columns: columns.len(),
            detections: detections.len(),
            slots: slots.len(),
        };
        let capacity = lengths.capacity(settings.profile.looks_back())?;
        let detected = if settings.profile.looks_back() { capacity } else { columns.len() };
        // IMPL-11
        let in_time =
            settings.in_time([rows.len(), detected, cross_sections.len(), stations.len()])?;
        let (needed, given) = (Memory::slots_for(capacity), slots.len());
        let too_few = MonitorError::Memory { field: "slots", needed, given };
        Ok(Self {
            settings,
            requester: requester(&settings, stations)?,
            served: PerGroup::default(),
            ticked: None,
            cycled: None,
            brake: None,
            progress: Progress::default(),
            watch: Watch::default(),
            history: History::new(detections, slots, capacity).ok_or(too_few)?,
            route: KeptRoute::new(cross_sections, blocks),
            in_time,
            rows,
            columns,
        })
    }

    /// What a step costs by this clock, in ps: `Settings::step_ps`. The clock is monotonic, in nanoseconds, and tells microseconds
    /// apart. Take the greatest of several answers, on the processor, at the clock rate and with the build that the vehicle
    /// uses. Source: `spec/4-arithmetic.md#steps`.
    pub fn calibrate(now_ns: impl FnMut() -> u64) -> u64 {
        calibration::step_ps(now_ns)
    }

    /// From now on the CAV follows this route, of which a copy is kept. Where it ends before the CAV can stop
    /// (`s_stop`), each cycle of the hardened profile fails stage ii (H-14.58).
    ///
    /// Errors: the first invalid value; less memory than it needs. Then it follows the route before.
    /// Source: `spec/3-stages.md#stage-ii-trajectory-to-map`.
    pub fn set_route(&mut self, route: &Route<'_>) -> Result<(), InvalidInput> {
        self.route.set(route)
    }

    /// Which groups are remote. Source: `spec/1-services.md#configuration`.
    pub const fn configuration(&self) -> Configuration {
        self.requester.configuration()
    }

    /// Whose results of a group may reach control. Source: `spec/1-services.md#configuration`.
    pub const fn source(&self, group: Group) -> Source {
        self.requester.source(group)
    }

    /// What the vehicle's program seems to get wrong, each once: to be asked after each cycle, and written to a log that
    /// somebody reads. It never changes a verdict. Source: `spec/4-arithmetic.md#advice`.
    pub fn advice(&mut self) -> Option<Advice> {
        self.watch.next()
    }

    /// The requester, to look at: states, holds, the last session. Source:
    /// `spec/2-offloading.md#requester`.
    pub const fn requester(&self) -> &Requester<'a> {
        &self.requester
    }
}

/// A requester whose sessions are numbered on from those before.
fn requester<'a>(
    settings: &Settings,
    stations: &'a mut [StationRecord],
) -> Result<Requester<'a>, MonitorError> {
    let fresh = Requester::new(settings.profile, settings.requester, stations);
    // MON-23
    let mut parts = fresh.map_err(MonitorError::Requester)?.suspend().parts();
    // MON-28
    parts.sessions = settings.sessions_before;
    Ok(Requester::resume(Suspended::from_parts(&parts), stations))
}
