//! Somebody on a route: what it knows, and how it moves.

use crate::map::Town;
use crate::map::route::{Route, RouteKind};
use crate::pose::{Point, Rectangle};
use crate::scenario::{Halt, Start};
use crate::traffic::idm::Idm;

/// Hardest braking of others, m/s^2.
const A_MIN: f64 = -8.0;

/// What an agent is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// The ego.
    Ego,
    /// A car or a van.
    Car,
    /// A lorry or a bus.
    Truck,
    /// Somebody on foot.
    Pedestrian,
    /// Somebody on a bicycle.
    Bicycle,
}

/// Somebody on a route.
#[derive(Clone, Debug, PartialEq)]
pub struct Agent {
    /// Number, never given twice; the ego is 0.
    pub id: u32,
    /// What it is.
    pub kind: Kind,
    /// Index of its route.
    pub route: usize,
    /// Place of its middle on the route, m.
    pub s: f64,
    /// m/s.
    pub speed: f64,
    /// m/s^2.
    pub acceleration: f64,
    /// Where it is.
    pub rectangle: Rectangle,
    /// How it drives.
    pub idm: Idm,
    /// Where it still stops for a while.
    pub halts: Vec<Halt>,
    /// When the halt that it stands at ends, s.
    pub halt_until: Option<f64>,
    /// Passages of its route that it has left.
    pub cleared: usize,
    /// Passages that it may enter, from the first on.
    pub granted: usize,
    /// Since when it stands before a passage, s.
    pub waits_since: Option<f64>,
    /// Who is ahead in its corridor.
    pub ahead: Option<Ahead>,
    /// Whether it can be found on its route at all.
    pub on_route: bool,
}

/// The nearest agent ahead.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ahead {
    /// Its place among the agents.
    pub index: usize,
    /// From the own front to its nearest part, along the path, m; below zero beside it.
    pub gap: f64,
    /// Its speed along the path, m/s; not below zero.
    pub speed: f64,
}

impl Agent {
    /// A vehicle of a start.
    pub fn vehicle(id: u32, town: &Town, start: &Start) -> Self {
        let kind = if start.length > 7.0 { Kind::Truck } else { Kind::Car };
        let size = (start.length, start.width);
        let mut agent = Self::new(id, kind, town, start.route, start.s, size);
        (agent.speed, agent.idm, agent.halts) = (start.speed, start.idm, start.halts.clone());
        agent
    }

    /// Somebody at the start of a route across.
    pub fn walker(id: u32, town: &Town, route: usize) -> Self {
        let (kind, size) = match town.routes[route].kind {
            RouteKind::Cycle => (Kind::Bicycle, (1.8, 0.6)),
            RouteKind::Foot | RouteKind::Road => (Kind::Pedestrian, (0.5, 0.6)),
        };
        let speed = town.routes[route].pace[0];
        let mut agent = Self::new(id, kind, town, route, size.0 / 2.0, size);
        agent.idm = Idm { v0: speed, headway: 0.5, s0: 0.5, a: 1.5, b: 2.0 };
        agent.speed = 0.5 * speed;
        agent
    }

    /// Somebody at rest on a route, with a length and a width, m.
    pub fn new(
        id: u32,
        kind: Kind,
        town: &Town,
        route: usize,
        s: f64,
        (length, width): (f64, f64),
    ) -> Self {
        let pose = town.routes[route].path.pose_at(s);
        let cleared =
            town.routes[route].passages.iter().filter(|p| p.to < s - length / 2.0).count();
        Self {
            id,
            kind,
            route,
            s,
            speed: 0.0,
            acceleration: 0.0,
            rectangle: Rectangle { pose, length, width },
            idm: Idm::default(),
            halts: Vec::new(),
            halt_until: None,
            cleared,
            granted: cleared,
            waits_since: None,
            ahead: None,
            on_route: true,
        }
    }

    /// Arc length of its front, m.
    pub fn front(&self) -> f64 {
        self.s + self.rectangle.length / 2.0
    }

    /// Arc length of its rear, m.
    pub fn rear(&self) -> f64 {
        self.s - self.rectangle.length / 2.0
    }

    /// From here on it asks for the passage ahead, and brakes for it: comfortably, m.
    pub fn request_distance(&self) -> f64 {
        self.speed + self.speed * self.speed / 3.0 + 6.0
    }

    /// Velocity over ground, m/s; the ego's is the world's to say.
    pub fn velocity(&self) -> Point {
        let pose = self.rectangle.pose;
        Point::new(self.speed * pose.cos, self.speed * pose.sin)
    }

    /// Decides on an acceleration: the least of what road, vehicle ahead, stop line and halt allow.
    pub fn decide(&mut self, route: &Route, time: f64) {
        let driver = Idm { v0: self.idm.v0.min(route.pace_at(self.s)), ..self.idm };
        let mut wanted = driver.free(self.speed);
        if let Some(ahead) = self.ahead {
            wanted = wanted.min(driver.behind(self.speed, ahead.gap, ahead.speed));
        }
        if let Some(passage) = route.passages.get(self.granted) {
            let gap = passage.from - self.front();
            if gap < self.request_distance() {
                wanted = wanted.min(driver.behind(self.speed, gap, 0.0));
            }
        }
        wanted = wanted.min(self.halt(&driver, time));
        self.acceleration = wanted.clamp(A_MIN, driver.a);
    }

    /// Moves by its acceleration for `time`, s; it does not roll back.
    pub fn step(&mut self, route: &Route, time: f64) {
        let speed = (self.speed + self.acceleration * time).max(0.0);
        self.s += f64::midpoint(self.speed, speed) * time;
        self.speed = speed;
        self.rectangle.pose = route.path.pose_at(self.s);
        self.pass(route);
    }

    /// Counts the passages that it has left.
    pub fn pass(&mut self, route: &Route) {
        while route.passages.get(self.cleared).is_some_and(|p| p.to < self.rear()) {
            self.cleared += 1;
        }
        self.granted = self.granted.max(self.cleared);
    }

    fn halt(&mut self, driver: &Idm, time: f64) -> f64 {
        let Some(halt) = self.halts.first().copied() else { return f64::INFINITY };
        let gap = halt.s - self.front();
        match self.halt_until {
            Some(until) if time >= until => {
                self.halts.remove(0);
                self.halt_until = None;
                return f64::INFINITY;
            }
            None if self.speed < 0.1 && gap < 1.5 => self.halt_until = Some(time + halt.seconds),
            _ => {}
        }
        driver.behind(self.speed, gap + driver.s0, 0.0)
    }
}
