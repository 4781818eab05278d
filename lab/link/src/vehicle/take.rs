//! What a vehicle does with what it receives.

use mufasa::monitor::{Accepted, Arrival, DropReason, Message as Received};
use mufasa::offloading::requester::{Actions, GroupState, RequesterError};
use mufasa::services::configuration::Group;

use super::log::{What, digest};
use super::{Vehicle, time, word};
use crate::message::{Message, Payload};
use crate::transport::Transport;

impl<T: Transport> Vehicle<'_, T> {
    /// Takes a message; whatever it is, nothing worse happens than that it is counted.
    pub(super) fn take(&mut self, now_ns: i64, message: Message) {
        let Message { sender: station, receiver, generated_ns, payload } = message;
        if receiver != self.id && receiver != 0 {
            return self.tally.traffic().dropped("for another");
        }
        self.tally.traffic().received(&payload);
        let before = self.states();
        let now = time(now_ns);
        let came = |group, session| Came { group, station, session, generated_ns };
        match payload {
            Payload::Offer { groups } => {
                let answer = self.monitor.offer(now, station, groups);
                if answer.is_ok() {
                    self.heard.insert(station, now_ns);
                }
                self.answered(now_ns, before, answer, "offer");
            }
            Payload::Withdraw => {
                self.heard.remove(&station);
                let answer = self.monitor.withdraw(now, station);
                self.answered(now_ns, before, answer, "withdrawn");
            }
            Payload::Confirm { group, session } => {
                self.tally.note(now_ns, What::Confirmed { group: word(group), station, session });
                let answer = self.monitor.confirm(now, station, group, session);
                self.answered(now_ns, before, answer, "confirmed");
            }
            Payload::Reject { group, session } => {
                let answer = self.monitor.reject(now, station, group, session);
                self.answered(now_ns, before, answer, "rejected");
            }
            Payload::Tracks { session, stamp_ns, tracks } => {
                let came = came(Group::Mot, session);
                let digest = digest(stamp_ns, &tracks);
                let arrival = self.monitor.tracks(now, came.with(stamp_ns, tracks));
                self.tracks =
                    self.arrived(now_ns, before, &came, digest, arrival).or(self.tracks.take());
            }
            Payload::Trajectory { session, stamp_ns, points } => {
                let came = came(Group::Plan, session);
                let digest = digest(stamp_ns, &points);
                let arrival = self.monitor.trajectory(now, came.with(stamp_ns, points));
                self.trajectory =
                    self.arrived(now_ns, before, &came, digest, arrival).or(self.trajectory.take());
            }
            Payload::Request { .. }
            | Payload::Release { .. }
            | Payload::Alive { .. }
            | Payload::State { .. }
            | Payload::Detections { .. } => self.tally.traffic().dropped("of a vehicle"),
        }
    }

    /// What became of a result: it is kept to be checked, or it is gone.
    fn arrived<L>(
        &mut self,
        now_ns: i64,
        before: [GroupState; 2],
        came: &Came,
        digest: u64,
        arrival: Result<(Arrival<L>, Actions), RequesterError>,
    ) -> Option<Accepted<L>> {
        let Came { group, station, session, generated_ns } = *came;
        let latency_ns = now_ns.saturating_sub(generated_ns);
        let accepted = matches!(arrival, Ok((Arrival::Accepted(_), _)));
        let what =
            What::Arrived { group: word(group), station, session, latency_ns, accepted, digest };
        self.tally.note(now_ns, what);
        match arrival {
            Ok((Arrival::Accepted(element), actions)) => {
                self.answered(now_ns, before, Ok(actions), "accepted");
                self.tally.accepted(group, latency_ns);
                return Some(element);
            }
            Ok((Arrival::Dropped { why }, actions)) => {
                let what = match group {
                    Group::Mot => "tracks",
                    Group::Plan => "trajectory",
                };
                self.tally.traffic().dropped(&format!("{what}: {why}"));
                self.answered(now_ns, before, Ok(actions), left_for(why));
            }
            // It names no station, and has changed nothing.
            Err(error) => self.answered(now_ns, before, Err(error), "no station"),
        }
        None
    }
}

/// Why a session ended with a result that is of no use; most of them end none.
const fn left_for(why: DropReason) -> &'static str {
    match why {
        DropReason::Late => "late",
        DropReason::FromTheFuture => "from the future",
        DropReason::AfterSilence => "silent",
        DropReason::TooLong
        | DropReason::OtherSession
        | DropReason::TooOld
        | DropReason::Starved
        | DropReason::NotNewer => "of no use",
    }
}

/// A result that came.
struct Came {
    group: Group,
    station: i64,
    session: i64,
    generated_ns: i64,
}

impl Came {
    fn with<T>(&self, stamp_ns: i64, items: Vec<T>) -> Received<Vec<T>> {
        let Self { station, session, generated_ns, .. } = *self;
        Received { station, session, generated: time(generated_ns), stamp: time(stamp_ns), items }
    }
}
