//! Points and vectors of the plane, and frames (`spec/4-arithmetic.md#domain`).

use std::ops::{Add, Neg, Sub};

use crate::numbers::real::Real;

/// A point or a vector, m.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Vector {
    /// East.
    pub x: Real,
    /// North.
    pub y: Real,
}

impl Vector {
    /// The vector of two finite doubles.
    pub fn from_doubles(x: f64, y: f64) -> Self {
        Self { x: Real::from_double(x), y: Real::from_double(y) }
    }

    /// Scalar product.
    pub fn dot(&self, other: &Self) -> Real {
        &self.x * &other.x + &self.y * &other.y
    }

    /// z of the cross product: positive when `other` is to the left.
    pub fn cross(&self, other: &Self) -> Real {
        &self.x * &other.y - &self.y * &other.x
    }

    /// Square of the length.
    pub fn squared(&self) -> Real {
        self.x.square() + self.y.square()
    }

    /// Length.
    pub fn length(&self) -> Real {
        self.squared().sqrt()
    }

    /// Euclidean distance of two points.
    pub fn distance(&self, other: &Self) -> Real {
        (self - other).length()
    }

    /// Surely farther from each other than `limit`, by doubles that enclose the coordinates: only saves
    /// time, `false` says nothing.
    pub fn is_far(&self, other: &Self, limit: &Real) -> bool {
        let [_, limit] = limit.bounds();
        let apart = |a: &Real, b: &Real| {
            let ([a_least, a_most], [b_least, b_most]) = (a.bounds(), b.bounds());
            (a_least - b_most).max(b_least - a_most).next_down() > limit
        };
        apart(&self.x, &other.x) || apart(&self.y, &other.y)
    }

    /// `factor` times the vector.
    #[must_use]
    pub fn scaled(&self, factor: &Real) -> Self {
        Self { x: &self.x * factor, y: &self.y * factor }
    }

    /// The vector turned left by a right angle.
    #[must_use]
    pub fn left(&self) -> Self {
        Self { x: -&self.y, y: self.x.clone() }
    }
}

impl Add for &Vector {
    type Output = Vector;
    fn add(self, other: &Vector) -> Vector {
        Vector { x: &self.x + &other.x, y: &self.y + &other.y }
    }
}

impl Sub for &Vector {
    type Output = Vector;
    fn sub(self, other: &Vector) -> Vector {
        Vector { x: &self.x - &other.x, y: &self.y - &other.y }
    }
}

impl Neg for &Vector {
    type Output = Vector;
    fn neg(self) -> Vector {
        Vector { x: -&self.x, y: -&self.y }
    }
}

/// An origin and a direction used as given: (a, b) is `origin + a direction + b left(direction)`.
#[derive(Clone, Debug)]
pub struct Frame {
    /// Origin, m.
    pub origin: Vector,
    /// (cos, sin), not normalised.
    pub direction: Vector,
}

impl Frame {
    /// The point with the coordinates (a, b).
    pub fn point(&self, a: &Real, b: &Real) -> Vector {
        let forward = self.direction.scaled(a);
        let sideways = self.direction.left().scaled(b);
        &(&self.origin + &forward) + &sideways
    }

    /// The coordinates of a point.
    pub fn coordinates(&self, point: &Vector) -> Vector {
        let offset = point - &self.origin;
        let square = self.direction.squared();
        Vector {
            x: self.direction.dot(&offset) / &square,
            y: self.direction.left().dot(&offset) / &square,
        }
    }
}
