//! One object and how it moves (`spec/hardened/H-14.md#requirements-motions`).

use crate::numbers::plane::Vector;
use crate::numbers::rounding::Real;
use crate::numbers::time::seconds;
use crate::stages::llcc::sweep::MovingRectangle;
use crate::stages::llcc::vector;

/// An object that moves on as it did.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Motion {
    /// At the time of its list (H-14.23).
    pub(super) now: MovingRectangle,
    /// Where it was so many ns before, unless its velocity was given.
    pub(super) from: Option<([f64; 2], i64)>,
    /// Of its list (H-14.23).
    pub(super) age_ns: i64,
    /// The same in s.
    pub(super) age: f64,
}

impl Motion {
    pub(super) fn new(now: MovingRectangle, age_ns: i64) -> Self {
        Self { now, from: None, age_ns, age: seconds(age_ns) }
    }

    /// The same, come from a place so many ns before.
    pub(super) fn coming_from(&self, before: [f64; 2], dt_ns: i64, rate: f64) -> Self {
        let ([x, y], [x_before, y_before]) = (self.now.centre, before);
        let velocity = [(x - x_before) * rate, (y - y_before) * rate];
        let now = MovingRectangle { velocity, ..self.now };
        Self { now, from: Some((before, dt_ns)), ..*self }
    }

    /// Its velocity, m/s.
    pub(super) fn velocity(&self) -> Vector {
        self.from.map_or(vector(self.now.velocity), |(before, dt_ns)| {
            let rate = Real::quotient(1e9, Real::integer(dt_ns).value());
            Vector::between(before, self.now.centre).times(rate)
        })
    }
}
