//! The vehicle: requester and monitor on a drive that is played in real time.
//!
//! It has no clock and waits for nothing: [`Vehicle::step`] is told the time, takes what has arrived,
//! and does what is due. A period has two moments. When a cycle is *sensed* the vehicle sends its state,
//! its detections and signs of life; 30 ms later it is *decided*, with what has come until then.

pub mod log;
pub mod memory;
pub mod summary;

use std::collections::BTreeMap;
use std::time::{Duration, Instant};

use mufasa::input::cycle::{Grid, Track, Trajectory, TrajectoryPoint};
use mufasa::monitor::{
    Accepted, Arrival, Decision, Gap, GridMap, Inputs, Message as Received, Monitor, MonitorError,
    Settings, Time, Verified,
};
use mufasa::offloading::requester::{Action, Actions, GroupState, RequesterError, Source};
use mufasa::report::InvalidInput;
use mufasa::services::configuration::{Configuration, Group, Groups};
use mufasa_model::input::cycle::{Cycle, Route};
use mufasa_props::bridge;
use mufasa_records::names;

use self::log::{What, digest};
use self::memory::Lent;
use self::summary::Tally;
use crate::message::{self, EncodeError, Frame, Message, Payload};
use crate::play::{Played, moved};
use crate::transport::{Address, Transport};

/// How long before its first decision a vehicle begins, ns.
const BEFORE_THE_FIRST_NS: i64 = 100_000_000;

/// When the program is so late to sense a cycle, ns, the world waits for it: what the drive holds would be
/// older than its stamps say it was.
const PAUSED_AFTER_NS: i64 = 20_000_000;

/// A station of which nothing was heard for so long is lost, ns: its offers come twice a second.
const LOST_AFTER_NS: i64 = 3_000_000_000;

/// Messages that are taken in one step at most, so that a flood keeps no cycle from being decided.
const AT_ONCE: usize = 64;

/// Why a vehicle cannot drive.
#[derive(Debug)]
pub enum VehicleError {
    /// The settings of the monitor.
    Monitor(MonitorError),
    /// The route of a cycle.
    Route(InvalidInput),
    /// The drive is too far from the origin of its frame.
    Frame(EncodeError),
}

impl std::fmt::Display for VehicleError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Monitor(error) => error.fmt(f),
            Self::Route(error) => error.fmt(f),
            Self::Frame(error) => error.fmt(f),
        }
    }
}

impl std::error::Error for VehicleError {}

/// A vehicle on a drive, from its start to its end.
#[derive(Debug)]
pub struct Vehicle<'a, T> {
    id: i64,
    played: &'a Played,
    frame: Frame,
    transport: &'a mut T,
    tally: &'a mut Tally,
    monitor: Monitor<'a>,
    /// When the first cycle is decided, on the shared clock, ns.
    begin_ns: i64,
    next: usize,
    is_sensed: bool,
    route: Option<Route>,
    tracks: Option<Accepted<Vec<Track>>>,
    trajectory: Option<Accepted<Vec<TrajectoryPoint>>>,
    /// When each station that offers something was heard last, ns.
    heard: BTreeMap<i64, i64>,
}

impl<'a, T: Transport> Vehicle<'a, T> {
    /// A vehicle that begins now. `id`: its station id, 1 to 4294967295. Its sessions are numbered on
    /// from the time, so that none is one of an earlier life.
    ///
    /// Errors: settings that no monitor can keep.
    pub fn new(
        id: i64,
        now_ns: i64,
        played: &'a Played,
        settings: Settings,
        lent: &'a mut Lent,
        transport: &'a mut T,
        tally: &'a mut Tally,
    ) -> Result<Self, VehicleError> {
        let settings = Settings { sessions_before: now_ns.max(0), ..settings };
        let monitor = Monitor::new(settings, lent.memory()).map_err(VehicleError::Monitor)?;
        let frame = played.frame().map_err(VehicleError::Frame)?;
        tally.began(now_ns);
        Ok(Self {
            id,
            played,
            frame,
            transport,
            tally,
            monitor,
            begin_ns: whole_milliseconds(now_ns.saturating_add(BEFORE_THE_FIRST_NS)),
            next: 0,
            is_sensed: false,
            route: None,
            tracks: None,
            trajectory: None,
            heard: BTreeMap::new(),
        })
    }

    /// Takes what has arrived, and does what is due. Returns when something is due next, ns; `None` at
    /// the end of the drive, when it has left its sessions.
    ///
    /// Errors: a route that the monitor cannot keep.
    pub fn step(&mut self, now_ns: i64) -> Result<Option<i64>, VehicleError> {
        for _ in 0..AT_ONCE {
            let Some(bytes) = self.transport.receive(now_ns) else { break };
            self.take(now_ns, &bytes);
        }
        let played = self.played;
        let Some(cycle) = played.cycle(self.next) else { return Ok(None) };
        let mut later_ns = self.begin_ns.saturating_sub(played.begin_ns());
        let mut sensed_ns = Played::sensed_ns(cycle).saturating_add(later_ns);
        if !self.is_sensed && now_ns.saturating_sub(sensed_ns) > PAUSED_AFTER_NS {
            let pause_ns = whole_milliseconds(now_ns.saturating_sub(sensed_ns));
            self.begin_ns = self.begin_ns.saturating_add(pause_ns);
            (later_ns, sensed_ns) =
                (later_ns.saturating_add(pause_ns), sensed_ns.saturating_add(pause_ns));
            self.tally.paused();
        }
        let decided_ns = cycle.now_ns.saturating_add(later_ns);
        if !self.is_sensed && now_ns >= sensed_ns {
            self.is_sensed = true;
            self.tell(now_ns, sensed_ns, cycle, later_ns);
        }
        if now_ns < decided_ns {
            return Ok(Some(if self.is_sensed { decided_ns } else { sensed_ns }));
        }
        self.tick(now_ns);
        self.decide(now_ns, cycle, later_ns)?;
        self.next += 1;
        self.is_sensed = false;
        if self.next < played.count() {
            return Ok(Some(now_ns));
        }
        self.leave(now_ns);
        Ok(None)
    }

    /// Leaves its sessions. To be called when it ends before the drive does.
    pub fn leave(&mut self, now_ns: i64) {
        let before = self.states();
        let actions = self.monitor.area(time(now_ns), Groups::NONE);
        self.answered(now_ns, before, Ok(actions), "end");
        self.tally.health(self.transport.health());
    }

    /// Waits until something arrives, at most so long.
    pub fn wait(&mut self, at_most: Duration) {
        self.transport.wait(at_most);
    }

    /// Which groups are remote.
    pub fn configuration(&self) -> Configuration {
        self.monitor.configuration()
    }

    /// Sends what the vehicle knows, and a sign of life for each session.
    fn tell(&mut self, now_ns: i64, sensed_ns: i64, cycle: &Cycle, later_ns: i64) {
        for (group, state) in Group::ALL.into_iter().zip(self.states()) {
            if let GroupState::Remote { station, session } = state {
                self.send(now_ns, station, Payload::Alive { group, session });
            }
        }
        let ego = Played::sensed(cycle);
        let mut stations = self.states().map(|state| match state {
            GroupState::Remote { station, .. } => Some(station),
            GroupState::Local | GroupState::Requested { .. } => None,
        });
        if stations[0] == stations[1] {
            stations[1] = None;
        }
        let owned = bridge::to_impl(cycle);
        let detections = owned.borrow(&[]).detections;
        for station in stations.into_iter().flatten() {
            self.send(now_ns, station, Payload::State { stamp_ns: sensed_ns, ego });
            if let Some(list) = detections {
                let stamp_ns = list.stamp_ns.saturating_add(later_ns);
                let detections = list.items.to_vec();
                self.send(now_ns, station, Payload::Detections { stamp_ns, ego, detections });
            }
        }
    }

    fn send(&mut self, now_ns: i64, station: i64, payload: Payload) {
        let message = Message { sender: self.id, receiver: station, generated_ns: now_ns, payload };
        match message::encode(&message, &self.frame) {
            Ok(bytes) => {
                self.tally.sent(&message.payload);
                self.transport.send(now_ns, Address::Station(station), bytes);
            }
            Err(error) => self.tally.unsent(&message.payload, &error),
        }
    }

    /// Takes a message; whatever it is, nothing worse happens than that it is counted.
    fn take(&mut self, now_ns: i64, bytes: &[u8]) {
        let message = match message::decode(bytes, &self.frame) {
            Ok(message) => message,
            Err(error) => return self.tally.malformed(&error),
        };
        let Message { sender: station, receiver, generated_ns, payload } = message;
        if receiver != self.id && receiver != 0 {
            return self.tally.dropped("for another");
        }
        self.tally.received(&payload);
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
            | Payload::Detections { .. } => self.tally.dropped("of a vehicle"),
        }
    }

    /// What became of a result: it is kept to be checked, or it is gone.
    fn arrived<L>(
        &mut self,
        now_ns: i64,
        before: [GroupState; 2],
        came: &Came,
        digest: u64,
        arrival: Result<Arrival<L>, RequesterError>,
    ) -> Option<Accepted<L>> {
        let Came { group, station, session, generated_ns } = *came;
        let latency_ns = now_ns.saturating_sub(generated_ns);
        let accepted = matches!(arrival, Ok(Arrival::Accepted(_)));
        let what =
            What::Arrived { group: word(group), station, session, latency_ns, accepted, digest };
        self.tally.note(now_ns, what);
        match arrival {
            Ok(Arrival::Accepted(element)) => {
                self.tally.accepted(group, latency_ns);
                return Some(element);
            }
            Ok(Arrival::Dropped(actions)) => self.answered(now_ns, before, Ok(actions), "late"),
            Err(error) => self.answered(now_ns, before, Err(error), "late"),
        }
        None
    }

    /// Decides what time alone decides.
    fn tick(&mut self, now_ns: i64) {
        let lost: Vec<i64> = (self.heard.iter())
            .filter(|(_, heard_ns)| now_ns.saturating_sub(**heard_ns) > LOST_AFTER_NS)
            .map(|(station, _)| *station)
            .collect();
        for station in lost {
            self.heard.remove(&station);
            let before = self.states();
            let answer = self.monitor.lost(time(now_ns), station);
            self.answered(now_ns, before, answer, "lost");
        }
        let before = self.states();
        let actions = self.monitor.tick(time(now_ns));
        self.answered(now_ns, before, Ok(actions), "silent");
    }

    /// Decides a cycle, and lets control have what it may have.
    fn decide(&mut self, now_ns: i64, cycle: &Cycle, later_ns: i64) -> Result<(), VehicleError> {
        let later = |stamp_ns: i64| time(stamp_ns.saturating_add(later_ns));
        let owned = bridge::to_impl(cycle);
        let known = owned.borrow(&[]);
        if self.route.as_ref() != Some(&cycle.route) {
            self.monitor.set_route(&known.route).map_err(VehicleError::Route)?;
            self.route = Some(cycle.route.clone());
        }
        let points = known.trajectory.map(|it| moved(it, later_ns));
        let mut inputs = Inputs::new(time(now_ns), known.ego);
        if let Some(list) = known.detections {
            inputs = inputs.detections(later(list.stamp_ns), list.items);
        }
        if let Some(lead) = known.lead {
            inputs = inputs.lead(later(lead.stamp_ns), Gap::between_bumpers(lead.gap), lead.speed);
        }
        if let Some(grid) = known.grid {
            inputs = inputs.grid(later(grid.stamp_ns), grid_map(&grid));
        }
        if let Some(list) = known.tracks {
            inputs = inputs.local_tracks(later(list.stamp_ns), list.items);
        }
        if let (Some(trajectory), Some(points)) = (known.trajectory, &points) {
            inputs = inputs.local_trajectory(later(trajectory.stamp_ns), points);
        }
        if let Some(tracks) = &self.tracks {
            inputs = inputs.remote_tracks(tracks);
        }
        if let Some(trajectory) = &self.trajectory {
            inputs = inputs.remote_trajectory(trajectory);
        }
        let before = self.states();
        let configuration = self.monitor.configuration();
        let begun = Instant::now();
        let decision = self.monitor.cycle(&inputs);
        let took = begun.elapsed();
        let (report, actions) = match &decision {
            Decision::Safe { report, actions, .. } => (Ok(*report), *actions),
            Decision::Unsafe { report, actions } => (*report, *actions),
        };
        let is_safe = matches!(decision, Decision::Safe { .. });
        self.tally.decided(now_ns, self.next, configuration, is_safe, &report, took);
        if let Decision::Safe { tracks, trajectory, .. } = decision {
            let follow = |it: &Verified<'_, Trajectory<'_>>| digest(it.stamp_ns, it.points);
            let used = [
                tracks.map(|it| (Group::Mot, it.source(), digest(it.stamp_ns, it.items))),
                trajectory.map(|it| (Group::Plan, it.source(), follow(&it))),
            ];
            let remote = |(group, source, digest)| match source {
                Source::Remote { station } => {
                    Some(What::Used { group: word(group), station, digest })
                }
                Source::Local => None,
            };
            let used = used.into_iter().flatten().filter_map(remote).collect();
            self.tally.used(now_ns, self.played.period_ns(), used);
        }
        self.answered(now_ns, before, Ok(actions), "unsafe");
        Ok(())
    }

    /// Does what the requester wants; `why` a session has ended, if one has. `before`: the states of the
    /// groups before.
    fn answered(
        &mut self,
        now_ns: i64,
        before: [GroupState; 2],
        answer: Result<Actions, RequesterError>,
        why: &'static str,
    ) {
        let actions = match answer {
            Ok(actions) => actions,
            Err(RequesterError::TableFull { .. }) => {
                return self.tally.dropped("too many stations");
            }
            Err(RequesterError::Station { .. } | RequesterError::NegativeParameter { .. }) => {
                return self.tally.dropped("no station");
            }
        };
        for ((group, before), after) in Group::ALL.into_iter().zip(before).zip(self.states()) {
            if session(before).is_some() && session(before) != session(after) {
                let is_asked = matches!(before, GroupState::Requested { .. });
                let why = if is_asked && why == "silent" { "not confirmed" } else { why };
                self.tally.left(why);
                self.tally.note(now_ns, What::Left { group: word(group) });
            }
        }
        for action in &actions {
            match *action {
                Action::Request { station, group, session } => {
                    let what = What::Requested { group: word(group), station, session };
                    self.tally.note(now_ns, what);
                    self.send(now_ns, station, Payload::Request { group, session });
                }
                Action::Release { station, group, session } => {
                    self.send(now_ns, station, Payload::Release { group, session });
                }
                // The drive holds what the local services would say, whether they compute or not.
                Action::Activate(_) => self.tally.local_services("started"),
                Action::Deactivate(_) => self.tally.local_services("stopped"),
                Action::Drop(Group::Mot) => self.tally.dropped("tracks"),
                Action::Drop(Group::Plan) => self.tally.dropped("trajectory"),
            }
        }
    }

    fn states(&self) -> [GroupState; 2] {
        Group::ALL.map(|group| self.monitor.requester().state(group))
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

fn session(state: GroupState) -> Option<(i64, i64)> {
    match state {
        GroupState::Local => None,
        GroupState::Requested { station, session, .. }
        | GroupState::Remote { station, session } => Some((station, session)),
    }
}

fn grid_map<'c>(grid: &Grid<'c>) -> GridMap<'c> {
    let Grid { stamp_ns: _, x, y, cos, sin, resolution, width, height, occupied, unknown } = *grid;
    GridMap { x, y, cos, sin, resolution, width, height, occupied, unknown }
}

fn time(ns: i64) -> Time {
    Time::from_nanoseconds(ns)
}

fn word(group: Group) -> String {
    names::group(bridge::group_from_impl(group)).to_owned()
}

/// The next whole millisecond: times of measurement are sent in them.
fn whole_milliseconds(ns: i64) -> i64 {
    ns.saturating_add(999_999) / 1_000_000 * 1_000_000
}
