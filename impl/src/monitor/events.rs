//! The events of a monitor (`spec/2-offloading.md#requester`). Of each the actions have to be taken, in
//! their order.

use super::Monitor;
use super::element::{Accepted, Arrival, DropReason, Message};
use super::served::Served;
use super::time::Time;
use crate::input::cycle::{Track, TrajectoryPoint};
use crate::input::profile::HardenedRule;
use crate::offloading::requester::{
    Action, Actions, Event, EventKind, GroupState, Groups, RequesterError,
};
use crate::services::configuration::Group;
use crate::stages::order::is_current;

/// Sessions are numbered from 1.
const NO_SESSION: i64 = 0;

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
        self.step(now, EventKind::Area { groups }).unwrap_or(Actions::NONE)
    }

    /// Time passes: deadlines, silence and requests are decided. To be called in each period, and before
    /// the cycle of the period, which is unsafe without while something is remote. After a session no request is sent for a while, nor, in the hardened
    /// profile, before half a second was seen: [why](super). Source: `spec/2-offloading.md#requester`.
    pub fn tick(&mut self, now: Time) -> Actions {
        self.ticked = Some(now);
        if self.is_stalled() {
            let given_back = self.give_back(now);
            return given_back.and(&self.step(now, EventKind::Tick).unwrap_or(Actions::NONE));
        }
        self.step(now, EventKind::Tick).unwrap_or(Actions::NONE)
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
        self.progress.given_back
    }

    /// Whether planning is remote and gets nowhere.
    fn is_stalled(&self) -> bool {
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
        let left = self.step(now, without).unwrap_or(Actions::NONE);
        let back = self.step(now, EventKind::Area { groups: area }).unwrap_or(Actions::NONE);
        let t_wait_ns = self.settings.requester.t_wait_ns;
        self.requester.hold(now.as_nanoseconds().saturating_add(t_wait_ns));
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
        let generated_ns = generated.as_nanoseconds();
        let [stamp_ns, now_ns] = [stamp, now].map(Time::as_nanoseconds);
        // What is in time, but so old that no cycle can use it any more, is of no session, so that it is
        // no arrival; nor is what no cycle could hold. What is stamped ahead may be for the next cycle, as
        // long as cycles use any.
        let is_in_time = is_current(generated_ns, now_ns, self.settings.requester.l_max_ns);
        let max_age_ns = self.settings.stages.max_age_ns;
        let is_too_old = stamp_ns < now_ns && !is_current(stamp_ns, now_ns, max_age_ns);
        let is_starved = self.served.get(group).is_starved();
        let is_no_arrival = is_too_long || (is_in_time && (is_too_old || is_starved));
        let named = if is_no_arrival { NO_SESSION } else { session };
        let running = self.requester.session_of(group);
        let is_running = running.is_some_and(|it| (it.station, it.session) == (station, session));
        let data = EventKind::Data { station, group, session: named, generated_ns };
        let actions = self.step(now, data)?;
        if !actions.contains(&Action::Drop(group)) {
            let element = Accepted { station, session, generated, stamp, items };
            return Ok((Arrival::Accepted(element), actions));
        }
        let why = if is_too_long {
            DropReason::TooLong
        } else if !is_running {
            DropReason::OtherSession
        } else if generated_ns > now_ns {
            DropReason::FromTheFuture
        } else if !is_in_time {
            DropReason::Late
        } else if is_too_old {
            DropReason::TooOld
        } else if is_starved {
            DropReason::Starved
        } else if self.requester.session_of(group).is_none() {
            DropReason::AfterSilence
        } else {
            DropReason::NotNewer
        };
        Ok((Arrival::Dropped { why }, actions))
    }

    pub(super) fn step(&mut self, now: Time, kind: EventKind) -> Result<Actions, RequesterError> {
        let t_ns = now.as_nanoseconds();
        if matches!(kind, EventKind::Tick) {
            let looks = self.settings.profile.has(HardenedRule::H14);
            if looks && !self.history.reaches_back(t_ns) {
                // Nothing would be examined as moving (H-14).
                self.requester.hold(t_ns.saturating_add(1));
            }
            for group in Group::ALL {
                // A hold that begins at a tick bars the requests of that tick.
                if self.requester.is_silent(group, t_ns) {
                    self.hold_after(group, t_ns);
                }
            }
        }
        let answer = self.requester.step(&Event { t_ns, kind });
        let goes_on = match (&answer, kind) {
            (Err(_), _) => true,
            (Ok(_), EventKind::Verdict { safe, .. }) => safe,
            (Ok(actions), EventKind::Tick) => actions.is_empty(),
            (Ok(_), _) => false,
        };
        if goes_on {
            // No session has begun, and none has ended, which would be a release.
            return answer;
        }
        for group in Group::ALL {
            let session = match self.requester.state(group) {
                GroupState::Local | GroupState::Requested { .. } => None,
                GroupState::Remote { session, .. } => Some(session),
            };
            let before = self.served.get(group).session();
            if session == before {
                continue;
            }
            if before.is_some() {
                self.hold_after(group, t_ns);
            }
            *self.served.get_mut(group) = Served::since(t_ns, session);
        }
        answer
    }

    /// The group returns to local now: its session may have been of no use for long, and the next one
    /// may be no better.
    fn hold_after(&mut self, group: Group, now_ns: i64) {
        if let Some(again_ns) = self.served.get(group).again_ns(now_ns, self.settings.period_ns()) {
            self.requester.hold(again_ns);
        }
    }
}
