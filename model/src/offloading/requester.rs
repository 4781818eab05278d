//! The requester: which groups run remotely, and every step between (`spec/2-offloading.md`).
//!
//! [`Requester::step`] is total: any event in any state, at any time, forwards or backwards.

mod inspect;
mod messages;
pub(crate) mod parameters;
mod state;

use std::collections::{BTreeMap, BTreeSet};

pub use crate::services::configuration::{Group, Groups};
pub use messages::{Action, Event, EventKind, GroupState};
pub use parameters::Parameters;
pub use state::Session;

use crate::input::profile::Profile;
use crate::offloading::quality_of_service;
use crate::services::configuration::{Configuration, Source};
use state::{Count, Use};

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
    /// Number of the last request; 0 before the first.
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
            last_session: 0,
            last_asked: BTreeMap::new(),
            foreign_data: Count(0),
        }
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
            EventKind::Verdict { safe: true, groups } => self.safe(groups),
            EventKind::Verdict { safe: false, groups: _ } => self.fall_back(now_ns),
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
        let numbered = |session: &i64| (1..=self.last_session).contains(session);
        let asked: BTreeSet<&i64> = self.last_asked.values().collect();
        Group::ALL.iter().all(|group| self.is_group_valid(*group))
            && sessions.iter().all(numbered)
            && (sessions.len() < 2 || sessions[0] != sessions[1])
            && asked.iter().all(|session| numbered(session))
            && asked.len() == self.last_asked.len()
            && self.last_session >= 0
            && (self.last_session == 0 || asked.contains(&self.last_session))
    }

    /// Whoever is asked or runs the group offers it, in the area, and was the last to be asked;
    /// local services stand still only as the profile allows.
    fn is_group_valid(&self, group: Group) -> bool {
        let Some((station, session)) = self.group(group).partner() else { return true };
        let asked_last =
            self.last_asked.iter().filter(|((g, _), _)| *g == group).max_by_key(|(_, s)| **s);
        let local_services_right = match (self.group(group), self.profile) {
            (Use::Remote(running), Profile::Paper) => !running.local_computes,
            (Use::Remote(running), Profile::Hardened) => {
                running.local_computes || running.last_used_generated_ns.is_some()
            }
            (Use::Local | Use::Requested { .. }, _) => true,
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

/// The events. `spec/2-offloading.md#requester`.
impl Requester {
    fn offer(&mut self, station: i64, groups: Groups) -> Vec<Action> {
        self.offers.insert(station, groups);
        self.leave_where(Farewell::Release, |group, partner| {
            partner == station && !groups.contains(group)
        })
    }

    fn withdraw(&mut self, station: i64, farewell: Farewell) -> Vec<Action> {
        self.offers.remove(&station);
        self.leave_where(farewell, |_, partner| partner == station)
    }

    fn area(&mut self, groups: Groups) -> Vec<Action> {
        self.area = groups;
        self.leave_where(Farewell::Release, |group, _| !groups.contains(group))
    }

    /// Overdue requests, then silent sessions, then requests.
    fn tick(&mut self, now_ns: i64) -> Vec<Action> {
        let mut actions = Vec::new();
        let mut returned = Groups::NONE;
        for group in Group::ALL {
            if self.is_overdue(group, now_ns) {
                actions.extend(self.leave(group, Farewell::Release));
                returned.insert(group);
            }
        }
        for group in Group::ALL {
            if self.is_silent(group, now_ns) {
                actions.extend(self.violation(group, now_ns));
                returned.insert(group);
            }
        }
        for group in Group::ALL {
            if !returned.contains(group) {
                actions.extend(self.request(group, now_ns));
            }
        }
        actions
    }

    fn confirm(&mut self, now_ns: i64, station: i64, group: Group, session: i64) -> Vec<Action> {
        match *self.group(group) {
            Use::Requested { station: asked, session: requested, deadline_ns }
                if (station, session) == (asked, requested) && now_ns < deadline_ns =>
            {
                self.activate(now_ns, station, group, session)
            }
            Use::Remote(running) if (station, session) == (running.station, running.number) => {
                Vec::new()
            }
            Use::Local | Use::Requested { .. } | Use::Remote(_) => {
                vec![Action::Release { station, group, session }]
            }
        }
    }

    fn reject(&mut self, station: i64, group: Group, session: i64) -> Vec<Action> {
        match *self.group(group) {
            Use::Requested { station: asked, session: requested, .. }
                if (station, session) == (asked, requested) =>
            {
                self.leave(group, Farewell::Silent)
            }
            Use::Local | Use::Requested { .. } | Use::Remote(_) => Vec::new(),
        }
    }

    /// `spec/2-offloading.md#quality-of-service`.
    fn data(
        &mut self,
        now_ns: i64,
        station: i64,
        group: Group,
        session: i64,
        generated_ns: i64,
    ) -> Vec<Action> {
        let parameters = self.parameters;
        let mut actions = Vec::new();
        match self.group_mut(group) {
            Use::Remote(running) if (station, session) == (running.station, running.number) => {
                let previous_ns = running.last_arrival_ns;
                running.last_arrival_ns = now_ns;
                if quality_of_service::is_violation(&parameters, now_ns, previous_ns, generated_ns)
                {
                    actions.push(Action::Drop(group));
                    actions.extend(self.violation(group, now_ns));
                } else if quality_of_service::is_in_order(
                    generated_ns,
                    running.last_used_generated_ns,
                ) {
                    running.last_used_generated_ns = Some(generated_ns);
                } else {
                    actions.push(Action::Drop(group));
                }
            }
            Use::Local | Use::Requested { .. } | Use::Remote(_) => {
                self.foreign_data.0 = self.foreign_data.0.saturating_add(1);
                actions.push(Action::Drop(group));
            }
        }
        actions
    }

    /// H-08: the local services stop only now.
    fn safe(&mut self, groups: Groups) -> Vec<Action> {
        let mut actions = Vec::new();
        for group in Group::ALL.into_iter().filter(|group| groups.contains(*group)) {
            if let Use::Remote(running) = self.group_mut(group)
                && running.local_computes
                && running.last_used_generated_ns.is_some()
            {
                running.local_computes = false;
                actions.push(Action::Deactivate(group));
            }
        }
        actions
    }

    /// `spec/2-offloading.md#fallback`.
    fn fall_back(&mut self, now_ns: i64) -> Vec<Action> {
        self.hold(now_ns);
        self.leave_where(Farewell::Release, |_, _| true)
    }
}

/// The parts of the events.
impl Requester {
    /// A confirmed group becomes remote; in the paper profile its local services stop.
    fn activate(&mut self, now_ns: i64, station: i64, group: Group, session: i64) -> Vec<Action> {
        let local_computes = match self.profile {
            Profile::Paper => false,
            Profile::Hardened => true,
        };
        *self.group_mut(group) = Use::Remote(Session {
            station,
            number: session,
            last_arrival_ns: now_ns,
            last_used_generated_ns: None,
            local_computes,
        });
        if local_computes { Vec::new() } else { vec![Action::Deactivate(group)] }
    }

    /// Returns every requested or remote group to local whose group and station the rule names.
    fn leave_where(
        &mut self,
        farewell: Farewell,
        rule: impl Fn(Group, i64) -> bool,
    ) -> Vec<Action> {
        let mut actions = Vec::new();
        for group in Group::ALL {
            if self.group(group).partner().is_some_and(|(station, _)| rule(group, station)) {
                actions.extend(self.leave(group, farewell));
            }
        }
        actions
    }

    /// Returns the group to local: the local services start unless they never stopped.
    fn leave(&mut self, group: Group, farewell: Farewell) -> Vec<Action> {
        let left = std::mem::replace(self.group_mut(group), Use::Local);
        let mut actions = Vec::new();
        if let (Some((station, session)), Farewell::Release) = (left.partner(), farewell) {
            actions.push(Action::Release { station, group, session });
        }
        if let Use::Remote(Session { local_computes: false, .. }) = left {
            actions.push(Action::Activate(group));
        }
        actions
    }

    /// A violation of quality of service returns this group and no other.
    fn violation(&mut self, group: Group, now_ns: i64) -> Vec<Action> {
        if self.parameters.qos_hold {
            self.hold(now_ns);
        }
        self.leave(group, Farewell::Release)
    }

    /// `hold_until` becomes the later of its old value and now + `t_wait`.
    fn hold(&mut self, now_ns: i64) {
        let until_ns = now_ns.saturating_add(self.parameters.t_wait_ns);
        self.hold_until_ns = Some(self.hold_until_ns.map_or(until_ns, |old| old.max(until_ns)));
    }

    fn is_overdue(&self, group: Group, now_ns: i64) -> bool {
        match *self.group(group) {
            Use::Requested { deadline_ns, .. } => now_ns >= deadline_ns,
            Use::Local | Use::Remote(_) => false,
        }
    }

    fn is_silent(&self, group: Group, now_ns: i64) -> bool {
        match self.group(group) {
            Use::Remote(running) => {
                quality_of_service::is_silent(&self.parameters, now_ns, running.last_arrival_ns)
            }
            Use::Local | Use::Requested { .. } => false,
        }
    }

    /// Sends a request for a local group, when one is allowed and somebody offers the group.
    fn request(&mut self, group: Group, now_ns: i64) -> Option<Action> {
        let held = self.hold_until_ns.is_some_and(|until_ns| now_ns < until_ns);
        if *self.group(group) != Use::Local || !self.area.contains(group) || held {
            return None;
        }
        let station = self.next_station(group)?;
        self.last_session += 1;
        let session = self.last_session;
        let deadline_ns = now_ns.saturating_add(self.parameters.request_timeout_ns);
        *self.group_mut(group) = Use::Requested { station, session, deadline_ns };
        self.last_asked.insert((group, station), session);
        Some(Action::Request { station, group, session })
    }

    /// Of the stations that offer the group: one never asked for it, the smallest id first; then
    /// the one whose last request for it is the oldest.
    fn next_station(&self, group: Group) -> Option<i64> {
        self.offers
            .iter()
            .filter(|(_, groups)| groups.contains(group))
            .map(|(station, _)| *station)
            .min_by_key(|station| (self.last_asked.get(&(group, *station)), *station))
    }
}

/// Whether who is left is told.
#[derive(Clone, Copy)]
enum Farewell {
    Release,
    Silent,
}
