//! Closed rectangles and whether two of them share a point
//! (`spec/3-stages.md#low-level-collision-check-llcc`).

use crate::numbers::plane::Vector;
use crate::numbers::rounding::Real;

/// The points centre + a direction + b turned direction, abs(a) <= L/2, abs(b) <= W/2.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Rectangle {
    /// Centre, m.
    pub(crate) centre: Vector,
    /// (cos, sin) as given, not normalised.
    pub(crate) direction: Vector,
    /// Length L, m.
    pub(crate) length: f64,
    /// Width W, m.
    pub(crate) width: f64,
}

/// Whether the two rectangles may share a point: unless the extents along a side of one of them
/// certainly leave a gap (separating axes of two convex sets whose sides are orthogonal).
pub(crate) fn possibly_touch(a: &Rectangle, b: &Rectangle) -> bool {
    let apart = b.centre - a.centre;
    let along = a.direction.dot(b.direction).abs();
    let across = a.direction.cross(b.direction).abs();
    let half = |length: f64| Real::new(0.5 * length);
    let separated = |one: &Rectangle, other: &Rectangle| {
        let own = one.direction.dot(one.direction);
        let sides = [
            (own * half(one.length), along * half(other.length) + across * half(other.width)),
            (own * half(one.width), across * half(other.length) + along * half(other.width)),
        ];
        let gaps = [apart.dot(one.direction).abs(), one.direction.cross(apart).abs()];
        sides.iter().zip(gaps).any(|(&(own, other), gap)| (own + other).certainly_below(gap))
    };
    !(separated(a, b) || separated(b, a))
}
