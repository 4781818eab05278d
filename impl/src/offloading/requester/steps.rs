//! What each event does (`spec/2-offloading.md`).

use super::event::{Action, Actions, ByKind, Event, EventKind, Outbox, Sessions};
use super::slot::Slot;
use super::{Requester, RequesterError};
use crate::offloading::quality_of_service::{Arrivals, Element};
use crate::services::configuration::{Group, Groups};

/// Whether the station hears that its session has ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Farewell {
    Release,
    Silent,
}

impl Requester<'_> {
    /// Takes one event and says what has to be done about it, in this order.
    ///
    /// Errors: a station below 1; an offer that the table has no place for. Then nothing has
    /// changed. Source: `spec/2-offloading.md`.
    pub fn step(&mut self, event: &Event) -> Result<Actions, RequesterError> {
        self.decide(event).map(Actions::of)
    }

    /// Bars requests until a time: `hold_until` becomes the later of its old value and this one, in ns.
    /// What is requested or remote stays so. To be called before a tick that is not to send them any more.
    /// Source: `spec/2-offloading.md#fallback`, `spec/monitor.md#monitor`.
    pub const fn hold(&mut self, until_ns: i64) {
        // FALL-08, MON-38, MON-39
        self.hold_until_ns = match self.hold_until_ns {
            Some(old_ns) if old_ns > until_ns => Some(old_ns),
            Some(_) | None => Some(until_ns),
        };
    }

    /// Takes one event and says what has to be done about it, kind by kind.
    pub(crate) fn decide(&mut self, event: &Event) -> Result<ByKind, RequesterError> {
        if let Some(station) = event.kind.station().filter(|&station| station < 1) {
            return Err(RequesterError::Station { station });
        }
        let mut out = Outbox::default();
        let now_ns = event.t_ns;
        match event.kind {
            EventKind::Offer { station, groups } => {
                self.offer(station, groups, Farewell::Release, &mut out)?;
            }
            // REQ-22, REQ-23, REQ-25
            EventKind::Withdraw { station } => {
                self.offer(station, Groups::NONE, Farewell::Release, &mut out)?;
            }
            // REQ-24, REQ-25
            EventKind::Lost { station } => {
                self.offer(station, Groups::NONE, Farewell::Silent, &mut out)?;
            }
            EventKind::Area { groups } => self.set_area(groups, &mut out),
            EventKind::Tick => self.tick(now_ns, &mut out),
            EventKind::Confirm { station, group, session } => {
                self.confirm(now_ns, station, group, session, &mut out);
            }
            EventKind::Reject { station, group, session } => self.reject(station, group, session),
            EventKind::Data { station, group, session, generated_ns } => {
                self.data(now_ns, (station, group, session), generated_ns, &mut out);
            }
            EventKind::Verdict { safe: true, sessions } => self.safe(sessions, &mut out),
            EventKind::Verdict { safe: false, .. } => self.fall_back(now_ns, &mut out),
        }
        Ok(out.by_kind())
    }

    /// From now on `station` offers `groups` and nothing else; what is in use beyond that is left.
    fn offer(
        &mut self,
        station: i64,
        groups: Groups,
        farewell: Farewell,
        out: &mut Outbox,
    ) -> Result<(), RequesterError> {
        // REQ-01, REQ-22
        if !self.stations.set_offer(station, groups) {
            let capacity = self.stations.records().len();
            return Err(RequesterError::TableFull { station, capacity });
        }
        for group in Group::ALL {
            let used = self.slots.get(group).in_use();
            // REQ-02, REQ-23
            if !groups.contains(group) && used.is_some_and(|(used, _)| used == station) {
                self.leave(group, farewell, out);
            }
        }
        Ok(())
    }

    fn set_area(&mut self, groups: Groups, out: &mut Outbox) {
        // REQ-18
        self.area = groups;
        for group in Group::ALL {
            // REQ-19
            if !groups.contains(group) {
                self.leave(group, Farewell::Release, out);
            }
        }
    }

    /// First every group is judged, then requests are sent: a hold that starts now bars them, and a
    /// group that returns now waits for the next tick.
    fn tick(&mut self, now_ns: i64, out: &mut Outbox) {
        // FALL-12
        let limits = self.parameters.limits();
        let mut waiting = Groups::NONE;
        for group in Group::ALL {
            match *self.slots.get(group) {
                // REQ-05
                Slot::Local => waiting = waiting.with(group),
                // REQ-14
                Slot::Requested { deadline_ns, .. } if now_ns >= deadline_ns => {
                    self.leave(group, Farewell::Release, out);
                }
                // QOS-04
                Slot::Remote { arrivals, .. } if arrivals.silence(now_ns, limits).is_some() => {
                    self.violate(group, now_ns, out);
                }
                Slot::Requested { .. } | Slot::Remote { .. } => {}
            }
        }
        for group in Group::ALL {
            // REQ-03, REQ-04, REQ-06
            if waiting.contains(group) && self.may_request(group, now_ns) {
                self.request(group, now_ns, out);
            }
        }
    }

    fn confirm(&mut self, now_ns: i64, station: i64, group: Group, session: i64, out: &mut Outbox) {
        let profile = self.profile;
        let slot = self.slots.get_mut(group);
        let names_it = slot.in_use() == Some((station, session));
        match *slot {
            Slot::Requested { deadline_ns, .. } if names_it && now_ns < deadline_ns => {
                // REQ-10
                *slot = Slot::activated(profile, now_ns, station, session);
                // CONF-02
                if !slot.local_computes() {
                    *out.services.get_mut(group) = Some(Action::Deactivate(group));
                }
            }
            // REQ-11
            Slot::Remote { .. } if names_it => {}
            Slot::Local | Slot::Requested { .. } | Slot::Remote { .. } => {
                // REQ-12, REQ-13
                let release = Action::Release { station, group, session };
                *out.releases.get_mut(group) = Some(release);
            }
        }
    }

    fn reject(&mut self, station: i64, group: Group, session: i64) {
        let slot = self.slots.get_mut(group);
        let names_it = slot.in_use() == Some((station, session));
        // REQ-16
        if names_it && matches!(slot, Slot::Requested { .. }) {
            // REQ-15
            *slot = Slot::Local;
        }
    }

    fn data(
        &mut self,
        now_ns: i64,
        (station, group, session): (i64, Group, i64),
        generated_ns: i64,
        out: &mut Outbox,
    ) {
        let limits = self.parameters.limits();
        // REQ-20
        let Some(arrivals) = self.running(station, group, session) else {
            // REQ-21
            let dropped = self.dropped.get_mut(group);
            *dropped = dropped.saturating_add(1);
            *out.drops.get_mut(group) = Some(Action::Drop(group));
            return;
        };
        match arrivals.arrive(now_ns, generated_ns, limits) {
            Element::Used => {}
            Element::Stale => *out.drops.get_mut(group) = Some(Action::Drop(group)),
            // QOS-07
            Element::Violating(_) => {
                *out.drops.get_mut(group) = Some(Action::Drop(group));
                self.violate(group, now_ns, out);
            }
        }
    }

    /// H-08: the first safe verdict that names the running session of a group after a used result
    /// stops its local services. In the paper profile they were stopped at the confirmation.
    fn safe(&mut self, sessions: Sessions, out: &mut Outbox) {
        for group in Group::ALL {
            if let Slot::Remote { session, arrivals, local_computes, .. } =
                self.slots.get_mut(group)
            {
                let is_named = sessions.of(group) == Some(*session);
                // CONF-03
                // H-08.1
                if is_named && *local_computes && arrivals.has_used() {
                    *local_computes = false;
                    *out.services.get_mut(group) = Some(Action::Deactivate(group));
                }
            }
        }
    }

    fn fall_back(&mut self, now_ns: i64, out: &mut Outbox) {
        // I-10
        for group in Group::ALL {
            // FALL-01, FALL-02
            self.leave(group, Farewell::Release, out);
        }
        // FALL-04
        self.wait(now_ns);
    }

    /// The arrivals of the running session, if this is the one.
    fn running(&mut self, station: i64, group: Group, session: i64) -> Option<&mut Arrivals> {
        match self.slots.get_mut(group) {
            Slot::Remote { station: running, session: number, arrivals, .. }
                if (*running, *number) == (station, session) =>
            {
                Some(arrivals)
            }
            Slot::Local | Slot::Requested { .. } | Slot::Remote { .. } => None,
        }
    }

    fn may_request(&self, group: Group, now_ns: i64) -> bool {
        // REQ-03, FALL-05, I-08
        self.area.contains(group)
            && self.hold_until_ns.is_none_or(|hold_until_ns| now_ns >= hold_until_ns)
    }

    /// Asks the station whose turn it is; nobody without an offer or without a number left.
    fn request(&mut self, group: Group, now_ns: i64, out: &mut Outbox) {
        // MON-61
        let Some(session) = self.sessions.checked_add(1) else { return };
        let Some(station) = self.stations.next_for(group) else { return };
        self.sessions = session;
        self.stations.asked(station, group, session);
        // FALL-09
        let deadline_ns = now_ns.saturating_add(self.parameters.request_timeout_ns);
        *self.slots.get_mut(group) = Slot::Requested { station, session, deadline_ns };
        *out.requests.get_mut(group) = Some(Action::Request { station, group, session });
    }

    /// A violation of quality of service.
    fn violate(&mut self, group: Group, now_ns: i64, out: &mut Outbox) {
        // QOS-06
        self.leave(group, Farewell::Release, out);
        // FALL-06, FALL-07
        if self.parameters.qos_hold {
            self.wait(now_ns);
        }
    }

    /// Returns a group to local; nothing happens when it is local already.
    fn leave(&mut self, group: Group, farewell: Farewell, out: &mut Outbox) {
        let left = core::mem::replace(self.slots.get_mut(group), Slot::Local);
        match (left.in_use(), farewell) {
            (Some((station, session)), Farewell::Release) => {
                let release = Action::Release { station, group, session };
                *out.releases.get_mut(group) = Some(release);
            }
            (Some(_), Farewell::Silent) | (None, _) => {}
        }
        // H-08.3; A-11
        if !left.local_computes() {
            *out.services.get_mut(group) = Some(Action::Activate(group));
        }
    }

    /// Bars requests for `t_wait`, and never for less long than before.
    const fn wait(&mut self, now_ns: i64) {
        // FALL-04, FALL-09
        self.hold(now_ns.saturating_add(self.parameters.t_wait_ns));
    }
}
