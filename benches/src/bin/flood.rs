//! `flood [KIND] [STATIONS]`: what a message costs a monitor that both groups are remote to, with so many stations
//! in its table; one call in a function of its own, whose instructions `scripts/flood` counts; prints how many steps
//! it may take (`spec/4-arithmetic.md#steps`). Without arguments: the kinds.

use std::error::Error;
use std::hint::black_box;
use std::sync::LazyLock;
use std::time::Duration;

use mufasa::cycle::steps::{Counts, most_steps};
use mufasa::input::cycle::{CrossSection, Detection, Ego, Route, Track, TrajectoryPoint};
use mufasa::input::detection_index::Slot;
use mufasa::input::parameters::Parameters;
use mufasa::input::route_index::Block;
use mufasa::input::scratch::{Column, Row};
use mufasa::monitor::{Arrival, DropReason, Inputs, Memory, Message, Monitor, Settings, Time};
use mufasa::offloading::requester::{Action, Actions, StationRecord};

use mufasa::services::configuration::{Configuration, Group, Groups};

/// Of docs/configuration.md.
const TRACKS: usize = 128;
const POINTS: usize = 128;
const CROSS_SECTIONS: usize = 640;
const NOW_MS: i64 = 1_000;

const TRACK: Track =
    Track { id: 1, x: 0.0, y: 0.0, cos: 1.0, sin: 0.0, vx: 0.0, vy: 0.0, length: 4.5, width: 1.8 };
const EGO: Ego = Ego {
    x: 0.0,
    y: 0.0,
    cos: 1.0,
    sin: 0.0,
    speed: 10.0,
    length: 4.5,
    width: 1.8,
    center_offset: 0.0,
};
static MANY: [Track; TRACKS + 1] = [TRACK; TRACKS + 1];
static LONG: [TrajectoryPoint; POINTS] =
    [TrajectoryPoint { t_ns: 0, x: 0.0, y: 0.0, cos: 1.0, sin: 0.0 }; POINTS];

type Call = fn(&mut Monitor<'_>, Time, i64) -> bool;

/// The one of a monitor without a session.
const ASKS: &str = "a tick that asks";
/// The one that is no message.
const ROUTE: &str = "a route of 640 cross sections";

/// Each with whether the message did what its name says.
const KINDS: [(&str, Call); 15] = [
    ("tracks, accepted", |it, now, _| drop_of(it, now, tracks(1, 1)).is_none()),
    ("trajectory, accepted", |it, now, _| points(it, now, 1, 2).is_none()),
    ("tracks of another session", |it, now, _| {
        drop_of(it, now, tracks(1, 9)) == Some(DropReason::OtherSession)
    }),
    ("tracks of another station", |it, now, last| {
        drop_of(it, now, tracks(last, 1)) == Some(DropReason::OtherSession)
    }),
    ("tracks, too late", |it, now, _| {
        let message = Message { generated: at(NOW_MS - 900), ..tracks(1, 1) };
        drop_of(it, now, message) == Some(DropReason::Late)
    }),
    ("tracks from the future", |it, now, _| {
        let message = Message { generated: at(NOW_MS + 900), ..tracks(1, 1) };
        drop_of(it, now, message) == Some(DropReason::FromTheFuture)
    }),
    ("tracks, too many", |it, now, _| {
        let message = Message { items: &MANY[..], ..tracks(1, 1) };
        drop_of(it, now, message) == Some(DropReason::TooLong)
    }),
    ("an offer, of a known station", |it, now, last| it.offer(now, last, Groups::ALL).is_ok()),
    ("an offer, no place left", |it, now, last| it.offer(now, last + 1, Groups::ALL).is_err()),
    ("a withdrawal", |it, now, last| it.withdraw(now, last).is_ok()),
    ("a confirmation, of no request", |it, now, last| it.confirm(now, last, Group::Mot, 5).is_ok()),
    ("a rejection, of the running session", |it, now, _| it.reject(now, 1, Group::Mot, 1).is_ok()),
    (ASKS, |it, now, _| asks(&it.tick(now)) == 2),
    (ROUTE, |it, _, _| it.set_route(&road()).is_ok()),
    ("a tick, both sessions end", |it, _, _| !it.tick(at(NOW_MS + 900)).is_empty()),
];

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let Some(kind) = arguments.next() else {
        KINDS.iter().for_each(|(name, _)| println!("{name}"));
        return Ok(());
    };
    let stations = arguments.next().map_or(Ok(8), |text| text.parse())?;
    let (_, call) = KINDS.iter().find(|(name, _)| *name == kind).ok_or("no such kind")?;
    let mut monitor = offered(stations);
    if kind != ASKS {
        serve(&mut monitor);
    }
    let last = i64::try_from(stations)?;
    let mut run = || call(&mut monitor, at(NOW_MS), last);
    assert!(measured(&mut run), "{kind}: something else happened");
    let counts = Counts {
        stations: u32::try_from(stations)?,
        cross_sections: u32::try_from(CROSS_SECTIONS)?,
        ..Counts::default()
    };
    let most = most_steps(&counts, &Parameters::default());
    println!("{}", if kind == ROUTE { most.route } else { most.messages / 64 });
    Ok(())
}

/// What is counted.
#[inline(never)]
fn measured(run: &mut dyn FnMut() -> bool) -> bool {
    black_box(run())
}

fn asks(actions: &Actions) -> usize {
    actions.iter().filter(|it| matches!(it, Action::Request { .. })).count()
}

fn at(ms: i64) -> Time {
    Time::from_nanoseconds(ms * 1_000_000)
}

fn road() -> Route<'static> {
    static ROAD: LazyLock<Vec<CrossSection>> = LazyLock::new(|| {
        let places = (0_u16..).map(f64::from).take(CROSS_SECTIONS);
        places.map(|x| CrossSection { x, y: 0.0, left: [x, 2.0], right: [x, -2.0] }).collect()
    });
    Route { closed: false, cross_sections: &ROAD }
}

/// A monitor whose table is full of stations that offer both groups.
fn offered(stations: usize) -> Monitor<'static> {
    let memory = Memory {
        stations: vec![StationRecord::FREE; stations].leak(),
        rows: vec![Row::default(); TRACKS].leak(),
        columns: vec![Column::default(); 4 * 256].leak(),
        detections: vec![Detection::default(); Memory::detections_for(256)].leak(),
        slots: vec![Slot::default(); Memory::slots_for(256)].leak(),
        cross_sections: vec![CrossSection::default(); CROSS_SECTIONS].leak(),
        blocks: vec![Block::default(); Block::needed(CROSS_SECTIONS)].leak(),
    };
    let settings = Settings::new(Duration::from_millis(50)).in_any_time();
    let mut monitor = Monitor::new(settings, memory).expect("the default settings");
    monitor.set_route(&road()).expect("a road");
    // Before half a second was seen, nothing is asked for.
    for age in (1..=10).rev() {
        let then = at(NOW_MS - age * 100);
        let (_safe, _none) = monitor.cycle(&Inputs::new(then, EGO).detections(then, &[]));
    }
    for station in 1..=i64::try_from(stations).expect("few") {
        let _none = monitor.offer(at(NOW_MS), station, Groups::ALL).expect("there is a place");
    }
    monitor
}

/// Both groups have a session at station 1.
fn serve(monitor: &mut Monitor<'_>) {
    let _requests = monitor.tick(at(NOW_MS));
    for (group, session) in Group::ALL.into_iter().zip(1..) {
        let _done = monitor.confirm(at(NOW_MS), 1, group, session).expect("a station");
    }
    assert_eq!(monitor.configuration(), Configuration::AllRemote);
}

fn tracks(station: i64, session: i64) -> Message<&'static [Track]> {
    let (generated, stamp) = (at(NOW_MS), at(NOW_MS));
    Message { station, session, generated, stamp, items: &MANY[..TRACKS] }
}

fn drop_of(
    it: &mut Monitor<'_>,
    now: Time,
    message: Message<&'static [Track]>,
) -> Option<DropReason> {
    why(&it.tracks(now, message).expect("a station").0)
}

fn points(it: &mut Monitor<'_>, now: Time, station: i64, session: i64) -> Option<DropReason> {
    let (generated, stamp) = (at(NOW_MS), at(NOW_MS));
    let message = Message { station, session, generated, stamp, items: &LONG };
    why(&it.trajectory(now, message).expect("a station").0)
}

fn why<L>(arrival: &Arrival<L>) -> Option<DropReason> {
    match arrival {
        Arrival::Accepted(_) => None,
        Arrival::Dropped { why } => Some(*why),
    }
}
