//! Closed rectangles (`spec/3-stages.md#low-level-collision-check-llcc`).

use crate::numbers::reading::Comparisons;
use crate::numbers::real::Real;
use crate::numbers::vector::{Frame, Vector};

/// A rectangle around the origin of its frame. The frame's direction is used as given, so the
/// sides have the length `2 half_length |direction|` and `2 half_width |direction|`.
#[derive(Clone, Debug)]
pub struct Rectangle {
    /// Centre and direction.
    pub frame: Frame,
    /// Half of the length, m; a negative one makes the rectangle empty.
    pub half_length: Real,
    /// Half of the width, m; a negative one makes the rectangle empty.
    pub half_width: Real,
}

impl Rectangle {
    /// The rectangle of this length and width, m.
    pub fn new(frame: Frame, length: &Real, width: &Real) -> Self {
        let two = Real::from_integer(2);
        Self { frame, half_length: length / &two, half_width: width / &two }
    }

    fn is_empty(&self) -> bool {
        self.half_length < Real::zero() || self.half_width < Real::zero()
    }

    fn corners(&self) -> [Vector; 4] {
        let (l, w) = (&self.half_length, &self.half_width);
        let corner = |a: &Real, b: &Real| self.frame.point(a, b);
        [corner(l, w), corner(&-l, w), corner(&-l, &-w), corner(l, &-w)]
    }
}

/// The rectangles share a point, or nearly so: half length and half width of the first are raised by
/// the margin.
pub fn may_share_a_point(reads: &Comparisons, a: &Rectangle, b: &Rectangle) -> bool {
    let raised = Rectangle {
        frame: a.frame.clone(),
        half_length: reads.raised(&a.half_length),
        half_width: reads.raised(&a.half_width),
    };
    share_a_point(&raised, b)
}

/// The rectangles share a point: no axis parallel to a side of one of them separates their
/// corners (two convex polygons are disjoint exactly when the normal of some side separates them).
pub fn share_a_point(a: &Rectangle, b: &Rectangle) -> bool {
    if a.is_empty() || b.is_empty() {
        return false;
    }
    let (corners_a, corners_b) = (a.corners(), b.corners());
    [&a.frame.direction, &b.frame.direction].into_iter().all(|direction| {
        [direction, &direction.left()].into_iter().all(|axis| {
            let (a, b) = (extent(&corners_a, axis), extent(&corners_b, axis));
            a.0 <= b.1 && b.0 <= a.1
        })
    })
}

/// Least and greatest scalar product with the axis.
fn extent(points: &[Vector; 4], axis: &Vector) -> (Real, Real) {
    let [a, b, c, d] = points.each_ref().map(|point| point.dot(axis));
    let least = (&a).min(&b).min(&c).min(&d).clone();
    (least, a.max(b).max(c).max(d))
}
