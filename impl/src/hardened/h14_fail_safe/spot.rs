//! The CAV at one place, in plain doubles, which decide whether an object sweeps over it.
//!
//! All counts from the CAV's reference point. Places and ways come rounded once from numbers with error
//! bounds. A window errs by less than 1e-14 of H(w), or by 1e-12 s where little way is left to a stop: the root
//! of a way that is known up to 1e-26 m. `w_least` errs by less than 2^-49 of abs(w). Each comparison
//! rounds less than 64 times, with the roundings of these, and only numbers that are no greater than
//! D = abs(c - p) + abs(w) (60 s + H(w)), or than 5 km, where the two may be so near that it matters. So it
//! errs by less than 64 * 2^-53 (D + 5 km) + abs(w) (1e-14 H(w) + 1e-12 s), which is less than a half of
//! `ROUGH` D and a hundredth of `SLACK`. What is added here is less than four times `ROUGH` D and twice
//! `SLACK`, since D counts x and y, c where the list has it, and the axis across the way takes x and y apart
//! again: less than the strict model adds, 1e-8 m + 1e-12 D (MARGIN-16).

use crate::hardened::h14_fail_safe::cover::{Clock, Object};
use crate::hardened::h14_fail_safe::path::Place;
use crate::input::cycle::Ego;
use crate::numbers::plane::Vector;
use crate::stages::llcc::sweep::{MovingRectangle, SLACK, minus};

/// More than comparisons err, of how far an object is and goes.
const ROUGH: f64 = 1e-13;
/// No list is older, s.
const OLDEST: f64 = 60.0;

/// The CAV's rectangle at a place.
#[derive(Clone, Copy, Debug)]
pub(super) struct Spot {
    cav: MovingRectangle,
    /// More than the place errs, m.
    error: f64,
}

impl Spot {
    /// Of a CAV so large.
    pub(super) fn new(ego: &Ego, place: &Place) -> Self {
        let cav = MovingRectangle::cav(ego, place.pose.heading);
        let from = place.pose.at - Vector::new(ego.x, ego.y);
        let [x, y] = cav.centre;
        let centre = [from.x.value() + x, from.y.value() + y];
        Self { cav: MovingRectangle { centre, ..cav }, error: from.x.off() + from.y.off() }
    }

    /// Whether an object certainly sweeps over no point of it between two times after now. What does not in
    /// the strict model is found not to.
    pub(super) fn is_missed(&self, object: &Object, [start, end]: [f64; 2], clock: &Clock) -> bool {
        let &Object { at, speed, age, .. } = object;
        // H-14.25
        let (from, until) = (clock.braked(object, start), age + end);
        let moved = at.velocity.map(|rate| rate * (until - from));
        let between = minus(at.after(from), self.cav.centre);
        let [x, y] = at.centre.map(f64::abs);
        let goes = speed * (OLDEST + clock.until_yielded(speed));
        let error = SLACK + ROUGH * (x + y + goes) + self.error;
        self.cav.is_clear_of(&at, between, moved, error)
    }
}

#[cfg(test)]
pub(super) mod tests;
