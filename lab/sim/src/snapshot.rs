//! The truth at one moment, for sensors, pictures and judges.

use crate::map::Light;
use crate::pose::{Point, Pose, Rectangle};
use crate::services::detectors::seen::Seen;
use crate::traffic::agent::Kind;

/// Everything that moves, at one moment.
#[derive(Clone, Debug, PartialEq)]
pub struct Snapshot {
    /// Simulated time, ns.
    pub time_ns: i64,
    /// The ego.
    pub ego: EgoState,
    /// The others, by number.
    pub objects: Vec<Object>,
    /// What the signals show, by group.
    pub lights: Vec<Light>,
    /// Stop lines ahead on the ego's route that it may not pass now, the nearest first.
    pub stops: Vec<StopLine>,
}

impl Snapshot {
    /// What there is to be seen.
    pub fn seen(&self) -> Vec<Seen> {
        let seen = |it: &Object| Seen { id: it.id, rectangle: it.rectangle, velocity: it.velocity };
        self.objects.iter().map(seen).collect()
    }

    /// Where a signal asks the ego to stop, arc lengths of its route, m: what a camera would see. Where it
    /// has to give way it finds out itself.
    pub fn closed_signals(&self) -> Vec<f64> {
        let closed = self.stops.iter().filter(|stop| stop.reason == Reason::Signal);
        closed.map(|stop| stop.s).collect()
    }
}

/// The ego at one moment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EgoState {
    /// Its rectangle; the pose is that of its middle.
    pub rectangle: Rectangle,
    /// The middle of the rear axle.
    pub rear: Pose,
    /// m/s.
    pub speed: f64,
    /// Place of the middle on its route, m; looked for near the last one.
    pub s: f64,
    /// Distance of the middle from its route, left positive, m.
    pub left: f64,
}

/// Somebody else at one moment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Object {
    /// Number, never given twice.
    pub id: u32,
    /// What it is.
    pub kind: Kind,
    /// Where it is.
    pub rectangle: Rectangle,
    /// Over ground, m/s.
    pub velocity: Point,
}

/// Why the ego may not pass a stop line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reason {
    /// The signal is not green.
    Signal,
    /// Others have it, or come first, or there is no room behind.
    GiveWay,
}

/// A stop line that the ego may not pass now.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StopLine {
    /// Where the front is to stop, arc length of the route, m.
    pub s: f64,
    /// Why.
    pub reason: Reason,
}
