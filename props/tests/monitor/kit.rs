//! Memory for a monitor, and a road for it: the CAV, a car ahead, one beside the road, and a station.

use mufasa::input::cycle::{CrossSection, Detection, Ego, Route, Track, TrajectoryPoint};
use mufasa::monitor::{
    Accepted, Arrival, Decision, Inputs, Message, Monitor, MonitorError, Settings, Time,
};
use mufasa::offloading::requester::{Action, Actions, Group, Groups};
use mufasa_props::lent::Lent;

pub const MS: i64 = 1_000_000;

/// Tracks that a cycle may use.
pub type Tracks = Option<Accepted<Vec<Track>>>;
/// A trajectory that a cycle may use.
pub type Points = Option<Accepted<Vec<TrajectoryPoint>>>;

/// What a monitor is lent.
pub struct Buffers(pub Lent);

impl Buffers {
    /// For lists of so many detections and routes of so many cross sections.
    pub fn new(detections: usize, cross_sections: usize) -> Self {
        Self(Lent::new(8, detections, cross_sections))
    }

    pub fn monitor(&mut self, settings: Settings) -> Result<Monitor<'_>, MonitorError> {
        // There is memory for all tracks of the domain.
        Monitor::new(settings.in_any_time().in_any_range(), self.0.memory())
    }

    /// A monitor with the settings of this kit that has just been started on this road.
    pub fn started_on(&mut self, road: &[CrossSection]) -> Monitor<'_> {
        let mut monitor = self.monitor(settings()).expect("a monitor");
        monitor.set_route(&route(road)).expect("a route");
        monitor
    }

    /// And at time 0 it has seen enough to ask a station.
    pub fn on(&mut self, road: &[CrossSection]) -> Monitor<'_> {
        let mut monitor = self.started_on(road);
        look_around(&mut monitor, 0, World::at);
        monitor
    }
}

/// The cycles of the half second before a time, in which the CAV sees what is around: before that no station
/// is asked (MON-43).
pub fn look_around(monitor: &mut Monitor<'_>, until_ns: i64, world: impl Fn(i64) -> World) {
    for i in (1..=5).rev() {
        let world = world(until_ns - 100 * i * MS);
        let now = at(world.now_ns);
        let inputs = Inputs::new(now, world.ego).detections(now, &world.detections);
        let (decision, actions) = monitor.cycle(&inputs);
        assert!(matches!(decision, Decision::Safe { .. }) && actions.is_empty(), "{decision:?}");
    }
}

/// 10 Hz, 150 ms until a session is silent, and 250 ms until the CAV brakes.
pub fn settings() -> Settings {
    let mut settings = Settings::new(std::time::Duration::from_millis(100));
    settings.requester.dt_max_ns = 150 * MS;
    settings.stages.tau = 0.25;
    settings
}

pub fn at(ns: i64) -> Time {
    Time::from_nanoseconds(ns)
}

/// A straight road of 300 m, 6 m wide.
pub fn road() -> Vec<CrossSection> {
    let at = |x| CrossSection { x, y: 0.0, left: [x, 3.0], right: [x, -3.0] };
    (-5..26).map(|i| at(10.0 * f64::from(i))).collect()
}

/// A route of it.
pub fn route(cross_sections: &[CrossSection]) -> Route<'_> {
    Route { closed: false, cross_sections }
}

/// What is around at a time: the CAV drives at 5 m/s, and two cars with it.
#[derive(Clone)]
pub struct World {
    pub now_ns: i64,
    pub ego: Ego,
    pub detections: Vec<Detection>,
    pub tracks: Vec<Track>,
    pub points: Vec<TrajectoryPoint>,
}

impl World {
    pub fn at(now_ns: i64) -> Self {
        let x = 5.0 * seconds(now_ns);
        let (cos, sin) = (1.0, 0.0);
        let ego =
            Ego { x, y: 0.0, cos, sin, speed: 5.0, length: 4.5, width: 1.9, center_offset: 1.4 };
        let point = |i: i32| TrajectoryPoint {
            t_ns: now_ns + i64::from(i) * 100 * MS,
            x: x + 0.5 * f64::from(i),
            y: 0.0,
            cos,
            sin,
        };
        let mut world = Self {
            now_ns,
            ego,
            detections: Vec::new(),
            tracks: Vec::new(),
            points: (0..30).map(point).collect(),
        };
        world.add([x + 25.0, 0.0], [1.0, 0.0], [5.0, 0.0]);
        world.add([x + 45.0, 8.0], [1.0, 0.0], [5.0, 0.0]);
        world
    }

    /// A car and its track: place, direction, velocity.
    pub fn add(&mut self, [x, y]: [f64; 2], [cos, sin]: [f64; 2], [vx, vy]: [f64; 2]) {
        let (length, width) = (4.5, 1.9);
        let id = i64::try_from(self.tracks.len()).expect("a few");
        self.detections.push(Detection { x, y, cos, sin, length, width });
        self.tracks.push(Track { id, x, y, cos, sin, vx, vy, length, width });
    }
}

pub fn seconds(ns: i64) -> f64 {
    f64::from(i32::try_from(ns / MS).expect("a few seconds")) * 1e-3
}

/// A station that confirms what it is asked for, and sends results until it is released.
#[derive(Default)]
pub struct Station {
    pub asked: Vec<(Group, i64)>,
    pub sessions: [Option<i64>; 2],
    pub released: usize,
}

impl Station {
    pub fn take(&mut self, actions: &Actions) {
        for action in actions {
            match *action {
                Action::Request { group, session, .. } => {
                    self.asked.push((group, session));
                    self.sessions[place(group)] = Some(session);
                }
                Action::Release { group, session, .. } => {
                    self.released += 1;
                    let known = &mut self.sessions[place(group)];
                    *known = known.filter(|known| *known != session);
                }
                Action::Activate(_) | Action::Deactivate(_) | Action::Drop(_) => {}
            }
        }
    }

    /// The events of a period at 10 Hz, with what of the world the station sends.
    pub fn period(&mut self, monitor: &mut Monitor<'_>, world: &World) -> (Tracks, Points) {
        let now = at(world.now_ns);
        self.take(&monitor.offer(now, 1, Groups::ALL).expect("a station"));
        for (group, session) in std::mem::take(&mut self.asked) {
            self.take(&monitor.confirm(now, 1, group, session).expect("a station"));
        }
        self.take(&monitor.tick(now));
        let [mot, plan] = self.sessions;
        let tracks = mot.map(|session| message(session, now, world.tracks.clone()));
        let tracks = tracks.map(|message| monitor.tracks(now, message).expect("a station"));
        let tracks = tracks.and_then(|arrival| self.accepted(arrival));
        let points = plan.map(|session| message(session, now, world.points.clone()));
        let points = points.map(|message| monitor.trajectory(now, message).expect("a station"));
        (tracks, points.and_then(|arrival| self.accepted(arrival)))
    }

    pub fn accepted<L>(
        &mut self,
        (arrival, actions): (Arrival<L>, Actions),
    ) -> Option<Accepted<L>> {
        self.take(&actions);
        match arrival {
            Arrival::Accepted(element) => Some(element),
            Arrival::Dropped { .. } => None,
        }
    }
}

/// What a cycle at a time of the world is about, with these results.
pub fn inputs<'c>(world: &'c World, tracks: &'c Tracks, points: &'c Points) -> Inputs<'c> {
    let now = at(world.now_ns);
    let mut inputs = Inputs::new(now, world.ego).detections(now, &world.detections);
    if let Some(tracks) = tracks {
        inputs = inputs.remote_tracks(tracks);
    }
    if let Some(points) = points {
        inputs = inputs.remote_trajectory(points);
    }
    inputs
}

pub fn message<L>(session: i64, now: Time, items: L) -> Message<L> {
    Message { station: 1, session, generated: now, stamp: now, items }
}

pub fn place(group: Group) -> usize {
    match group {
        Group::Mot => 0,
        Group::Plan => 1,
    }
}
