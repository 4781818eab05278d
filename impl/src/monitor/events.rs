//! The events of a monitor (`spec/2-offloading.md#requester`). Of each the actions have to be taken, in
//! their order.

use super::Monitor;
use super::arriving::Arriving;
use super::element::{Accepted, Arrival, Message};
use super::time::Time;
use crate::input::cycle::{Track, TrajectoryPoint};
use crate::input::profile::HardenedRule;
use crate::offloading::requester::{Actions, ByKind, Event, EventKind, Groups, RequesterError};
use crate::services::configuration::Group;

impl Monitor<'_> {
    /// A station offers groups; this replaces its previous offer.
    ///
    /// Errors: a station below 1; no place for it. Then nothing has changed, as below. Source:
    /// `spec/2-offloading.md#requester`.
    pub fn offer(
        &mut self,
        now: Time,
        station: i64,
        groups: Groups,
    ) -> Result<Actions, RequesterError> {
        self.step(now, EventKind::Offer { station, groups })
    }

    /// A station withdraws its offer.
    ///
    /// Errors: a station below 1. Source: `spec/2-offloading.md#requester`.
    pub fn withdraw(&mut self, now: Time, station: i64) -> Result<Actions, RequesterError> {
        self.step(now, EventKind::Withdraw { station })
    }

    /// A station can no longer be reached.
    ///
    /// Errors: a station below 1. Source: `spec/2-offloading.md#requester`.
    pub fn lost(&mut self, now: Time, station: i64) -> Result<Actions, RequesterError> {
        self.step(now, EventKind::Lost { station })
    }

    /// A station confirms a session.
    ///
    /// Errors: a station below 1. Source: `spec/2-offloading.md#requester`.
    pub fn confirm(
        &mut self,
        now: Time,
        station: i64,
        group: Group,
        session: i64,
    ) -> Result<Actions, RequesterError> {
        self.step(now, EventKind::Confirm { station, group, session })
    }

    /// A station rejects a session.
    ///
    /// Errors: a station below 1. Source: `spec/2-offloading.md#requester`.
    pub fn reject(
        &mut self,
        now: Time,
        station: i64,
        group: Group,
        session: i64,
    ) -> Result<Actions, RequesterError> {
        self.step(now, EventKind::Reject { station, group, session })
    }

    /// From now on these groups may be offloaded (CODM). Source: `spec/2-offloading.md#requester`.
    pub fn area(&mut self, now: Time, groups: Groups) -> Actions {
        //
        self.step_alone(now, EventKind::Area { groups })
    }

    /// Time passes: deadlines, silence and requests are decided. To be called in each period, and before
    /// the cycle of the period, which is unsafe without while something is remote. After a session no request is sent for a while, nor, in the hardened
    /// profile, before half a second was seen: [why](super). Source: `spec/2-offloading.md#requester`.
    pub fn tick(&mut self, now: Time) -> Actions {
        self.ticked = Some(now);
        if self.is_stalled() {
            let given_back = self.give_back(now);
            return given_back.and(&self.step_alone(now, EventKind::Tick));
        }
        self.step_alone(now, EventKind::Tick)
    }

    /// Tracks arrive. Used is what is of the running session of MOT, in time, newer than the last, and
    /// with a stamp at most `max_age_ns` old, while cycles find what is current; more tracks than `rows`
    /// were lent are dropped. The actions are those of a message that was dropped: a violation of quality of
    /// service ends the session, with releases and activations.
    ///
    /// Errors: a station below 1. Source: `spec/2-offloading.md#quality-of-service`.
    pub fn tracks<L: AsRef<[Track]>>(
        &mut self,
        now: Time,
        message: Message<L>,
    ) -> Result<(Arrival<L>, Actions), RequesterError> {
        // MON-20
        let is_too_long = message.items.as_ref().len() > self.rows.len();
        self.arrival(now, Group::Mot, message, is_too_long)
    }

    /// A trajectory arrives. Used is what is of the running session of PLAN, in time, newer than
    /// the last, and with a stamp at most `max_age_ns` old, while cycles find what is current; actions as
    /// of [`Self::tracks`]. What its
    /// points have to be like to be safe: [`Inputs::remote_trajectory`](super::Inputs::remote_trajectory).
    ///
    /// Errors: a station below 1. Source: `spec/2-offloading.md#quality-of-service`.
    pub fn trajectory<L: AsRef<[TrajectoryPoint]>>(
        &mut self,
        now: Time,
        message: Message<L>,
    ) -> Result<(Arrival<L>, Actions), RequesterError> {
        self.arrival(now, Group::Plan, message, false)
    }

    /// When planning was last given back because the CAV got nowhere (F-45): at a tick that names a release of PLAN.
    /// `None`: never. Source: `spec/monitor.md#monitor`.
    pub const fn given_back(&self) -> Option<Time> {
        // MON-59
        self.progress.given_back
    }

    /// Whether planning is remote and gets nowhere.
    fn is_stalled(&self) -> bool {
        // MON-54
        self.settings.stall.is_some_and(|stall| {
            u128::try_from(self.progress.remote_ns).is_ok_and(|it| it >= stall.time.as_nanos())
                && self.requester.session_of(Group::Plan).is_some()
        })
    }

    /// Gives planning back at a tick: as if PLAN had left the area for a moment.
    #[inline(never)]
    fn give_back(&mut self, now: Time) -> Actions {
        let area = self.requester.suspend().parts().area;
        let without = EventKind::Area { groups: Groups { plan: false, ..area } };
        // MON-57
        let left = self.step_alone(now, without);
        let back = self.step_alone(now, EventKind::Area { groups: area });
        let t_wait_ns = self.settings.requester.t_wait_ns;
        // MON-58
        self.requester.hold(now.as_nanoseconds().saturating_add(t_wait_ns));
        // MON-55, MON-59
        (self.progress.remote_ns, self.progress.given_back) = (0, Some(now));
        left.and(&back)
    }

    fn arrival<L>(
        &mut self,
        now: Time,
        group: Group,
        message: Message<L>,
        is_too_long: bool,
    ) -> Result<(Arrival<L>, Actions), RequesterError> {
        let Message { station, session, generated, stamp, items } = message;
        let Self { settings, requester, served, .. } = self;
        let [generated_ns, stamp_ns] = [generated, stamp].map(Time::as_nanoseconds);
        let element = Arriving { station, group, session, generated_ns, stamp_ns, is_too_long };
        let max_age_ns = settings.stages.max_age_ns;
        let period_ns = || settings.period_ns();
        let (why, by_kind) =
            served.receive(requester, now.as_nanoseconds(), &element, max_age_ns, period_ns)?;
        let arrival = match why {
            None => Arrival::Accepted(Accepted { station, session, generated, stamp, items }),
            Some(why) => Arrival::Dropped { why },
        };
        Ok((arrival, Actions::of(by_kind)))
    }

    pub(super) fn step(&mut self, now: Time, kind: EventKind) -> Result<Actions, RequesterError> {
        self.decide(now, kind).map(Actions::of)
    }

    /// An event that names no station, and can have no error.
    pub(super) fn step_alone(&mut self, now: Time, kind: EventKind) -> Actions {
        self.decide(now, kind).map_or(Actions::NONE, Actions::of)
    }

    fn decide(&mut self, now: Time, kind: EventKind) -> Result<ByKind, RequesterError> {
        let t_ns = now.as_nanoseconds();
        let looks = self.settings.profile.has(HardenedRule::H14);
        // MON-43
        let is_blind = looks && matches!(kind, EventKind::Tick) && !self.history.reaches_back(t_ns);
        let Self { settings, requester, served, .. } = self;
        served.step(requester, &Event { t_ns, kind }, is_blind, || settings.period_ns())
    }
}
