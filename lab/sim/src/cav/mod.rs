//! The CAV: sensors, its own services, what guards the link, and control.

pub mod asking;
mod assembled;
pub mod calls;
pub mod decided;
pub mod guard;
pub mod local;
pub mod recorder;
pub mod sensing;

use mufasa::input::cycle::{
    CrossSection, Detection, Track, TrackList, Trajectory, TrajectoryPoint,
};
use mufasa::monitor::{Message as Received, Time};
use mufasa::offloading::requester::{Action, EventKind, GroupState, RequesterError};
use mufasa::services::configuration::{Configuration, Group, Groups};
use mufasa_link::message::{self, Frame, Message, Payload};
use mufasa_link::vehicle::tell::Measured;
use mufasa_records::calls::Follows;

use self::asking::{Asking, Known};
use self::guard::{Decided, Guard, Results};
use self::local::Services;
use self::sensing::{Sensed, Sensors, ego};
use crate::ids;
use crate::map::Town;
use crate::map::route::Route;
use crate::planner::{Road, slower};
use crate::radio::{Radio, To};
use crate::services::control::Controller;
use crate::settings::Settings;
use crate::snapshot::Snapshot;
use crate::time::seconds;
use crate::vehicle::{Body, Command};

/// A cycle is decided so long after its measurements, ns.
pub const DECIDES_NS: i64 = 40_000_000;

/// What the CAV counts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counts {
    /// Messages of the link that could not be read.
    pub malformed: u64,
    /// Messages that were not used.
    pub dropped: u64,
    /// Sessions that ended for another reason than a verdict.
    pub ended: u64,
}

/// The CAV on its route.
#[derive(Debug)]
pub struct Cav<'a> {
    town: &'a Town,
    route: &'a Route,
    body: Body,
    frame: Frame,
    settings: &'a Settings,
    sensors: Sensors,
    services: Services,
    guard: Guard<'a>,
    controller: Controller,
    sensed: Option<Sensed>,
    /// Remote tracks that the last safe cycle let the CAV's own planner have.
    tracks: Option<(i64, Vec<Track>)>,
    /// Its own tracks of the last cycle, if MOT ran.
    own: Option<(i64, Vec<Track>)>,
    /// Those of the present measurements, where the station got them before the cycle is decided.
    tracked: Option<(i64, Vec<Track>)>,
    /// What control follows.
    points: Vec<TrajectoryPoint>,
    /// The same in words.
    follows: Follows,
    /// By when it brakes along it where nothing newer has come, ns (F-47); of a plan of its own (F-61).
    brake_by_ns: Option<i64>,
    own_by_ns: i64,
    /// How many of its own plans were examined (`Settings::supervise_local`), and how many of them failed.
    examined: [u64; 2],
    /// What its planner asks before it hands a plan over in `MotRemote`, if it asks.
    asking: Option<Asking<'a>>,
    /// What the CAV counts.
    pub counts: Counts,
}

impl<'a> Cav<'a> {
    /// At the start of its route, whose cross sections are given, with everything local.
    pub fn new(
        (town, route): (&'a Town, &'a Route),
        body: Body,
        frame: Frame,
        settings: &'a Settings,
        cross_sections: &[CrossSection],
        guard: Guard<'a>,
    ) -> Self {
        Self {
            town,
            route,
            body,
            frame,
            settings,
            sensors: Sensors::new(settings.seed, &body, settings.errors),
            services: Services::default(),
            guard,
            controller: Controller::new(body),
            sensed: None,
            tracks: None,
            own: None,
            tracked: None,
            points: Vec::new(),
            follows: Follows::OwnPlan,
            brake_by_ns: None,
            own_by_ns: i64::MAX,
            examined: [0; 2],
            asking: Asking::new(settings, cross_sections),
            counts: Counts::default(),
        }
    }

    /// How many of its own plans were examined, and how many of them failed.
    pub fn examined(&self) -> [u64; 2] {
        self.examined
    }

    /// What guards the link.
    pub fn guard(&self) -> &Guard<'a> {
        &self.guard
    }

    /// Its own services.
    pub fn services(&self) -> &Services {
        &self.services
    }

    /// What control follows.
    pub fn points(&self) -> &[TrajectoryPoint] {
        &self.points
    }

    /// The tracks that it has, and whether they came over the link. None: neither did safe ones come nor
    /// does its own MOT run.
    pub fn tracks(&self) -> Option<(bool, &[Track])> {
        let remote = self.tracks.as_ref().map(|(_, tracks)| (true, tracks.as_slice()));
        remote.or_else(|| self.own.as_ref().map(|(_, tracks)| (false, tracks.as_slice())))
    }

    /// What it measured last.
    pub fn sensed(&self) -> Option<&Sensed> {
        self.sensed.as_ref()
    }

    /// Measures, and tells the stations that compute for it.
    pub fn sense(&mut self, now_ns: i64, truth: &Snapshot, radio: &mut Radio) {
        let mut sensed = self.sensors.sense(truth, self.route, &self.body, now_ns);
        sensed.lead = sensed.lead.filter(|_| !self.settings.has_no_lead);
        let states = Group::ALL.map(|group| self.guard.state(group));
        if states.iter().any(|it| matches!(it, GroupState::Remote { .. })) {
            let measured = Measured {
                stamp_ns: now_ns,
                ego: sensed.ego,
                detections: Some((now_ns, sensed.detections.clone())),
                tracks: self.compared_tracks(now_ns, &sensed.detections),
            };
            for (station, payload) in measured.told(states) {
                self.send(now_ns, station, payload, radio);
            }
        }
        self.sensed = Some(sensed);
        let is_in = |(from, to): (f64, f64)| (from..=to).contains(&truth.ego.s);
        let groups =
            Group::ALL.into_iter().zip(self.settings.areas).filter(|(_, area)| is_in(*area));
        let groups: Vec<Group> = groups.map(|(group, _)| group).collect();
        self.happens(now_ns, EventKind::Area { groups: Groups::of(&groups) }, radio);
    }

    /// In `PlanRemote` the station gets the CAV's own tracks, with which stage iii will compare its plan.
    fn compared_tracks(
        &mut self,
        now_ns: i64,
        detections: &[Detection],
    ) -> Option<(i64, Vec<Track>)> {
        if self.asking.is_none() || self.guard.configuration() != Configuration::PlanRemote {
            return None;
        }
        let tracks = (now_ns, self.services.track(now_ns, detections)?);
        self.tracked = Some(tracks.clone());
        Some(tracks)
    }

    /// Takes a message that was decoded.
    pub fn take(&mut self, now_ns: i64, message: Message, radio: &mut Radio) {
        let Message { sender: station, receiver, generated_ns, payload } = message;
        if receiver != ids::CAV && receiver != 0 {
            self.counts.dropped += 1;
            return;
        }
        let time = Time::from_nanoseconds;
        let generated = time(generated_ns);
        let Self { guard, counts, .. } = self;
        let answer = match payload {
            Payload::Offer { groups } => {
                guard.happens(now_ns, EventKind::Offer { station, groups })
            }
            Payload::Withdraw => guard.happens(now_ns, EventKind::Withdraw { station }),
            Payload::Confirm { group, session } => {
                guard.happens(now_ns, EventKind::Confirm { station, group, session })
            }
            Payload::Reject { group, session } => {
                guard.happens(now_ns, EventKind::Reject { station, group, session })
            }
            Payload::Tracks { session, stamp_ns, tracks: items } => {
                let stamp = time(stamp_ns);
                guard.tracks(now_ns, Received { station, session, generated, stamp, items })
            }
            Payload::Trajectory { session, stamp_ns, points: items } => {
                let stamp = time(stamp_ns);
                guard.trajectory(now_ns, Received { station, session, generated, stamp, items })
            }
            Payload::Request { .. }
            | Payload::Release { .. }
            | Payload::Alive { .. }
            | Payload::State { .. }
            | Payload::Detections { .. } => {
                counts.dropped += 1;
                Ok(Vec::new())
            }
        };
        self.answered(now_ns, answer, radio);
    }

    /// Decides a cycle; none before anything was measured.
    pub fn decide(&mut self, now_ns: i64, truth: &Snapshot, radio: &mut Radio) -> Option<Decided> {
        self.happens(now_ns, EventKind::Tick, radio);
        let sensed = self.sensed.take()?;
        let ego = ego(truth, &self.body);
        let services = &mut self.services;
        let tracked = self.tracked.take().filter(|it| it.0 == sensed.stamp_ns);
        let own = match tracked.filter(|_| services.run(Group::Mot)) {
            Some((_, tracks)) => Some(tracks),
            None => services.track(sensed.stamp_ns, &sensed.detections),
        };
        let stamp_ns = sensed.stamp_ns;
        let own = own.as_deref().map(|items| TrackList { stamp_ns, items });
        // MON-67
        let is_remote = self.guard.configuration().is_remote(Group::Mot);
        let remote = self.tracks.as_ref().filter(|_| is_remote);
        let remote = remote.map(|(stamp_ns, items)| TrackList { stamp_ns: *stamp_ns, items });
        let list = remote.or(own).unwrap_or(TrackList { stamp_ns: now_ns, items: &[] });
        let (near_s, signals) = (Some(truth.ego.s), &*truth.closed_signals());
        let road = Road { town: self.town, route: self.route, near_s, signals };
        let services = &mut self.services;
        let points = services.plan(now_ns, &ego, &road, &list);
        let (asking, guard) = (&mut self.asking, &self.guard);
        let points = points.map(|plan| match asking {
            Some(asking) if guard.configuration() == Configuration::MotRemote => {
                let known = Known::of(Configuration::MotRemote, (now_ns, ego), &sensed);
                let tracks = guard.remote_tracks();
                let all = [plan.clone()].into_iter().chain(slower(now_ns, &ego, &road, &list));
                // Where none passes its own is turned down, and driven once everything is local.
                asking.first(&known, tracks, now_ns, all).unwrap_or(plan)
            }
            Some(_) | None => plan,
        });
        let trajectory = points.as_deref().map(|points| Trajectory { stamp_ns: now_ns, points });
        let local = Results { tracks: own, trajectory };
        let is_own = self.is_own();
        let guard = &mut self.guard;
        let mut decided = guard.decide(now_ns, ego, &sensed, local);
        self.tracks = decided.tracks.take();
        self.own = own.map(|list| (stamp_ns, list.items.to_vec()));
        self.act(now_ns, &decided.actions, radio);
        let is_own = is_own && decided.report.is_some();
        // No cycle covers its own plan, which takes the place of whatever it had.
        let brake_by_ns = decided.brake_by_ns.filter(|_| !is_own);
        let new = if is_own { points } else { decided.trajectory.take() };
        let is_supervised =
            self.settings.supervise_local.is_some_and(|from| seconds(now_ns) >= from);
        let brakes = is_supervised && decided.brake.is_some();
        let examined = [is_supervised && is_own && new.is_some(), brakes];
        self.examined.iter_mut().zip(examined).for_each(|(count, it)| *count += u64::from(it));
        if brakes {
            // Without points control brakes along those that it had.
            self.points = Vec::new();
            self.follows = Follows::Brakes;
        } else if let Some(points) = new {
            let released = self.guard.released().filter(|_| !is_own);
            self.follows = released.map_or(Follows::OwnPlan, Follows::Verified);
            self.points = points;
            self.brake_by_ns = brake_by_ns;
            if is_own {
                self.own_by_ns = self.settings.brake_by(now_ns);
            }
        }
        if let Some(asking) = &mut self.asking {
            asking.see(stamp_ns, &sensed.detections);
        }
        self.sensed = Some(sensed);
        Some(decided)
    }

    /// What control wants now.
    pub fn command(&mut self, now_ns: i64, truth: &Snapshot) -> Command {
        let ego = ego(truth, &self.body);
        // MON-42
        let has_ended = self.brake_by_ns.unwrap_or(self.own_by_ns) <= now_ns;
        // Without points it brakes along those that it had.
        let drives_on = !has_ended || self.settings.drives_on;
        self.guard.control(now_ns, if drives_on { self.follows } else { Follows::Brakes });
        self.controller.command(&ego, if drives_on { &self.points } else { &[] }, now_ns)
    }

    /// By when control brakes along what came out of a cycle, ns; none: it follows a plan of its own.
    pub fn brake_by_ns(&self) -> Option<i64> {
        self.brake_by_ns
    }

    /// Whether the CAV follows plans of its own that did not come out of a cycle.
    fn is_own(&self) -> bool {
        // MON-67
        self.guard.configuration() == Configuration::Local
    }

    fn happens(&mut self, now_ns: i64, kind: EventKind, radio: &mut Radio) {
        let answer = self.guard.happens(now_ns, kind);
        self.answered(now_ns, answer, radio);
    }

    fn answered(
        &mut self,
        now_ns: i64,
        answer: Result<Vec<Action>, RequesterError>,
        radio: &mut Radio,
    ) {
        match answer {
            Ok(actions) => self.act(now_ns, &actions, radio),
            Err(_) => self.counts.dropped += 1,
        }
    }

    fn act(&mut self, now_ns: i64, actions: &[Action], radio: &mut Radio) {
        for action in actions {
            match *action {
                Action::Request { station, group, session } => {
                    self.send(now_ns, station, Payload::Request { group, session }, radio);
                }
                Action::Release { station, group, session } => {
                    self.counts.ended += 1;
                    self.send(now_ns, station, Payload::Release { group, session }, radio);
                }
                Action::Activate(group) => self.services.start(group),
                Action::Deactivate(group) => self.services.stop(group),
                Action::Drop(_) => self.counts.dropped += 1,
            }
        }
    }

    fn send(&mut self, now_ns: i64, station: i64, payload: Payload, radio: &mut Radio) {
        let message =
            Message { sender: ids::CAV, receiver: station, generated_ns: now_ns, payload };
        match message::encode(&message, &self.frame) {
            Ok(bytes) => radio.send(now_ns, To::Station, bytes),
            Err(_) => self.counts.malformed += 1,
        }
    }
}
