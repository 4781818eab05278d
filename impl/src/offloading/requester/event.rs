//! What happens to a requester, and what it does about it
//! (`spec/2-offloading.md#requester`, `spec/5-interfaces.md#offloading-trace`).

use core::fmt;
use core::ops::Deref;

use super::per_group::PerGroup;
use crate::report::{InvalidInput, Report};
use crate::services::configuration::{Group, Groups};

/// Something that happens at a time. Source: `spec/2-offloading.md#requester`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Event {
    /// The CAV's monotonic clock, in ns. Never compared with a clock.
    pub t_ns: i64,
    /// What happens.
    pub kind: EventKind,
}

/// What happens. Every `station` must be >= 1; sessions and generation times may be anything.
/// Source: `spec/2-offloading.md#requester`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum EventKind {
    /// A station offers groups; this replaces its previous offer.
    Offer {
        /// The station's id.
        station: i64,
        /// What it offers from now on.
        groups: Groups,
    },
    /// A station withdraws its offer.
    Withdraw {
        /// The station's id.
        station: i64,
    },
    /// A station can no longer be reached.
    Lost {
        /// The station's id.
        station: i64,
    },
    /// From now on these groups may be offloaded (CODM).
    Area {
        /// The groups of the area.
        groups: Groups,
    },
    /// Time passes; deadlines, silence and requests are decided.
    Tick,
    /// A station confirms a session.
    Confirm {
        /// The station's id.
        station: i64,
        /// The group it names.
        group: Group,
        /// The session it names.
        session: i64,
    },
    /// A station rejects a session.
    Reject {
        /// The station's id.
        station: i64,
        /// The group it names.
        group: Group,
        /// The session it names.
        session: i64,
    },
    /// A result of a station arrives.
    Data {
        /// The station's id.
        station: i64,
        /// The group it names.
        group: Group,
        /// The session it names.
        session: i64,
        /// When the result was generated, in ns of the CAV's clock.
        generated_ns: i64,
    },
    /// A cycle of the stages ended.
    Verdict {
        /// Whether the cycle was safe; one that ended in `error` is not.
        safe: bool,
        /// The sessions that the data of the cycle came from.
        sessions: Sessions,
    },
}

/// For each group whose data a cycle used, the session they came from. Source:
/// `spec/5-interfaces.md#offloading-trace`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Sessions {
    /// That of MOT.
    pub mot: Option<i64>,
    /// That of PLAN.
    pub plan: Option<i64>,
}

impl Sessions {
    /// No group's data were used.
    pub const NONE: Self = Self { mot: None, plan: None };

    /// That of `group`. Source: `spec/5-interfaces.md#offloading-trace`.
    pub const fn of(self, group: Group) -> Option<i64> {
        match group {
            Group::Mot => self.mot,
            Group::Plan => self.plan,
        }
    }
}

impl EventKind {
    /// The end of a cycle as an event. `answer`: what `cycle::check` said; an error counts as
    /// unsafe. `sessions`: those that the data of the cycle came from. Source: `spec/2-offloading.md#fallback`.
    pub const fn of_cycle(answer: &Result<Report, InvalidInput>, sessions: Sessions) -> Self {
        let safe = match answer {
            Ok(report) => report.failed_stage.is_none(),
            // FALL-11
            Err(_) => false,
        };
        Self::Verdict { safe, sessions }
    }

    /// The station that the event names, if it is of a kind that names one. Source:
    /// `spec/5-interfaces.md#offloading-trace`.
    pub const fn station(&self) -> Option<i64> {
        match *self {
            Self::Offer { station, .. }
            | Self::Withdraw { station }
            | Self::Lost { station }
            | Self::Confirm { station, .. }
            | Self::Reject { station, .. }
            | Self::Data { station, .. } => Some(station),
            Self::Area { .. } | Self::Tick | Self::Verdict { .. } => None,
        }
    }
}

/// Something that the requester does. Source: `spec/2-offloading.md#fallback`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Action {
    /// Ask a station to run a group.
    Request {
        /// The station's id.
        station: i64,
        /// The group.
        group: Group,
        /// The number of the request, from 1.
        session: i64,
    },
    /// Tell a station that a session has ended.
    Release {
        /// The station's id.
        station: i64,
        /// The group.
        group: Group,
        /// The session.
        session: i64,
    },
    /// Start the local services of a group.
    Activate(Group),
    /// Stop the local services of a group.
    Deactivate(Group),
    /// Do not use the element that arrived.
    Drop(Group),
}

impl Action {
    /// Its place among the actions of one event (`spec/2-offloading.md#fallback`).
    const fn place(&self) -> (u8, bool) {
        let (kind, group) = match *self {
            Self::Drop(group) => (0, group),
            Self::Release { group, .. } => (1, group),
            Self::Activate(group) | Self::Deactivate(group) => (2, group),
            Self::Request { group, .. } => (3, group),
        };
        (kind, matches!(group, Group::Plan))
    }
}

/// The actions of one event, in the order in which they are taken: drops, releases, activations
/// and deactivations, requests; MOT before PLAN within each. Read it as a slice. Source:
/// `spec/2-offloading.md#fallback`.
#[derive(Clone, Copy)]
#[must_use = "actions have to be taken: a fallback is one"]
pub struct Actions {
    items: [Action; Outbox::CAPACITY],
    len: usize,
}

impl Actions {
    /// The actions in their order.
    pub fn as_slice(&self) -> &[Action] {
        self.items.get(..self.len).unwrap_or(&self.items)
    }
}

impl fmt::Debug for Actions {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.as_slice().fmt(f)
    }
}

impl Deref for Actions {
    type Target = [Action];

    fn deref(&self) -> &[Action] {
        self.as_slice()
    }
}

impl<'s> IntoIterator for &'s Actions {
    type Item = &'s Action;
    type IntoIter = core::slice::Iter<'s, Action>;

    fn into_iter(self) -> Self::IntoIter {
        self.as_slice().iter()
    }
}

impl PartialEq for Actions {
    fn eq(&self, other: &Self) -> bool {
        self.as_slice() == other.as_slice()
    }
}

impl Eq for Actions {}

/// The actions of one event while they are being decided: one place for every kind and group,
/// because no event leaves, starts, stops or asks for a group twice.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Outbox {
    pub(super) drops: PerGroup<Option<Action>>,
    pub(super) releases: PerGroup<Option<Action>>,
    pub(super) services: PerGroup<Option<Action>>,
    pub(super) requests: PerGroup<Option<Action>>,
}

impl Outbox {
    /// Four kinds of two groups.
    const CAPACITY: usize = 8;

    /// The actions of MOT and PLAN, kind by kind in the order of `spec/2-offloading.md#fallback`.
    pub(super) fn by_kind(&self) -> ByKind {
        // FALL-13
        let of = |kind: &PerGroup<Option<Action>>| [*kind.get(Group::Mot), *kind.get(Group::Plan)];
        [of(&self.drops), of(&self.releases), of(&self.services), of(&self.requests)]
    }
}

/// Drops, releases, activations and deactivations, requests; MOT before PLAN within each.
pub(crate) type ByKind = [[Option<Action>; 2]; 4];

impl Actions {
    pub(crate) const NONE: Self =
        Self { items: [Action::Drop(Group::Mot); Outbox::CAPACITY], len: 0 };

    /// The actions there are, in their order.
    pub(crate) fn of(by_kind: ByKind) -> Self {
        let mut actions = Self::NONE;
        actions.extend(&by_kind);
        actions
    }

    /// These, and those of a later part of the same event, in the order of one: at most as many as there is place
    /// for.
    pub(crate) fn and(self, later: &Self) -> Self {
        let mut both = Self::NONE;
        // FALL-13
        for kind in 0..4 {
            for is_plan in [false, true] {
                let here = |action: &&Action| action.place() == (kind, is_plan);
                let actions = self.iter().chain(later.iter()).filter(here);
                actions.for_each(|action| both.append(Some(*action)));
            }
        }
        both
    }

    pub(crate) fn extend(&mut self, by_kind: &ByKind) {
        for &[mot, plan] in by_kind {
            self.append(mot);
            self.append(plan);
        }
    }

    fn append(&mut self, action: Option<Action>) {
        if let (Some(action), Some(place)) = (action, self.items.get_mut(self.len)) {
            *place = action;
            self.len = self.len.saturating_add(1);
        }
    }
}
