//! A detection that has come from an earlier item (`spec/3-stages.md#hardened-profile`).

use crate::hardened::detection_history::UsableList;
use crate::input::cycle::Detection;
use crate::numbers::plane::Vector;
use crate::numbers::rectangle::Rectangle;
use crate::numbers::rounding::Real;
use crate::stages::llcc::Moving;
use crate::stages::llcc::sweep::MovingRectangle;

/// A detection that has come from an earlier item.
pub(super) struct SeenTwice {
    /// With the mean velocity.
    pub(super) now: MovingRectangle,
    /// The item, m.
    before: [f64; 2],
    age_ns: i64,
}

impl SeenTwice {
    pub(super) fn new(now: &Detection, before: [f64; 2], list: &UsableList<'_>) -> Self {
        let (rate, [x, y]) = (1.0 / list.age, before);
        let velocity = [(now.x - x) * rate, (now.y - y) * rate];
        let now = MovingRectangle { velocity, ..MovingRectangle::detection(now) };
        Self { now, before, age_ns: list.age_ns }
    }

    /// What it has moved, exactly, m: the velocity, but for a factor above 0.
    pub(super) fn moved(&self) -> Vector {
        Vector::between(self.before, self.now.centre)
    }
}

impl Moving for SeenTwice {
    fn plainly(&self) -> &MovingRectangle {
        &self.now
    }

    fn exactly(&self, dt_ns: i64) -> Rectangle {
        let times = Real::integer(dt_ns).over(Real::integer(self.age_ns));
        self.now.displaced(self.moved().times(times))
    }
}
