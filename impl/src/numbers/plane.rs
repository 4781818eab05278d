//! Vectors of the plane with error bounds, and the frames of
//! `spec/4-arithmetic.md#the-model-is-exact`.

use core::ops::{Add, Sub};

use crate::numbers::rounding::Real;

/// A point or displacement, m.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Vector {
    pub(crate) x: Real,
    pub(crate) y: Real,
}

impl Vector {
    /// The point with these coordinates, exactly.
    pub(crate) const fn new(x: f64, y: f64) -> Self {
        Self { x: Real::new(x), y: Real::new(y) }
    }

    /// The displacement from one point to another, exactly.
    pub(crate) fn between(from: [f64; 2], to: [f64; 2]) -> Self {
        let [ax, ay] = from;
        let [bx, by] = to;
        Self { x: Real::difference(bx, ax), y: Real::difference(by, ay) }
    }

    pub(crate) fn dot(self, other: Self) -> Real {
        self.x * other.x + self.y * other.y
    }

    /// The z component of the cross product.
    pub(crate) fn cross(self, other: Self) -> Real {
        self.x * other.y - self.y * other.x
    }

    pub(crate) fn times(self, factor: Real) -> Self {
        Self { x: self.x * factor, y: self.y * factor }
    }

    pub(crate) fn norm(self) -> Real {
        self.dot(self).sqrt()
    }
}

impl Add for Vector {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self { x: self.x + other.x, y: self.y + other.y }
    }
}

impl Sub for Vector {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        Self { x: self.x - other.x, y: self.y - other.y }
    }
}

/// Whether the two are the same point; 0 and -0 are the same number.
#[allow(clippy::float_cmp, reason = "two given numbers, neither of them computed")]
pub(crate) fn same_point([ax, ay]: [f64; 2], [bx, by]: [f64; 2]) -> bool {
    ax == bx && ay == by
}

/// Euclidean distance of two points, m.
pub(crate) fn distance(a: [f64; 2], b: [f64; 2]) -> Real {
    Vector::between(a, b).norm()
}
