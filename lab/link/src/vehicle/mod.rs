//! The vehicle: requester and monitor on a drive that is played in real time.
//!
//! It has no clock and waits for nothing: [`Vehicle::step`] is told the time, takes what has arrived,
//! and does what is due. A period has two moments. When a cycle is *sensed* the vehicle sends its state,
//! its detections and signs of life; 60 ms later, where the period is long enough, it is *decided*, with what
//! has come until then: all that needed no longer than l_max.

mod decide;
pub mod log;
pub mod memory;
pub mod summary;
mod take;
pub mod tell;

use std::collections::BTreeMap;
use std::time::Duration;

use mufasa::input::cycle::{Track, TrackList, TrajectoryPoint};
use mufasa::monitor::{Accepted, Monitor, MonitorError, Settings, Time};
use mufasa::offloading::requester::{Action, Actions, GroupState, RequesterError};
use mufasa::report::InvalidInput;
use mufasa::services::configuration::{Configuration, Group, Groups};
use mufasa_model::input::cycle::{Cycle, Route};
use mufasa_props::bridge;
use mufasa_props::lent::Lent;
use mufasa_records::names;
use thiserror::Error;

use self::log::{Follows, What};
use self::memory::STATIONS_MAX;
use self::summary::Tally;
use self::tell::Measured;
use crate::message::{self, DecodeError, EncodeError, Frame, Message, Payload};
use crate::play::Played;
use crate::transport::{Address, Transport};

/// How long before its first decision a vehicle begins, ns.
const BEFORE_THE_FIRST_NS: i64 = 100_000_000;

/// When the program is so late to sense a cycle, ns, the world waits for it: what the drive holds would be
/// older than its stamps say it was.
const PAUSED_AFTER_NS: i64 = 20_000_000;

/// A station of which nothing was heard for so long is lost, ns: its offers come twice a second.
const LOST_AFTER_NS: i64 = 3_000_000_000;

/// What is told the monitor from one cycle to the next at most, so that a flood keeps no cycle from being decided in time:
/// with a message that was ahead, the stations that are lost and the tick the 64 events of IMPL-11.
const MESSAGES: usize = 64 - 2 - STATIONS_MAX;
/// The bytes behind which nothing is read until the next cycle: 64 of the longest messages would take 8 * 10^7
/// instructions to decode (docs/speed.md#messages). Each message counts as `HEAD` more, and one that is too long
/// as that alone: it is not decoded.
const BYTES: usize = 65_536;
const HEAD: usize = 128;

/// What was taken since the last cycle.
#[derive(Debug, Default)]
struct Taken {
    messages: usize,
    bytes: usize,
}

impl Taken {
    const fn is_enough(&self) -> bool {
        self.messages >= MESSAGES || self.bytes >= BYTES
    }
}

/// Why a vehicle cannot drive.
#[derive(Debug, Error)]
#[error(transparent)]
pub enum VehicleError {
    /// The settings of the monitor.
    Monitor(MonitorError),
    /// The route of a cycle.
    Route(InvalidInput),
    /// The drive is too far from the origin of its frame.
    Frame(EncodeError),
}

/// A vehicle on a drive, from its start to its end.
#[derive(Debug)]
pub struct Vehicle<'a, T> {
    id: i64,
    played: &'a Played,
    frame: Frame,
    transport: &'a mut T,
    tally: &'a mut Tally,
    monitor: Monitor<'a>,
    /// The time of the first cycle, on the shared clock, ns.
    begin_ns: i64,
    next: usize,
    is_sensed: bool,
    route: Option<Route>,
    tracks: Option<Accepted<Vec<Track>>>,
    trajectory: Option<Accepted<Vec<TrajectoryPoint>>>,
    /// When each station that offers something was heard last, ns.
    heard: BTreeMap<i64, i64>,
    /// A message that was made after the time of the step in which it came: it came while the step ran, and
    /// is taken in the next one. What is still ahead then is taken for what it is.
    ahead: Option<Message>,
    taken: Taken,
    /// What control follows, and which groups are remote; none before the first cycle.
    control: Option<(Configuration, Follows)>,
    /// Whether there is a connection, and how many there were; none before the first cycle.
    link: Option<(bool, u64)>,
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
            ahead: None,
            taken: Taken::default(),
            control: None,
            link: None,
        })
    }

    /// Takes what has arrived, and does what is due. Returns when something is due next, ns; `None` at
    /// the end of the drive, when it has left its sessions.
    ///
    /// Errors: a route that the monitor cannot keep.
    pub fn step(&mut self, now_ns: i64) -> Result<Option<i64>, VehicleError> {
        let due_ns = self.advance(now_ns)?;
        let ahead_ns = self.ahead.as_ref().map(|message| message.generated_ns);
        Ok(due_ns.map(|due_ns| ahead_ns.map_or(due_ns, |ahead_ns| due_ns.min(ahead_ns))))
    }

    fn advance(&mut self, now_ns: i64) -> Result<Option<i64>, VehicleError> {
        if let Some(message) = self.ahead.take() {
            self.take(now_ns, message);
        }
        while !self.taken.is_enough() {
            let Some(bytes) = self.transport.receive(now_ns) else { break };
            let read = message::decode(&bytes, &self.frame);
            let is_decoded = !matches!(read, Err(DecodeError::TooLong { .. }));
            self.taken.messages += usize::from(read.is_ok());
            self.taken.bytes += HEAD + if is_decoded { bytes.len() } else { 0 };
            match read {
                Err(error) => self.tally.traffic().malformed(&error),
                Ok(message) if message.generated_ns > now_ns => {
                    self.ahead = Some(message);
                    break;
                }
                Ok(message) => self.take(now_ns, message),
            }
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
        let decided_ns =
            cycle.now_ns.saturating_add(later_ns).saturating_add(played.decided_late_ns());
        if !self.is_sensed && now_ns >= sensed_ns {
            self.is_sensed = true;
            self.tell(now_ns, sensed_ns, cycle, later_ns);
        }
        if now_ns < decided_ns {
            return Ok(Some(if self.is_sensed { decided_ns } else { sensed_ns }));
        }
        self.look_at_link(now_ns);
        self.tick(now_ns);
        self.decide(now_ns, cycle, later_ns)?;
        self.taken = Taken::default();
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
        self.tally.traffic().health(self.transport.health());
    }

    /// Waits until something arrives, at most so long; all of it where nothing is taken any more.
    pub fn wait(&mut self, at_most: Duration) {
        if self.taken.is_enough() {
            std::thread::sleep(at_most);
        } else {
            self.transport.wait(at_most);
        }
    }

    /// Before when no station is asked, ns, if that ever was so.
    pub fn hold_until_ns(&self) -> Option<i64> {
        self.monitor.requester().hold_until_ns()
    }

    /// Which groups are remote.
    pub fn configuration(&self) -> Configuration {
        self.monitor.configuration()
    }

    /// Sends what the vehicle knows, and a sign of life for each session.
    fn tell(&mut self, now_ns: i64, sensed_ns: i64, cycle: &Cycle, later_ns: i64) {
        let owned = bridge::to_impl(cycle);
        let known = owned.borrow(&[]);
        let later = |stamp_ns: i64| stamp_ns.saturating_add(later_ns);
        let numbered = |list: TrackList<'_>| {
            let tracks = (0..).zip(list.items).map(|(id, track)| Track { id, ..*track });
            (later(list.stamp_ns), tracks.collect())
        };
        let measured = Measured {
            stamp_ns: sensed_ns,
            ego: Played::sensed(cycle),
            detections: known.detections.map(|list| (later(list.stamp_ns), list.items.to_vec())),
            tracks: known.tracks.map(numbered),
        };
        for (station, payload) in measured.told(self.states()) {
            self.send(now_ns, station, payload);
        }
    }

    fn send(&mut self, now_ns: i64, station: i64, payload: Payload) {
        let message = Message { sender: self.id, receiver: station, generated_ns: now_ns, payload };
        match message::encode(&message, &self.frame) {
            Ok(bytes) => {
                self.tally.traffic().sent(&message.payload);
                self.transport.send(now_ns, Address::Station(station), bytes);
            }
            Err(error) => self.tally.traffic().unsent(&message.payload, &error),
        }
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
                return self.tally.traffic().dropped("too many stations");
            }
            Err(RequesterError::Station { .. } | RequesterError::NegativeParameter { .. }) => {
                return self.tally.traffic().dropped("no station");
            }
        };
        for ((group, before), after) in Group::ALL.into_iter().zip(before).zip(self.states()) {
            if session(before).is_some() && session(before) != session(after) {
                let is_asked = matches!(before, GroupState::Requested { .. });
                let why = if is_asked && why == "silent" { "not confirmed" } else { why };
                self.tally.note(now_ns, What::Left { group: word(group), why: why.to_owned() });
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
                // Counted with the reason where it came.
                Action::Drop(_) => {}
            }
        }
    }

    /// Notes a connection that was made or has ended.
    fn look_at_link(&mut self, now_ns: i64) {
        if let Some(what) = What::of_link(self.transport.health(), &mut self.link) {
            self.tally.note(now_ns, what);
        }
    }

    fn states(&self) -> [GroupState; 2] {
        Group::ALL.map(|group| self.monitor.requester().state(group))
    }
}

fn session(state: GroupState) -> Option<(i64, i64)> {
    match state {
        GroupState::Local => None,
        GroupState::Requested { station, session, .. }
        | GroupState::Remote { station, session } => Some((station, session)),
    }
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
