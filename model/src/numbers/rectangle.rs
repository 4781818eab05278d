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

    /// The rectangle with `of` each of half length and half width, m.
    #[must_use]
    pub fn with_halves(&self, of: impl Fn(&Real) -> Real) -> Self {
        let (half_length, half_width) = (of(&self.half_length), of(&self.half_width));
        Self { frame: self.frame.clone(), half_length, half_width }
    }

    fn is_empty(&self) -> bool {
        self.half_length < Real::zero() || self.half_width < Real::zero()
    }

    /// The greatest scalar product of the axis with a point of it seen from its centre.
    pub fn half_extent(&self, axis: &Vector) -> Real {
        let Frame { direction, .. } = &self.frame;
        &self.half_length * direction.dot(axis).abs()
            + &self.half_width * direction.cross(axis).abs()
    }
}

/// The rectangles share a point, or nearly so: half length and half width of the first are raised by
/// the margin.
pub fn may_share_a_point(reads: &Comparisons, a: &Rectangle, b: &Rectangle) -> bool {
    share_a_point(&a.with_halves(|half| reads.raised(half)), b)
}

/// The rectangles share a point: no axis parallel to a side of one of them separates them (two convex
/// polygons are disjoint exactly when the normal of some side separates them).
pub fn share_a_point(a: &Rectangle, b: &Rectangle) -> bool {
    if a.is_empty() || b.is_empty() {
        return false;
    }
    let apart = &b.frame.origin - &a.frame.origin;
    [&a.frame.direction, &b.frame.direction].into_iter().all(|direction| {
        [direction, &direction.left()]
            .into_iter()
            .all(|axis| apart.dot(axis).abs() <= reach(a, b, axis))
    })
}

/// The greatest scalar product with the axis that the centre of one rectangle can have, seen from that of
/// the other, where the axis does not separate them.
fn reach(a: &Rectangle, b: &Rectangle, axis: &Vector) -> Real {
    a.half_extent(axis) + b.half_extent(axis)
}

/// The rectangle `a` shares a point with `b + w t` for some t >= 0. What `b` sweeps is convex, too: its
/// sides are sides of `b` and parallels of w, so the two are disjoint exactly when the normal of a side
/// of `a`, of `b`, or of w separates them: `w` does not lead against it, and all of `b` is beyond all of `a`.
pub fn is_swept_over(a: &Rectangle, b: &Rectangle, w: &Vector) -> bool {
    if a.is_empty() || b.is_empty() {
        return false;
    }
    let apart = &b.frame.origin - &a.frame.origin;
    [&a.frame.direction, &b.frame.direction, w].into_iter().all(|direction| {
        let left = direction.left();
        [direction, &-direction, &left, &-&left].into_iter().all(|normal| {
            let separates = apart.dot(normal) > reach(a, b, normal);
            !(separates && normal.dot(w) >= Real::zero())
        })
    })
}

/// The rectangle `a` shares a point with `b` moved by some vector between two, both parallel to w. What `b`
/// sweeps is convex: a side of it is one of `b`, or parallel to w, so the two are disjoint exactly when an
/// axis parallel to a side of `a`, or of `b`, or the normal of w separates them.
pub fn is_swept_over_between(
    a: &Rectangle,
    b: &Rectangle,
    w: &Vector,
    moved: &[Vector; 2],
) -> bool {
    if a.is_empty() || b.is_empty() {
        return false;
    }
    let apart = &b.frame.origin - &a.frame.origin;
    let axes = |direction: &Vector| [direction.clone(), direction.left()];
    let axes = [axes(&a.frame.direction), axes(&b.frame.direction)];
    axes.iter().flatten().chain([&w.left()]).all(|axis| {
        let reach = reach(a, b, axis);
        let beyond = moved.each_ref().map(|moved| (&apart + moved).dot(axis));
        let all_after = beyond.iter().all(|distance| *distance > reach);
        let all_before = beyond.iter().all(|distance| -distance > reach);
        !all_after && !all_before
    })
}
