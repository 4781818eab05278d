//! A world whose clock stands still unless it is moved on: a vehicle on the drive of the demo, stations,
//! and whoever else talks.

use std::collections::BTreeMap;
use std::iter;
use std::sync::{Arc, Mutex};

use mufasa::monitor::Settings;
use mufasa::services::configuration::Configuration;
use mufasa_drives::{Injection, Options, Stream, inject};
use mufasa_link::message::{Frame, Message, Payload, decode, encode};
use mufasa_link::play::Played;
use mufasa_link::run::settings;
use mufasa_link::station::{Station, StationSummary};
use mufasa_link::transport::channels::{Channels, Hub};
use mufasa_link::transport::disturbed::Disturbed;
use mufasa_link::transport::{Address, Transport};
use mufasa_link::vehicle::Vehicle;
use mufasa_link::vehicle::memory::lent;
use mufasa_link::vehicle::summary::{Summary, Tally};
use mufasa_model::input::cycle::Profile;
use mufasa_model::offloading::requester::Parameters;

/// A day of the year 2026, ns.
pub const START_NS: i64 = 1_790_000_000_000_000_000;

pub const MS: i64 = 1_000_000;

/// Called each ms with the time since the start, ms, and a way to send as anybody.
pub type Also = Box<dyn FnMut(i64, &mut Somebody)>;

/// What happens in a world.
pub struct World {
    pub profile: Profile,
    /// What happens to what the vehicle receives.
    pub disturbances: Vec<&'static str>,
    /// What the station does to the drive.
    pub inject: Vec<&'static str>,
    pub requester: Parameters,
    /// Whether the station asks before it sends.
    pub asks: bool,
    /// Times in ms, from which to which there is a station.
    pub station: Vec<(i64, i64)>,
    /// Times in ms, at which the vehicle is started anew.
    pub restarts: Vec<i64>,
    /// Who else talks.
    pub also: Also,
    /// Times in ms after which all ends.
    pub until: i64,
}

/// Somebody else who talks and listens.
pub struct Somebody {
    hub: Hub,
    channels: Channels,
    ears: BTreeMap<Address, Channels>,
    frame: Frame,
    pub now_ns: i64,
}

impl Somebody {
    /// Says this as the sender, for the receiver.
    pub fn say(&mut self, to: Address, [sender, receiver]: [i64; 2], payload: Payload) {
        self.send(to, &Message { sender, receiver, generated_ns: self.now_ns, payload });
    }

    pub fn send(&mut self, to: Address, message: &Message) {
        let bytes = encode(message, &self.frame).expect("a message that can be written");
        self.channels.send(self.now_ns, to, bytes);
    }

    pub fn shout(&mut self, to: Address, bytes: &[u8]) {
        self.channels.send(self.now_ns, to, bytes.to_vec());
    }

    /// What others said to an address since this was last asked; from the first time on.
    pub fn heard(&mut self, to: Address) -> Vec<Payload> {
        let ear = self.ears.entry(to).or_insert_with(|| self.hub.join(to));
        let read = |bytes: Vec<u8>| decode(&bytes, &self.frame).expect("a message").payload;
        iter::from_fn(|| ear.receive(0)).map(read).collect()
    }
}

impl Default for World {
    fn default() -> Self {
        Self {
            profile: Profile::HARDENED,
            disturbances: Vec::new(),
            inject: Vec::new(),
            requester: Parameters { dt_max_ns: 150 * MS, ..Parameters::default() },
            asks: true,
            station: vec![(0, i64::MAX)],
            restarts: Vec::new(),
            also: Box::new(|_, _| {}),
            until: i64::MAX,
        }
    }
}

/// What was seen.
pub struct Seen {
    pub vehicle: Summary,
    /// Of the last station.
    pub station: StationSummary,
    /// At which times, ms since the start, the groups that are remote changed, and to what.
    pub changes: Vec<(i64, Configuration)>,
    /// At which times, ms since the start, the vehicle learned until when, in these ms, it asks no station.
    pub holds: Vec<(i64, i64)>,
    /// What the vehicle says of what changes, with the time since the start, ms.
    pub said: Vec<(i64, String)>,
}

impl Seen {
    /// When all was remote again after a time, ms.
    pub fn offloaded_after(&self, ms: i64) -> Option<i64> {
        let mut all = self.changes.iter().filter(|(_, it)| *it == Configuration::AllRemote);
        all.find(|(at, _)| *at > ms).map(|(at, _)| *at)
    }

    /// The configuration at a time, ms.
    pub fn at(&self, ms: i64) -> Configuration {
        let before = self.changes.iter().rev().find(|(at, _)| *at <= ms);
        before.map_or(Configuration::Local, |(_, it)| *it)
    }
}

impl World {
    /// Drives until the end.
    pub fn drive(mut self) -> Seen {
        let options = Options { profile: self.profile, ..Options::default() };
        let clean = mufasa_drives::demo(&options).and_then(Stream::collect).expect("the demo");
        let mut attacked = clean.clone();
        for attack in &self.inject {
            let injection: Injection = attack.parse().expect("an injection");
            let stream = inject(&attacked.into(), &injection).expect("it changes the drive");
            attacked = stream.collect().expect("it is in memory");
        }
        let played = Played::new(clean).expect("a drive to be played");
        let offered = Played::new(attacked).expect("a drive to be played");
        let settings: Settings = settings(&played, &self.requester);
        let hub = Hub::default();
        let mut somebody = Somebody {
            hub: hub.clone(),
            channels: hub.join(Address::Vehicle(99)),
            ears: BTreeMap::new(),
            frame: played.frame().expect("a frame"),
            now_ns: START_NS,
        };
        let disturbances = self.disturbances.iter().map(|it| it.parse().expect("one")).collect();
        let mut of_vehicle = Disturbed::new(hub.join(Address::Vehicle(1)), disturbances);
        let said = Arc::new(Mutex::new(Vec::new()));
        let heard = Arc::clone(&said);
        let mut tally = Tally::heard_by(Box::new(move |entry| {
            let change = entry.what.change().map(|it| ((entry.at_ns - START_NS) / MS, it));
            heard.lock().expect("no panic").extend(change);
        }));
        let said = || said.lock().expect("no panic").clone();
        let (mut changes, mut holds) = (vec![], vec![]);
        let mut station_summary = StationSummary::default();
        let mut ms = 0;
        let mut lives = self.restarts.clone();
        lives.push(self.until);
        for end_ms in lives {
            let mut lent = lent(&played);
            let now_ns = START_NS + ms * MS;
            let vehicle =
                Vehicle::new(1, now_ns, &played, settings, &mut lent, &mut of_vehicle, &mut tally);
            let mut vehicle = vehicle.expect("settings that fit");
            while ms < end_ms {
                // A station lives for a span; a new one knows nothing of the one before.
                let span =
                    self.station.iter().copied().find(|(from, to)| (*from..*to).contains(&ms));
                let until_ms = span.map_or(ms + 1, |(_, to)| to.min(end_ms));
                let mut of_station = hub.join(Address::Station(1));
                let mut station = Station::new(1, &offered, &mut of_station).expect("a frame");
                if self.asks {
                    station = station.asking(&played, &settings);
                }
                let mut has_ended = false;
                while ms < until_ms && !has_ended {
                    let now_ns = START_NS + ms * MS;
                    somebody.now_ns = now_ns;
                    (self.also)(ms, &mut somebody);
                    if span.is_some() {
                        // What it answers has been under way for half a millisecond when it arrives.
                        station.step(now_ns - MS / 2);
                    }
                    has_ended = vehicle.step(now_ns).expect("a route that fits").is_none();
                    if let Some(hold_ns) = vehicle.hold_until_ns() {
                        let until_ms = (hold_ns - START_NS) / MS + 1;
                        if holds.last().is_none_or(|(_, it)| *it != until_ms) {
                            holds.push((ms, until_ms));
                        }
                    }
                    let configuration = vehicle.configuration();
                    if changes.last().map_or(Configuration::Local, |(_, it)| *it) != configuration {
                        changes.push((ms, configuration));
                    }
                    ms += 1;
                }
                station_summary = station.summary();
                if has_ended {
                    let vehicle = tally.summary();
                    return Seen {
                        vehicle,
                        station: station_summary,
                        changes,
                        holds,
                        said: said(),
                    };
                }
            }
            // Killed: it says nothing more, and nobody else remembers it.
        }
        let vehicle = tally.summary();
        Seen { vehicle, station: station_summary, changes, holds, said: said() }
    }
}
