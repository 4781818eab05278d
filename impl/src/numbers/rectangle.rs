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
    let pair = Pair::new(a, b);
    let separated = |one, other| {
        pair.along_sides(one, other).iter().any(|&(gap, reach)| reach.certainly_below(gap))
    };
    !(separated(a, b) || separated(b, a))
}

/// Whether the two rectangles share a point for certain: the extents certainly leave no gap along
/// any side.
pub(crate) fn certainly_touch(a: &Rectangle, b: &Rectangle) -> bool {
    let pair = Pair::new(a, b);
    let joined = |one, other| {
        pair.along_sides(one, other).iter().all(|&(gap, reach)| gap.certainly_at_most(reach))
    };
    joined(a, b) && joined(b, a)
}

/// How two rectangles lie to one another.
struct Pair {
    apart: Vector,
    along: Real,
    across: Real,
}

impl Pair {
    fn new(a: &Rectangle, b: &Rectangle) -> Self {
        Self {
            apart: b.centre - a.centre,
            along: a.direction.dot(b.direction).abs(),
            across: a.direction.cross(b.direction).abs(),
        }
    }

    /// Along the length and along the width of the one: how far the centres are apart, and half
    /// the extents of both together.
    fn along_sides(&self, one: &Rectangle, other: &Rectangle) -> [(Real, Real); 2] {
        let &Self { apart, along, across } = self;
        let half = |length: f64| Real::new(0.5 * length);
        let own = one.direction.dot(one.direction);
        [
            (
                apart.dot(one.direction).abs(),
                own * half(one.length) + (along * half(other.length) + across * half(other.width)),
            ),
            (
                one.direction.cross(apart).abs(),
                own * half(one.width) + (across * half(other.length) + along * half(other.width)),
            ),
        ]
    }
}
