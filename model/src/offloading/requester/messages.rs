//! What goes into the requester and what comes out (`spec/2-offloading.md#requester`,
//! `spec/5-interfaces.md#offloading-trace`).

use crate::report::{InvalidInput, Report};
use crate::services::configuration::{Group, Groups};

/// Something that happens to the requester. `spec/5-interfaces.md#offloading-trace`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Event {
    /// When, on the CAV's monotonic clock.
    pub t_ns: i64,
    /// What.
    pub kind: EventKind,
}

/// What happens. Stations are >= 1. `spec/5-interfaces.md#offloading-trace`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
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
    /// A result of a group arrives.
    Data {
        /// From whom.
        station: i64,
        /// Of which group.
        group: Group,
        /// In which session.
        session: i64,
        /// When it was generated, on the CAV's clock.
        generated_ns: i64,
    },
    /// A cycle was judged.
    Verdict {
        /// How.
        safe: bool,
        /// The sessions that its remote data came from.
        sessions: Sessions,
    },
}

impl EventKind {
    /// The verdict of a cycle that used remote data of these sessions; a cycle that ended in error
    /// counts as unsafe. `spec/2-offloading.md#fallback`.
    pub fn of_cycle(result: &Result<Report, InvalidInput>, sessions: Sessions) -> Self {
        let safe = result.as_ref().is_ok_and(|report| report.failed_stage.is_none());
        Self::Verdict { safe, sessions }
    }
}

/// The sessions that the remote data of a cycle came from; `None` where it used no remote data of the
/// group. `spec/5-interfaces.md#offloading-trace`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Sessions {
    /// That of MOT.
    pub mot: Option<i64>,
    /// That of PLAN.
    pub plan: Option<i64>,
}

impl Sessions {
    /// A cycle that used no remote data.
    pub const NONE: Self = Self { mot: None, plan: None };

    /// The session of a group.
    pub fn of(self, group: Group) -> Option<i64> {
        match group {
            Group::Mot => self.mot,
            Group::Plan => self.plan,
        }
    }
}

/// Where a group runs. `spec/2-offloading.md#requester`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum GroupState {
    /// On station 0.
    Local,
    /// On station 0, while another station was asked.
    Requested {
        /// Who was asked.
        station: i64,
        /// Number of the request.
        session: i64,
        /// A confirmation comes before this time or too late.
        deadline_ns: i64,
    },
    /// On another station.
    Remote {
        /// On which.
        station: i64,
        /// Number of the request that led here.
        session: i64,
    },
}

/// What the requester does. `spec/5-interfaces.md#offloading-trace`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Action {
    /// Asks a station to run a group.
    Request {
        /// Whom.
        station: i64,
        /// For what.
        group: Group,
        /// Number of the request.
        session: i64,
    },
    /// Tells a station that a session is over.
    Release {
        /// Whom.
        station: i64,
        /// Of which group.
        group: Group,
        /// Which session.
        session: i64,
    },
    /// Starts the local services of a group.
    Activate(Group),
    /// Stops the local services of a group.
    Deactivate(Group),
    /// Does not use an element of a group.
    Drop(Group),
}

impl Action {
    /// The group concerned.
    pub fn group(self) -> Group {
        match self {
            Self::Request { group, .. }
            | Self::Release { group, .. }
            | Self::Activate(group)
            | Self::Deactivate(group)
            | Self::Drop(group) => group,
        }
    }

    /// Place among the actions of one event: drops, releases, activations and deactivations,
    /// requests; MOT before PLAN within each. `spec/2-offloading.md#fallback`.
    pub fn place(self) -> (u8, Group) {
        let kind = match self {
            Self::Drop(_) => 0,
            Self::Release { .. } => 1,
            Self::Activate(_) | Self::Deactivate(_) => 2,
            Self::Request { .. } => 3,
        };
        (kind, self.group())
    }
}
