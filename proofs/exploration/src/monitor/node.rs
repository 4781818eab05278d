//! The exact monitor in a period, and when two are alike.
//!
//! Two monitors with the same [`Likeness`] do the same in every period, because the monitor compares times
//! by differences alone, and sessions for equality with the running one:
//!
//! * An arrival, an element or a stamp older than the limit that it is compared with stays so. So ages are
//!   kept up to one period beyond the limit.
//! * A hold that is over stays over. A list of detections older than 1 s is not looked at.
//! * The time of use lowers the wait after a session by as much, until nothing is left of nine times the
//!   longest time without use that a session can have. Above that it is kept as that.

use mufasa_model::input::cycle::{DetectionList, Ego, TrackList, Trajectory, TrajectoryPoint};
use mufasa_model::input::profile::Profile;
use mufasa_model::monitor::Monitor;
use mufasa_model::monitor::messages::{Answer, Event, EventKind, Measured};
use mufasa_model::offloading::requester::{Group, GroupState, Groups};
use mufasa_model::report::{FailedStage, Outcome, Reading, Report, Stage};

use super::observer::{Observer, Shown};
use super::period::{DT_MAX, L_MAX, LONGEST, MAX_AGE, PERIOD_NS, Period, Sent, route, settings};
use crate::fit::fitted;

/// The only station.
const STATION: i64 = 1;
/// Ages of lists of detections that are looked at, periods.
const KEPT: i64 = 10;
/// No session has this number.
const NO_SESSION: i64 = 1 << 40;

/// A monitor between two periods, and the observer beside it.
#[derive(Clone, Debug)]
pub struct Node {
    monitor: Monitor,
    profile: Profile,
    group: Group,
    now_ns: i64,
    observer: Observer,
}

/// What decides how a monitor reacts. Ages in periods, at most one more than their limit.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Likeness {
    group: Use,
    hold_left: i8,
    offered: bool,
    /// Since when nothing was of use, for how long something was, whether the group is starved.
    used: Option<(i8, i8, bool)>,
    stamp_age: Option<i8>,
    /// A bit for each age of a list that is kept.
    kept: u16,
    observer: Observer,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
enum Use {
    Local,
    Requested { left: i8 },
    Remote { silent: i8, used: Option<i8>, local_computes: bool },
}

impl Node {
    /// A monitor at its start, which has heard the station's offer.
    pub fn new(profile: Profile, group: Group) -> Self {
        let monitor = Monitor::new(settings(profile), route(), Reading::Exact);
        let monitor = monitor.unwrap_or_else(|it| unreachable!("settings of {}", it.field));
        let mut node = Self { monitor, profile, group, now_ns: 0, observer: Observer::default() };
        node.tell(
            EventKind::Offer { station: STATION, groups: [group].into_iter().collect() },
            true,
        );
        node
    }

    /// The node after a period, and what it shows; `None` where the period is another one in this state.
    pub fn after(&self, period: Period) -> Option<(Self, Shown)> {
        let requester = self.monitor.requester();
        let is_asked = matches!(requester.state(self.group), GroupState::Requested { .. });
        let last = requester.session_of(self.group).and_then(|it| it.last_used_generated_ns);
        if (!period.confirms && !is_asked) || (period.sent == Sent::Repeated && last.is_none()) {
            return None;
        }
        let mut next = self.clone();
        let mut shown = Shown::default();
        if period.withdraws {
            let groups = [self.group].into_iter().collect();
            let events = [
                EventKind::Withdraw { station: STATION },
                EventKind::Offer { station: STATION, groups },
            ];
            for event in events {
                let answer = next.tell(event, true);
                next.observer.follow(&answer, self.group, &mut shown);
            }
        }
        if let GroupState::Requested { station, session, .. } =
            next.monitor.requester().state(self.group)
            && period.confirms
        {
            let answer =
                next.tell(EventKind::Confirm { station, group: self.group, session }, true);
            next.observer.confirmed(&answer, self.group, session);
        }
        if let Some((stamp_ns, message)) = next.message(period.sent, last) {
            let answer = next.tell(message, true);
            next.observer.arrived(&answer, stamp_ns - next.now_ns, &mut shown);
            next.observer.follow(&answer, self.group, &mut shown);
        }
        if period.ticks {
            let answer = next.tell(EventKind::Tick, true);
            next.observer.follow(&answer, self.group, &mut shown);
        }
        let measured = Box::new(next.measured());
        let answer = next.tell(EventKind::Cycle { measured }, period.safe);
        let profile = next.profile;
        next.observer.decided(&answer, (next.now_ns, profile), self.group, period, &mut shown);
        next.observer.follow(&answer, self.group, &mut shown);
        next.now_ns += PERIOD_NS;
        next.observer.time_passes(&mut shown);
        Some((next, shown))
    }

    /// What decides how it goes on.
    pub fn likeness(&self) -> Likeness {
        let requester = self.monitor.requester();
        let age = |t_ns: i64, most: i64| short(((self.now_ns - t_ns) / PERIOD_NS).min(most + 1));
        let group = match requester.state(self.group) {
            GroupState::Local => Use::Local,
            GroupState::Requested { deadline_ns, .. } => {
                Use::Requested { left: short((deadline_ns - self.now_ns).max(0) / PERIOD_NS) }
            }
            GroupState::Remote { .. } => {
                let session = requester.session_of(self.group).expect("a remote group has one");
                Use::Remote {
                    silent: age(session.last_arrival_ns, DT_MAX),
                    used: session.last_used_generated_ns.map(|it| age(it, L_MAX)),
                    local_computes: session.local_computes,
                }
            }
        };
        let hold = requester.hold_until_ns().map_or(0, |it| (it - self.now_ns).max(0));
        let used = self.monitor.use_of(self.group).map(|it| {
            let of_use = it.first_ns.map_or(0, |first_ns| (it.since_ns - first_ns) / PERIOD_NS);
            (age(it.since_ns, LONGEST), short(of_use.min(9 * LONGEST)), it.starved)
        });
        let kept = |t_ns: i64| {
            let age = (self.now_ns - t_ns) / PERIOD_NS;
            if age > KEPT { 0 } else { 1 << age }
        };
        Likeness {
            group,
            hold_left: short(hold.div_euclid(PERIOD_NS) + i64::from(hold % PERIOD_NS > 0)),
            offered: requester.offered(STATION) != Groups::NONE,
            used,
            stamp_age: self.monitor.stamp_ns(self.group).map(|it| age(it, MAX_AGE)),
            kept: self.monitor.kept_ns().map(kept).sum(),
            observer: self.observer.alike(),
        }
    }

    fn tell(&mut self, kind: EventKind, safe: bool) -> Answer {
        self.monitor.step_judged(Event { t_ns: self.now_ns, kind }, &|_| Ok(verdict(safe)))
    }

    /// The message, with its stamp.
    fn message(&self, sent: Sent, last_ns: Option<i64>) -> Option<(i64, EventKind)> {
        let now = self.now_ns;
        let (generated_ns, stamp_ns) = match sent {
            Sent::Nothing => return None,
            Sent::Honest | Sent::OtherSession => (now, now),
            Sent::Late => (now - (L_MAX + 1) * PERIOD_NS, now),
            Sent::JustInTime => (now - L_MAX * PERIOD_NS, now - L_MAX * PERIOD_NS),
            Sent::Stale => (now, now - (MAX_AGE + 1) * PERIOD_NS),
            Sent::Ahead => (now, now + PERIOD_NS),
            Sent::Repeated => (last_ns?, now),
        };
        let running = self.monitor.requester().session_of(self.group).map(|it| it.number);
        let session = running.filter(|_| sent != Sent::OtherSession).unwrap_or(NO_SESSION);
        let station = STATION;
        let kind = match self.group {
            Group::Mot => {
                let tracks = TrackList { stamp_ns, items: Vec::new() };
                EventKind::Tracks { station, session, generated_ns, tracks }
            }
            Group::Plan => {
                let trajectory = trajectory(stamp_ns);
                EventKind::Trajectory { station, session, generated_ns, trajectory }
            }
        };
        Some((stamp_ns, kind))
    }

    fn measured(&self) -> Measured {
        let stamp_ns = self.now_ns;
        Measured {
            ego: Ego {
                x: 0.0,
                y: 0.0,
                cos: 1.0,
                sin: 0.0,
                speed: 10.0,
                length: 4.0,
                width: 2.0,
                center_offset: 1.0,
            },
            trajectory: Some(trajectory(stamp_ns)),
            tracks: Some(TrackList { stamp_ns, items: Vec::new() }),
            detections: Some(DetectionList { stamp_ns, items: Vec::new() }),
            lead: None,
            grid: None,
        }
    }
}

fn trajectory(stamp_ns: i64) -> Trajectory {
    let point = TrajectoryPoint { t_ns: stamp_ns, x: 0.0, y: 0.0, cos: 1.0, sin: 0.0 };
    Trajectory { stamp_ns, points: vec![point] }
}

/// What the adversary makes the stages say, also in `Local`, where invalid input is unsafe.
fn verdict(safe: bool) -> Report {
    let failed_stage = (!safe).then_some(FailedStage::Stage(Stage::Ii));
    Report { failed_stage, stages: [const { Outcome::Passed }; 5], input: None }
}

fn short(periods: i64) -> i8 {
    fitted(periods)
}
