//! What goes into the requester and what comes out (`spec/2-offloading.md#requester`,
//! `spec/5-interfaces.md#offloading-trace`).

use crate::report::{InvalidInput, Report};

/// Times of the protocol in ns, each 0 to 2^63 - 1. `spec/2-offloading.md`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Parameters {
    /// Waiting time after a safety issue.
    pub t_wait_ns: i64,
    /// Time in which a request is to be confirmed.
    pub request_timeout_ns: i64,
    /// Largest latency.
    pub l_max_ns: i64,
    /// Largest inter-arrival time.
    pub dt_max_ns: i64,
    /// Whether a violation of quality of service starts the waiting time too (I-09).
    pub qos_hold: bool,
}

impl Default for Parameters {
    fn default() -> Self {
        Self {
            t_wait_ns: 10_000_000_000,
            request_timeout_ns: 500_000_000,
            l_max_ns: 50_000_000,
            dt_max_ns: 100_000_000,
            qos_hold: false,
        }
    }
}

impl Parameters {
    /// Name of the first time outside 0 to 2^63 - 1, if any. `spec/4-arithmetic.md#domain`.
    pub fn first_outside_domain(&self) -> Option<&'static str> {
        [
            ("t_wait_ns", self.t_wait_ns),
            ("request_timeout_ns", self.request_timeout_ns),
            ("l_max_ns", self.l_max_ns),
            ("dt_max_ns", self.dt_max_ns),
        ]
        .into_iter()
        .find(|(_, value)| *value < 0)
        .map(|(name, _)| name)
    }
}

/// Services that move together. `spec/1-services.md#configuration`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Group {
    /// Multi-object tracking.
    Mot,
    /// Environment model and trajectory planning.
    Plan,
}

impl Group {
    /// Both groups in the order in which they are handled.
    pub const ALL: [Self; 2] = [Self::Mot, Self::Plan];
}

/// A set of groups.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Groups {
    /// Whether MOT is in the set.
    pub mot: bool,
    /// Whether PLAN is in the set.
    pub plan: bool,
}

impl Groups {
    /// No group.
    pub const NONE: Self = Self { mot: false, plan: false };
    /// Both groups.
    pub const ALL: Self = Self { mot: true, plan: true };

    /// Whether the group is in the set.
    pub fn contains(self, group: Group) -> bool {
        match group {
            Group::Mot => self.mot,
            Group::Plan => self.plan,
        }
    }

    /// Adds the group.
    pub fn insert(&mut self, group: Group) {
        match group {
            Group::Mot => self.mot = true,
            Group::Plan => self.plan = true,
        }
    }
}

impl FromIterator<Group> for Groups {
    fn from_iter<I: IntoIterator<Item = Group>>(groups: I) -> Self {
        let mut set = Self::NONE;
        groups.into_iter().for_each(|group| set.insert(group));
        set
    }
}

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
        /// The groups whose remote data it used.
        groups: Groups,
    },
}

impl EventKind {
    /// The verdict of a cycle that used remote data of these groups; a cycle that ended in error
    /// counts as unsafe. `spec/2-offloading.md#fallback`.
    pub fn of_cycle(result: &Result<Report, InvalidInput>, groups: Groups) -> Self {
        let safe = result.as_ref().is_ok_and(|report| report.failed_stage.is_none());
        Self::Verdict { safe, groups }
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
