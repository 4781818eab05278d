//! H-13: a detection and where the CAV saw it before, and the motion that this says.

use crate::hardened::detection_history::Usable;
use crate::input::scene::{Detections, Object, Point};
use crate::numbers::real::Real;
use crate::numbers::vector::{Frame, Vector};

/// A detection d and the item d' of an earlier list that it may have come from, by their indices.
#[derive(Clone, Copy, Debug)]
pub struct Pair<'a> {
    /// Of the current detection.
    pub detection: usize,
    /// Of the item of the list.
    pub item: usize,
    /// The list.
    pub list: &'a Usable<'a>,
}

impl Pair<'_> {
    /// w of its detection, m/s.
    pub fn velocity(&self, d: &Object) -> Vector {
        velocity(d, &self.list.items[self.item], &self.list.dt)
    }
}

/// What a pair stands for when the CAV is at a point: d, its centre at d + w (t_point - t_D).
pub fn object_at(detections: &Detections, pair: &Pair, point: &Point) -> Object {
    let t_ns = i128::from(point.t_ns) - i128::from(detections.stamp_ns);
    let d = &detections.items[pair.detection];
    let origin = &d.frame.origin + &pair.velocity(d).scaled(&Real::seconds(t_ns));
    Object { frame: Frame { origin, direction: d.frame.direction.clone() }, ..d.clone() }
}

/// w = (d - d') / dt, m/s.
pub fn velocity(d: &Object, before: &Object, dt: &Real) -> Vector {
    let moved = &d.frame.origin - &before.frame.origin;
    Vector { x: moved.x / dt, y: moved.y / dt }
}
