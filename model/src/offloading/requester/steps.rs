//! What the requester does when something happens (`spec/2-offloading.md#requester`,
//! `spec/2-offloading.md#fallback`).

use super::Requester;
use super::messages::{Action, Sessions};
use super::state::{Farewell, Session, Use};
use crate::input::profile::HardenedRule;
use crate::offloading::quality_of_service;
use crate::services::configuration::{Group, Groups};

/// The events. `spec/2-offloading.md#requester`.
impl Requester {
    pub(super) fn offer(&mut self, station: i64, groups: Groups) -> Vec<Action> {
        self.offers.insert(station, groups);
        self.leave_where(Farewell::Release, |group, partner| {
            partner == station && !groups.contains(group)
        })
    }

    pub(super) fn withdraw(&mut self, station: i64, farewell: Farewell) -> Vec<Action> {
        self.offers.remove(&station);
        self.leave_where(farewell, |_, partner| partner == station)
    }

    pub(super) fn area(&mut self, groups: Groups) -> Vec<Action> {
        self.area = groups;
        self.leave_where(Farewell::Release, |group, _| !groups.contains(group))
    }

    /// Overdue requests, then silent sessions, then requests.
    pub(super) fn tick(&mut self, now_ns: i64) -> Vec<Action> {
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

    pub(super) fn confirm(
        &mut self,
        now_ns: i64,
        station: i64,
        group: Group,
        session: i64,
    ) -> Vec<Action> {
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

    pub(super) fn reject(&mut self, station: i64, group: Group, session: i64) -> Vec<Action> {
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
    pub(super) fn data(
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

    /// H-08: the local services of a group stop only now, when the verdict names its running session.
    pub(super) fn safe(&mut self, sessions: Sessions) -> Vec<Action> {
        let mut actions = Vec::new();
        for group in Group::ALL {
            if let Use::Remote(running) = self.group_mut(group)
                && sessions.of(group) == Some(running.number)
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
    pub(super) fn fall_back(&mut self, now_ns: i64) -> Vec<Action> {
        self.hold(now_ns);
        self.leave_where(Farewell::Release, |_, _| true)
    }
}

/// The parts of the events.
impl Requester {
    /// A confirmed group becomes remote; without H-08 its local services stop.
    fn activate(&mut self, now_ns: i64, station: i64, group: Group, session: i64) -> Vec<Action> {
        let local_computes = self.profile.has(HardenedRule::H08);
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
        self.hold_at_least(now_ns.saturating_add(self.parameters.t_wait_ns));
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
        let session = self.last_session.checked_add(1)?; // MON-61
        self.last_session = session;
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
