//! Closed rectangles and whether two of them share a point
//! (`spec/3-stages.md#low-level-collision-check-llcc`).

use crate::numbers::plane::Vector;
use crate::numbers::rounding::Real;

/// The points centre + a direction + b turned direction, abs(a) <= L/2, abs(b) <= W/2.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Rectangle {
    /// Centre, m.
    pub(crate) centre: Vector,
    /// (cos, sin) as given, not normalised (DOM-03).
    pub(crate) direction: Vector,
    /// Length L, m.
    pub(crate) length: f64,
    /// Width W, m.
    pub(crate) width: f64,
}

/// Whether the two rectangles may share a point.
pub(crate) fn possibly_touch(a: &Rectangle, b: &Rectangle) -> bool {
    !separated(a, b, Real::certainly_below)
}

/// Whether the two rectangles certainly share a point.
pub(crate) fn certainly_touch(a: &Rectangle, b: &Rectangle) -> bool {
    !separated(a, b, Real::possibly_below)
}

/// Separating axes of two convex sets whose sides are orthogonal: the axis of a side separates them
/// when the extents along it leave a gap (`is_below`: half of both is below the distance of the
/// centres).
fn separated(a: &Rectangle, b: &Rectangle, is_below: impl Fn(Real, Real) -> bool) -> bool {
    let (apart, turn) = (b.centre - a.centre, Turn::between(a, b));
    let separates = |one: &Rectangle, other: &Rectangle| {
        let gaps = one.components(apart).map(Real::abs);
        turn.reach(one, other).iter().zip(gaps).any(|(&reach, gap)| is_below(reach, gap))
    };
    separates(a, b) || separates(b, a)
}

/// Whether the first rectangle certainly shares a point with the second one, now or later, which moves
/// on with a velocity for ever.
///
/// Separating axes of a rectangle and the strip that another one sweeps over: the axis of a side
/// separates them when there is a gap along it that the way does not close; and the one across the way, along
/// which the strip is as wide as what moves. What does not move has no such axis.
pub(crate) fn certainly_met(a: &Rectangle, b: &Rectangle, velocity: Vector) -> bool {
    let (apart, turn) = (b.centre - a.centre, Turn::between(a, b));
    let stays = |reach: Real, gap: Real, rate: Real| {
        reach.possibly_below(gap) && Real::ZERO.possibly_at_most(rate)
    };
    let separates = |one: &Rectangle, other: &Rectangle| {
        let sides = turn.reach(one, other).into_iter().zip(one.components(apart));
        let mut sides = sides.zip(one.components(velocity));
        sides.any(|((reach, gap), rate)| stays(reach, gap, rate) || stays(reach, -gap, -rate))
    };
    let across = |it: &Rectangle| {
        let [along, across] = it.components(velocity).map(Real::abs);
        across * half(it.length) + along * half(it.width)
    };
    let passes = (across(a) + across(b)).possibly_below(velocity.cross(apart).abs());
    !(passes || separates(a, b) || separates(b, a))
}

impl Rectangle {
    /// The components of a vector along the direction and to the left of it, times its length.
    fn components(&self, vector: Vector) -> [Real; 2] {
        [vector.dot(self.direction), self.direction.cross(vector)]
    }
}

/// How two rectangles are turned to each other: the components of one direction along the other and
/// across it, without signs.
struct Turn {
    along: Real,
    across: Real,
}

impl Turn {
    fn between(a: &Rectangle, b: &Rectangle) -> Self {
        let along = a.direction.dot(b.direction).abs();
        Self { along, across: a.direction.cross(b.direction).abs() }
    }

    /// Half the extents of both, together, along the sides of one of them.
    fn reach(&self, one: &Rectangle, other: &Rectangle) -> [Real; 2] {
        let own = one.direction.dot(one.direction);
        let (length, width) = (half(other.length), half(other.width));
        [
            own * half(one.length) + (self.along * length + self.across * width),
            own * half(one.width) + (self.across * length + self.along * width),
        ]
    }
}

fn half(length: f64) -> Real {
    Real::new(0.5 * length)
}

#[cfg(test)]
mod tests;
