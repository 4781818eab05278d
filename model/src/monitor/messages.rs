//! What goes into the monitor and what comes out (`spec/5-interfaces.md#monitor`).

use crate::input::cycle::{DetectionList, Ego, Grid, Lead, TrackList, Trajectory};
use crate::offloading::requester::{Action, GroupState};
use crate::report::{FailedStage, InvalidInput, Report, Witness};
use crate::services::configuration::{Group, Groups};

/// Something that happens to the monitor.
#[derive(Clone, Debug, PartialEq)]
pub struct Event {
    /// When, on the CAV's monotonic clock.
    pub t_ns: i64,
    /// What.
    pub kind: EventKind,
}

/// What happens: the events of a trace, data with their contents, and cycles. Stations are >= 1.
#[derive(Clone, Debug, PartialEq)]
pub enum EventKind {
    /// A station offers to run these groups, and no others.
    Offer {
        /// Who offers.
        station: i64,
        /// What it offers.
        groups: Groups,
    },
    /// A station takes its offer back.
    Withdraw {
        /// Whose offer.
        station: i64,
    },
    /// A station cannot be reached any more.
    Lost {
        /// Who is lost.
        station: i64,
    },
    /// The groups that may be offloaded here (CODM).
    Area {
        /// They and no others.
        groups: Groups,
    },
    /// Time passes.
    Tick,
    /// A station agrees to run a group.
    Confirm {
        /// Who agrees.
        station: i64,
        /// To what.
        group: Group,
        /// In which session.
        session: i64,
    },
    /// A station does not agree.
    Reject {
        /// Who does not.
        station: i64,
        /// To what.
        group: Group,
        /// In which session.
        session: i64,
    },
    /// A result of MOT arrives.
    Tracks {
        /// From whom.
        station: i64,
        /// In which session.
        session: i64,
        /// When it was generated, on the CAV's clock.
        generated_ns: i64,
        /// The list.
        tracks: TrackList,
    },
    /// A result of PLAN arrives.
    Trajectory {
        /// From whom.
        station: i64,
        /// In which session.
        session: i64,
        /// When it was generated, on the CAV's clock.
        generated_ns: i64,
        /// The trajectory.
        trajectory: Trajectory,
    },
    /// The CAV decides.
    Cycle {
        /// What it measured.
        measured: Box<Measured>,
    },
}

/// What the CAV measured, and what its own services gave; `None` is a missing input.
#[derive(Clone, Debug, PartialEq)]
pub struct Measured {
    /// The CAV itself.
    pub ego: Ego,
    /// The trajectory of its own planner.
    pub trajectory: Option<Trajectory>,
    /// The tracks of its own tracking.
    pub tracks: Option<TrackList>,
    /// The detections of all local detectors.
    pub detections: Option<DetectionList>,
    /// The leading vehicle.
    pub lead: Option<Lead>,
    /// The occupancy grid map.
    pub grid: Option<Grid>,
}

/// The state after an event or cycle, and what it made the monitor do.
#[derive(Clone, Debug, PartialEq)]
pub struct Answer {
    /// Where MOT runs.
    pub mot: GroupState,
    /// Where PLAN runs.
    pub plan: GroupState,
    /// End of the last hold, ns; `None` before the first.
    pub hold_until_ns: Option<i64>,
    /// In the order in which they are taken.
    pub actions: Vec<Action>,
    /// Why the element of this event was dropped.
    pub dropped: Option<Dropped>,
    /// When PLAN was given back last, ns. [MON-59]
    pub given_back_ns: Option<i64>,
    /// Of a cycle.
    pub decision: Option<Decision>,
}

/// Why an element was dropped. [MON-09]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Dropped {
    /// Of another session than the running one.
    OtherSession,
    /// More tracks than the memory has places for. [MON-20]
    DoesNotFit,
    /// Too old for every cycle by its stamp. [MON-30]
    Stale,
    /// Its group is starved. [MON-32]
    Starved,
    /// A violation of quality of service.
    Late,
    /// Generated when the last one used was.
    Repeated,
    /// Generated before the last one used.
    Older,
}

/// What a cycle decided.
#[derive(Clone, Debug, PartialEq)]
pub struct Decision {
    /// What the stages said; `Err` is an error, which is unsafe, too.
    pub report: Result<Report, InvalidInput>,
    /// The remote tracks that come out.
    pub tracks: Option<Verified>,
    /// The trajectory that comes out.
    pub trajectory: Option<Verified>,
    /// The time by which control has to brake along this trajectory, ns. [MON-40]
    pub brake_by_ns: Option<i64>,
    /// Why control has to brake at once. [MON-50] [MON-51]
    pub brake: Option<Brake>,
}

impl Decision {
    /// Whether the cycle is safe: an error is not. [MON-10]
    pub fn is_safe(&self) -> bool {
        self.report.as_ref().is_ok_and(|report| report.failed_stage.is_none())
    }
}

/// An element that reached control, by its stamp and its source.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Verified {
    /// Stamp of the list or trajectory, ns.
    pub stamp_ns: i64,
    /// Station and session of a remote element; `None`: of a local planner.
    pub remote: Option<(i64, i64)>,
}

/// Why control has to brake at once.
#[derive(Clone, Debug, PartialEq)]
pub enum Brake {
    /// The CAV's own trajectory failed. [MON-50]
    Failed(FailedStage, Option<Witness>),
    /// Something is invalid. [MON-50]
    Invalid(InvalidInput),
    /// The CAV's own planner gave no current trajectory. [MON-51]
    NoTrajectory,
}
