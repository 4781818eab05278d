//! The CAV at one place in plain doubles, which decide whatever is not close (H-14.54).
//!
//! All counts from the CAV's reference point. Places, ways and times come rounded once from numbers with
//! error bounds, and sizes are taken along directions as long as they are. With less than 32 roundings a
//! coordinate, up to 2^26 m, errs by less than 1e-6 m, and so does what an object of 1000 m/s moves in
//! 1e5 s.

use crate::hardened::h14_fail_safe::cover::{Clock, Object};
use crate::hardened::h14_fail_safe::path::Place;
use crate::input::cycle::Ego;
use crate::numbers::plane::Vector;
use crate::stages::llcc::sweep::{MARGIN, MovingRectangle, minus};

/// More than so many roundings err, of all that is added: 2^-46.
const ROUGH: f64 = 1.0 / 70_368_744_177_664.0;
/// Less than half the least margin of the strict model, m (DOM-01, MARGIN-01).
const FINE: f64 = 4e-9;

/// The CAV's rectangle at a place.
#[derive(Clone, Copy, Debug)]
pub(super) struct Spot {
    cav: MovingRectangle,
}

impl Spot {
    /// Of a CAV so large.
    pub(super) fn new(ego: &Ego, place: &Place) -> Self {
        let cav = MovingRectangle::cav(ego, place.pose.heading);
        let from = place.pose.at - Vector::new(ego.x, ego.y);
        let [x, y] = cav.centre;
        let centre = [from.x.value() + x, from.y.value() + y];
        Self { cav: MovingRectangle { centre, ..cav } }
    }

    /// Whether an object certainly sweeps over no point of it between two times after now.
    pub(super) fn is_missed(&self, object: &Object, [start, end]: [f64; 2], clock: &Clock) -> bool {
        let &Object { at, speed, age } = object;
        let (from, until) = (clock.braked(speed, age + start), age + end);
        let moved = at.velocity.map(|rate| rate * (until - from));
        let centre = at.after(from);
        self.is_apart(&MovingRectangle { centre, ..at }, moved, MARGIN)
    }

    fn is_apart(&self, object: &MovingRectangle, moved: [f64; 2], error: f64) -> bool {
        self.cav.is_clear_of(object, minus(object.centre, self.cav.centre), moved, error)
    }

    /// Whether an object certainly shares no point with it, where it stands; `None` where that takes more
    /// than plain doubles. What is apart in the strict model, with its margin, is found to be so.
    pub(super) fn is_clear_of(&self, object: &MovingRectangle) -> Option<bool> {
        let sum = |[a, b]: [f64; 2]| a.abs() + b.abs();
        let added = |it: &MovingRectangle| sum(it.centre) + sum(it.size);
        let error = (added(&self.cav) + added(object)) * ROUGH;
        let is_apart = self.is_apart(object, [0.0; 2], error);
        (is_apart || error < FINE).then_some(is_apart)
    }
}

#[cfg(test)]
mod tests;
