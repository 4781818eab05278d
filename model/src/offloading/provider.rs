//! The provider: what a remote station does with requests (`spec/2-offloading.md#provider`).
//!
//! Times are ns on the provider's own monotonic clock.

use std::collections::BTreeMap;

use crate::services::configuration::Group;

/// Default lease, ns. `spec/2-offloading.md`.
pub const DEFAULT_LEASE_NS: i64 = 1_000_000_000;

/// A provider of groups of services to any number of requesters.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Provider {
    /// Sessions that may run at the same time.
    capacity: usize,
    lease_ns: i64,
    /// The running session of each requester and group.
    sessions: BTreeMap<(i64, Group), Running>,
}

/// Something that happens to a provider.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct ProviderEvent {
    /// When.
    pub t_ns: i64,
    /// What.
    pub kind: ProviderEventKind,
}

/// What happens. Requesters are named by integers of the caller's choice.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ProviderEventKind {
    /// A requester asks for a group.
    Request {
        /// Who asks.
        requester: i64,
        /// For what.
        group: Group,
        /// Number of the request.
        session: i64,
    },
    /// A requester ends a session.
    Release {
        /// Who.
        requester: i64,
        /// Of which group.
        group: Group,
        /// Which session.
        session: i64,
    },
    /// A requester is heard in a session: its input data, or a sign of life.
    Heard {
        /// Who.
        requester: i64,
        /// Of which group.
        group: Group,
        /// In which session.
        session: i64,
    },
    /// Time passes.
    Tick,
}

/// An answer to a request.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Reply {
    /// The session runs.
    Confirm {
        /// To whom.
        requester: i64,
        /// For what.
        group: Group,
        /// Number of the request.
        session: i64,
    },
    /// The session does not run.
    Reject {
        /// To whom.
        requester: i64,
        /// For what.
        group: Group,
        /// Number of the request.
        session: i64,
    },
}

impl Provider {
    /// No sessions. `capacity` counts sessions of any group and requester; `lease_ns` in ns.
    /// `spec/2-offloading.md#provider`.
    pub fn new(capacity: usize, lease_ns: i64) -> Self {
        Self { capacity, lease_ns, sessions: BTreeMap::new() }
    }

    /// Takes one event; sessions whose lease has run out by then end first. Returns the answer to
    /// a request, and nothing else. `spec/2-offloading.md#provider`.
    pub fn step(&mut self, event: &ProviderEvent) -> Option<Reply> {
        let now_ns = event.t_ns;
        let lease_ns = i128::from(self.lease_ns);
        self.sessions
            .retain(|_, running| i128::from(now_ns) - i128::from(running.last_heard_ns) < lease_ns);
        match event.kind {
            ProviderEventKind::Request { requester, group, session } => {
                Some(self.request(now_ns, requester, group, session))
            }
            ProviderEventKind::Release { requester, group, session } => {
                if self.session(requester, group) == Some(session) {
                    self.sessions.remove(&(requester, group));
                }
                None
            }
            ProviderEventKind::Heard { requester, group, session } => {
                if let Some(running) = self.sessions.get_mut(&(requester, group))
                    && running.session == session
                {
                    running.last_heard_ns = now_ns;
                }
                None
            }
            ProviderEventKind::Tick => None,
        }
    }

    /// Number of the running session of this requester and group.
    pub fn session(&self, requester: i64, group: Group) -> Option<i64> {
        self.sessions.get(&(requester, group)).map(|running| running.session)
    }

    /// When the requester of a running session was heard last, ns.
    /// `spec/2-offloading.md#provider`.
    pub fn last_heard_ns(&self, requester: i64, group: Group) -> Option<i64> {
        self.sessions.get(&(requester, group)).map(|running| running.last_heard_ns)
    }

    /// Number of running sessions.
    pub fn load(&self) -> usize {
        self.sessions.len()
    }

    /// Whether the state is one that the rules allow: no more sessions than the capacity.
    /// `spec/2-offloading.md#provider`.
    pub fn is_valid(&self) -> bool {
        self.sessions.len() <= self.capacity
    }

    /// The running session is confirmed again, a higher one replaces it, a lower one is rejected;
    /// without one, capacity decides.
    fn request(&mut self, now_ns: i64, requester: i64, group: Group, session: i64) -> Reply {
        let granted = match self.session(requester, group) {
            Some(running) => session >= running,
            None => self.sessions.len() < self.capacity,
        };
        if !granted {
            return Reply::Reject { requester, group, session };
        }
        self.sessions.insert((requester, group), Running { session, last_heard_ns: now_ns });
        Reply::Confirm { requester, group, session }
    }
}

/// A running session.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
struct Running {
    session: i64,
    last_heard_ns: i64,
}
