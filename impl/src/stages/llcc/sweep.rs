//! What the CAV sweeps over at some trajectory points: a box that contains all its rectangles. An
//! object that stays outside this box touches none of them, which one test decides for all points
//! (`spec/3-stages.md#low-level-collision-check-llcc`).
//!
//! Plain doubles: coordinates are below 2^26 m, and each comparison rounds less than 16 times, so
//! that it errs by less than 2^-23 m; `MARGIN` is more than that. Whatever is not certainly apart
//! is left to `collision`.

use crate::input::cycle::{Detection, Ego, Track, TrajectoryPoint};
use crate::numbers::range::{EMPTY, extend, larger, smaller};

/// m
pub(crate) const MARGIN: f64 = 1e-6;
/// By how much more than the text half the CAV's length and width count, m: more than what is compared errs by,
/// and less than half of the least margin of the strict model (DOM-01, MARGIN-01).
pub(crate) const SLACK: f64 = 4e-9;

/// A rectangle that moves with constant velocity.
#[derive(Clone, Copy, Debug)]
pub(crate) struct MovingRectangle {
    /// Centre at the time 0, m.
    pub(crate) centre: [f64; 2],
    /// (cos, sin)
    pub(crate) direction: [f64; 2],
    /// m/s
    pub(crate) velocity: [f64; 2],
    /// Length and width, m.
    pub(crate) size: [f64; 2],
}

impl MovingRectangle {
    /// A track goes on with its velocity, its direction unchanged (S3-01).
    pub(crate) const fn track(track: &Track) -> Self {
        let &Track { x, y, cos, sin, vx, vy, length, width, .. } = track;
        Self { centre: [x, y], direction: [cos, sin], velocity: [vx, vy], size: [length, width] }
    }

    /// A detection stands still (S4-01).
    pub(crate) const fn detection(detection: &Detection) -> Self {
        let &Detection { x, y, cos, sin, length, width } = detection;
        Self { centre: [x, y], direction: [cos, sin], velocity: [0.0, 0.0], size: [length, width] }
    }

    /// The CAV at a trajectory point.
    pub(crate) fn footprint(ego: &Ego, point: &TrajectoryPoint) -> Self {
        let &TrajectoryPoint { x, y, cos, sin, .. } = point;
        let centre = [x + ego.center_offset * cos, y + ego.center_offset * sin];
        Self { centre, ..Self::cav(ego, [cos, sin]) }
    }

    /// The CAV, its reference point at the origin.
    pub(crate) fn cav(ego: &Ego, [cos, sin]: [f64; 2]) -> Self {
        Self {
            centre: [ego.center_offset * cos, ego.center_offset * sin],
            direction: [cos, sin],
            velocity: [0.0, 0.0],
            size: [ego.length, ego.width],
        }
    }

    /// The same, counting from another point than the origin.
    pub(crate) fn seen_from(&self, point: [f64; 2]) -> Self {
        Self { centre: minus(self.centre, point), ..*self }
    }

    /// Where the centre is after a time in s.
    pub(crate) fn after(&self, seconds: f64) -> [f64; 2] {
        let ([x, y], [vx, vy]) = (self.centre, self.velocity);
        [x + vx * seconds, y + vy * seconds]
    }

    /// At least half the extent along any direction.
    pub(crate) fn reach(&self) -> f64 {
        let [length, width] = self.size;
        (length + width) * (0.5 * (1.0 + 1e-6))
    }

    /// Half the extents along a direction and across it.
    pub(crate) fn extents(&self, axis: [f64; 2]) -> [f64; 2] {
        let ([length, width], [along, across]) = (self.size, split(axis, self.direction));
        let (along, across) = (0.5 * along.abs(), 0.5 * across.abs());
        [length * along + width * across, length * across + width * along]
    }

    /// Half the extents of this and another rectangle, together, along the sides of this one.
    fn halves(&self, other: &Self) -> [f64; 2] {
        let ([length, width], [cos, sin]) = (self.size, self.direction);
        let own = 0.5 * (cos * cos + sin * sin);
        let [along, across] = other.extents(self.direction);
        [own * length + along, own * width + across]
    }

    /// Whether the rectangle shares no point with another one, whose centre is so far from its own: the axis of
    /// a side of one of the two separates them. `error`: more than that errs, m.
    pub(crate) fn is_apart(&self, other: &Self, between: [f64; 2], error: f64) -> bool {
        let separates = |one: &Self, other: &Self| {
            let [along, across] = split(one.direction, between);
            let [length, width] = one.halves(other);
            along.abs() > length + error || across.abs() > width + error
        };
        separates(self, other) || separates(other, self)
    }

    /// The same of all that the other one sweeps over while it moves so far: the way closes no gap along such
    /// an axis, or the axis across the way separates them, along which the strip is as wide as what moves.
    /// Where products with the way underflow, it is too short for that one to make a difference.
    pub(crate) fn is_clear_of(
        &self,
        other: &Self,
        between: [f64; 2],
        moved: [f64; 2],
        error: f64,
    ) -> bool {
        let separates = |one: &Self, other: &Self| {
            let [gaps, rates] = [between, moved].map(|it| split(one.direction, it));
            let mut sides = gaps.into_iter().zip(rates).zip(one.halves(other));
            sides.any(|((gap, rate), half)| {
                let (to, half) = (gap + rate, half + error);
                smaller(gap, to) > half || larger(gap, to) < -half
            })
        };
        if separates(self, other) || separates(other, self) {
            return true;
        }
        let ([x, y], [_, across]) = (moved, split(moved, between));
        let half = self.extents(moved)[1] + other.extents(moved)[1];
        across.abs() > half + error * (x.abs() + y.abs()) + f64::MIN_POSITIVE
    }

    /// Whether the rectangle certainly shares no point with another one, at the time 0.
    pub(crate) fn certainly_apart(&self, other: &Self) -> bool {
        self.is_apart(other, minus(other.centre, self.centre), MARGIN)
    }

    /// Whether the rectangle certainly shares a point with another one, at the time 0: no axis of a side separates them.
    pub(crate) fn certainly_touches(&self, other: &Self) -> bool {
        !self.is_apart(other, minus(other.centre, self.centre), -MARGIN)
    }

    /// Whether the centres are certainly at least `limit` apart, at the time 0.
    pub(crate) fn certainly_far(&self, other: &Self, limit: f64) -> bool {
        let [x, y] = minus(other.centre, self.centre);
        let limit = limit + MARGIN;
        x * x + y * y > limit * limit * (1.0 + 1e-15)
    }
}

/// Boxes that contain the CAV's rectangles at some points, and the times of these points.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sweep {
    /// Centre and half the extents of a box along the axes of the plane: what is far off, as most
    /// objects are, misses it already when it is taken for a square as large as it is anyhow.
    upright: [[f64; 2]; 2],
    origin: [f64; 2],
    /// Any direction: from the first place to the last one.
    along: [f64; 2],
    centre: [f64; 2],
    half: [f64; 2],
    /// The middle of the times, and half of their range, s.
    seconds: [f64; 2],
}

impl Sweep {
    /// `seconds`: the first and the last time.
    pub(crate) fn new(ego: &Ego, points: &[TrajectoryPoint], seconds: [f64; 2]) -> Self {
        let footprints = points.iter().map(|point| MovingRectangle::footprint(ego, point));
        let place = |footprint: MovingRectangle| footprint.centre;
        let origin = footprints.clone().next().map_or([0.0; 2], place);
        let [x, y] = minus(footprints.clone().next_back().map_or(origin, place), origin);
        let length = libm::sqrt(x * x + y * y);
        let along = if length > 1e-3 { [x / length, y / length] } else { [1.0, 0.0] };
        let (mut turned, mut upright) = ([EMPTY; 2], [EMPTY; 2]);
        for footprint in footprints {
            let place = split(along, minus(footprint.centre, origin));
            extend(&mut turned, place, footprint.extents(along));
            extend(&mut upright, footprint.centre, [footprint.reach(); 2]);
        }
        let [first, last] = seconds;
        let (middle, half) = (|[a, b]: [f64; 2]| 0.5 * (a + b), |[a, b]: [f64; 2]| 0.5 * (b - a));
        Self {
            upright: [upright.map(middle), upright.map(half)],
            origin,
            along,
            centre: turned.map(middle),
            half: turned.map(half),
            seconds: [0.5 * (first + last), 0.5 * (last - first) + 1e-9],
        }
    }

    /// Whether the object certainly touches the CAV at none of the points.
    #[inline]
    pub(crate) fn misses(&self, object: &MovingRectangle) -> bool {
        self.misses_upright(object) || self.misses_turned(object)
    }

    /// Most objects end here. Inlined, so that of each of them only what is asked for is read: half
    /// of the time of stages iii and iv.
    #[inline]
    fn misses_upright(&self, object: &MovingRectangle) -> bool {
        let [middle, spread] = self.seconds;
        let [[cx, cy], [hx, hy]] = self.upright;
        let ([x, y], [vx, vy]) = (object.after(middle), object.velocity);
        let gap_x = (x - cx).abs() - vx.abs() * spread - hx;
        let gap_y = (y - cy).abs() - vy.abs() * spread - hy;
        larger(gap_x, gap_y) > object.reach() + MARGIN
    }

    #[inline(never)]
    fn misses_turned(&self, object: &MovingRectangle) -> bool {
        let [middle, spread] = self.seconds;
        let [a, b] = split(self.along, minus(object.after(middle), self.origin));
        let [va, vb] = split(self.along, object.velocity);
        let [reach_a, reach_b] = object.extents(self.along);
        let ([ca, cb], [ha, hb]) = (self.centre, self.half);
        (a - ca).abs() > ha + reach_a + va.abs() * spread + MARGIN
            || (b - cb).abs() > hb + reach_b + vb.abs() * spread + MARGIN
    }
}

pub(crate) fn minus([ax, ay]: [f64; 2], [bx, by]: [f64; 2]) -> [f64; 2] {
    [ax - bx, ay - by]
}

/// The components of a vector along an axis and to the left of it.
pub(crate) fn split([cos, sin]: [f64; 2], [x, y]: [f64; 2]) -> [f64; 2] {
    [x * cos + y * sin, y * cos - x * sin]
}

#[cfg(test)]
mod tests;
