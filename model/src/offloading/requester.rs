//! The requester: which groups run remotely, and every step between (`spec/2-offloading.md`).
//!
//! [`Requester::step`] is total: any event in any state, at any time, forwards or backwards.

mod inspect;
mod messages;
pub(crate) mod parameters;
mod state;
mod steps;

use std::collections::{BTreeMap, BTreeSet};

pub use crate::services::configuration::{Group, Groups};
pub use messages::{Action, Event, EventKind, GroupState, Sessions};
pub use parameters::Parameters;
pub use state::Session;

use crate::input::profile::{HardenedRule, Profile};
use crate::services::configuration::{Configuration, Source};
use state::{Count, Farewell, Use};

/// The state of a requester. Two that differ only in how much data they dropped are equal: the
/// count decides nothing.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Requester {
    profile: Profile,
    parameters: Parameters,
    mot: Use,
    plan: Use,
    hold_until_ns: Option<i64>,
    /// The current offers by station.
    offers: BTreeMap<i64, Groups>,
    area: Groups,
    /// Sessions are numbered on from this number.
    first_session: i64,
    /// Number of the last request; that number before the first.
    last_session: i64,
    /// The session of the last request to each station for each group. Sessions are numbered in
    /// the order of the requests, so the smallest one is the oldest request.
    last_asked: BTreeMap<(Group, i64), i64>,
    foreign_data: Count,
}

impl Requester {
    /// Everything local, no offers, no hold, all groups in the area.
    /// `spec/2-offloading.md#requester`.
    pub fn new(profile: Profile, parameters: Parameters) -> Self {
        Self {
            profile,
            parameters,
            mot: Use::Local,
            plan: Use::Local,
            hold_until_ns: None,
            offers: BTreeMap::new(),
            area: Groups::ALL,
            first_session: 0,
            last_session: 0,
            last_asked: BTreeMap::new(),
            foreign_data: Count(0),
        }
    }

    /// The same before its first request, with sessions numbered on from this number, at least 0.
    /// `spec/monitor.md` [MON-28].
    #[must_use]
    pub fn numbered_on_from(self, last_session: i64) -> Self {
        Self { first_session: last_session, last_session, ..self }
    }

    /// The program that runs the requester begins a hold: `hold_until` becomes the later of its old value
    /// and this time, ns. `spec/2-offloading.md#fallback`.
    pub fn hold_at_least(&mut self, until_ns: i64) {
        self.hold_until_ns = Some(self.hold_until_ns.map_or(until_ns, |old| old.max(until_ns)));
    }

    /// Takes one event and returns the actions in the order in which they are taken.
    /// `spec/2-offloading.md#fallback`.
    pub fn step(&mut self, event: &Event) -> Vec<Action> {
        let now_ns = event.t_ns;
        let mut actions = match event.kind {
            EventKind::Offer { station, groups } => self.offer(station, groups),
            EventKind::Withdraw { station } => self.withdraw(station, Farewell::Release),
            EventKind::Lost { station } => self.withdraw(station, Farewell::Silent),
            EventKind::Area { groups } => self.area(groups),
            EventKind::Tick => self.tick(now_ns),
            EventKind::Confirm { station, group, session } => {
                self.confirm(now_ns, station, group, session)
            }
            EventKind::Reject { station, group, session } => self.reject(station, group, session),
            EventKind::Data { station, group, session, generated_ns } => {
                self.data(now_ns, station, group, session, generated_ns)
            }
            EventKind::Verdict { safe: true, sessions } => self.safe(sessions),
            EventKind::Verdict { safe: false, sessions: _ } => self.fall_back(now_ns),
        };
        actions.sort_by_key(|action| action.place());
        actions
    }

    /// Where the group runs. `spec/2-offloading.md#requester`.
    pub fn state(&self, group: Group) -> GroupState {
        match *self.group(group) {
            Use::Local => GroupState::Local,
            Use::Requested { station, session, deadline_ns } => {
                GroupState::Requested { station, session, deadline_ns }
            }
            Use::Remote(Session { station, number: session, .. }) => {
                GroupState::Remote { station, session }
            }
        }
    }

    /// The running sessions of those of the groups that are remote: what a cycle names that used
    /// their data. `spec/5-interfaces.md#offloading-trace`.
    pub fn sessions(&self, groups: Groups) -> Sessions {
        let session = |group: Group| match self.state(group) {
            GroupState::Remote { session, .. } if groups.contains(group) => Some(session),
            GroupState::Local | GroupState::Requested { .. } | GroupState::Remote { .. } => None,
        };
        Sessions { mot: session(Group::Mot), plan: session(Group::Plan) }
    }

    /// Whose results of the group may reach control: the local services while they compute, else
    /// the remote station. `spec/1-services.md#configuration`.
    pub fn source(&self, group: Group) -> Source {
        match *self.group(group) {
            Use::Remote(Session { station, local_computes: false, .. }) => {
                Source::Remote { station }
            }
            Use::Local | Use::Requested { .. } | Use::Remote(_) => Source::Local,
        }
    }

    /// The configuration in which the next cycle is to be checked: a group counts as remote from
    /// the confirmation on, also while its local services still compute (H-08).
    /// `spec/1-services.md#configuration`.
    pub fn configuration(&self) -> Configuration {
        let remote = |group: &Group| matches!(self.state(*group), GroupState::Remote { .. });
        Configuration::of_remote(Group::ALL.into_iter().filter(remote).collect())
    }

    /// When offloading is possible again after the last hold, ns; `None` before the first hold,
    /// and the last value once it has passed. `spec/2-offloading.md#fallback`.
    pub fn hold_until_ns(&self) -> Option<i64> {
        self.hold_until_ns
    }

    /// Number of elements that belonged to no running session; saturates.
    /// `spec/2-offloading.md#requester`.
    pub fn foreign_data(&self) -> u64 {
        self.foreign_data.0
    }

    /// Whether the state is one that the rules allow: what every reachable state satisfies.
    /// `spec/2-offloading.md`.
    pub fn is_valid(&self) -> bool {
        let sessions: Vec<i64> = Group::ALL
            .iter()
            .filter_map(|group| self.group(*group).partner())
            .map(|p| p.1)
            .collect();
        let numbered =
            |session: &i64| (self.first_session + 1..=self.last_session).contains(session);
        let asked: BTreeSet<&i64> = self.last_asked.values().collect();
        Group::ALL.iter().all(|group| self.is_group_valid(*group))
            && sessions.iter().all(numbered)
            && (sessions.len() < 2 || sessions[0] != sessions[1])
            && asked.iter().all(|session| numbered(session))
            && asked.len() == self.last_asked.len()
            && (0..=self.last_session).contains(&self.first_session)
            && (self.last_session == self.first_session || asked.contains(&self.last_session))
    }

    /// Whoever is asked or runs the group offers it, in the area, and was the last to be asked;
    /// local services stand still only as the profile allows.
    fn is_group_valid(&self, group: Group) -> bool {
        let Some((station, session)) = self.group(group).partner() else { return true };
        let asked_last =
            self.last_asked.iter().filter(|((g, _), _)| *g == group).max_by_key(|(_, s)| **s);
        let local_services_right = match self.group(group) {
            Use::Remote(running) if self.profile.has(HardenedRule::H08) => {
                running.local_computes || running.last_used_generated_ns.is_some()
            }
            Use::Remote(running) => !running.local_computes,
            Use::Local | Use::Requested { .. } => true,
        };
        self.offers.get(&station).is_some_and(|groups| groups.contains(group))
            && self.area.contains(group)
            && asked_last == Some((&(group, station), &session))
            && local_services_right
    }

    fn group(&self, group: Group) -> &Use {
        match group {
            Group::Mot => &self.mot,
            Group::Plan => &self.plan,
        }
    }

    fn group_mut(&mut self, group: Group) -> &mut Use {
        match group {
            Group::Mot => &mut self.mot,
            Group::Plan => &mut self.plan,
        }
    }
}
