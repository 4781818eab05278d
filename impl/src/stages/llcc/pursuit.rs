//! The CAV as seen by someone who moves along with it at its mean velocity: it hardly moves, so
//! that what passes by with another velocity misses a small box, which one test decides for all
//! points, and else is beside it for a short time only (`sweep` has the box as the road sees it).
//!
//! Plain doubles: places are below 2^27 m, and each comparison rounds less than 16 times; `MARGIN` is
//! more than that. A velocity or a time with which that would not hold is not taken: then nothing
//! misses.

use crate::input::cycle::{Ego, TrajectoryPoint};
use crate::numbers::range::{EMPTY, extend, larger, smaller};
use crate::stages::llcc::sweep::{MARGIN, MovingRectangle, minus, split};

/// m/s
const FASTEST: f64 = 1e3;
/// s
const LONGEST: f64 = 100.0;
/// s
const SOON: f64 = 1e-2;

/// A box that contains the CAV's rectangles as seen so.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pursuit {
    /// The mean velocity, m/s.
    velocity: [f64; 2],
    /// From where places are counted, m, and the direction of the box.
    origin: [f64; 2],
    along: [f64; 2],
    /// Centre and half the extents of the box, m.
    centre: [f64; 2],
    half: [f64; 2],
    /// The same of one along the axes of the plane.
    upright: [[f64; 2]; 2],
    /// The first and the last time, s.
    seconds: [f64; 2],
    /// The middle of the times, and half of their range, s.
    middle: f64,
    spread: f64,
}

/// A rectangle as seen so, with any velocity: at the time 0 from the centre of the box, m; half the
/// extents of both, m.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Passing<'p> {
    pursuit: &'p Pursuit,
    from: [f64; 2],
    reach: [f64; 2],
}

impl Pursuit {
    /// `poses`: with the time of each, s, which never decreases.
    pub(crate) fn new<'p>(
        poses: impl Iterator<Item = (Ego, &'p TrajectoryPoint, f64)> + Clone,
    ) -> Self {
        let places = poses.map(|(ego, at, time)| (MovingRectangle::footprint(&ego, at), time));
        let ends = (places.clone().next(), places.clone().last());
        let (Some((first, from)), Some((last, to))) = ends else { return Self::anywhere() };
        let origin = first.centre;
        let (moved, time) = (minus(last.centre, origin), to - from);
        let length = libm::sqrt(moved[0] * moved[0] + moved[1] * moved[1]);
        let is_bounded = from.abs() < LONGEST && to.abs() < LONGEST && length <= FASTEST * time;
        if !is_bounded || time < 1e-2 {
            return Self::anywhere();
        }
        let velocity = moved.map(|metres| metres / time);
        let along = if length > 1e-3 { moved.map(|metres| metres / length) } else { [1.0, 0.0] };
        let (mut ranges, mut upright) = ([EMPTY; 2], [EMPTY; 2]);
        for (footprint, time) in places {
            let back = velocity.map(|rate| rate * time);
            let place = minus(minus(footprint.centre, origin), back);
            extend(&mut ranges, split(along, place), footprint.extents(along));
            extend(&mut upright, place, footprint.upright());
        }
        let (middle, half) = (|[a, b]: [f64; 2]| 0.5 * (a + b), |[a, b]: [f64; 2]| 0.5 * (b - a));
        Self {
            velocity,
            origin,
            along,
            centre: ranges.map(middle),
            half: ranges.map(half),
            upright: [upright.map(middle), upright.map(half)],
            seconds: [from, to],
            middle: 0.5 * (from + to),
            spread: 0.5 * time + 1e-9,
        }
    }

    /// The CAV where it stands and waits, from a time in s on, for ever.
    pub(crate) fn standing(footprint: &MovingRectangle, from: f64) -> Self {
        Self {
            origin: footprint.centre,
            along: footprint.direction,
            half: footprint.extents(footprint.direction),
            upright: [[0.0; 2], footprint.upright()],
            seconds: [from, f64::INFINITY],
            ..Self::anywhere()
        }
    }

    /// Nothing misses it.
    const fn anywhere() -> Self {
        Self {
            velocity: [0.0; 2],
            origin: [0.0; 2],
            along: [1.0, 0.0],
            centre: [0.0; 2],
            half: [f64::INFINITY; 2],
            upright: [[0.0; 2], [f64::INFINITY; 2]],
            seconds: [f64::NEG_INFINITY, f64::INFINITY],
            middle: 0.0,
            spread: 0.0,
        }
    }

    #[inline]
    pub(crate) fn passing(&self, object: &MovingRectangle) -> Passing<'_> {
        let [a, b] = split(self.along, minus(object.centre, self.origin));
        let ([ca, cb], [ha, hb]) = (self.centre, self.half);
        let [ra, rb] = object.extents(self.along);
        let reach = [ha + ra + MARGIN, hb + rb + MARGIN];
        Passing { pursuit: self, from: [a - ca, b - cb], reach }
    }

    /// The box in which an item of an earlier list has to be, of that age in s, so that an object
    /// that comes from there, no faster than `speed` in m/s, may touch the CAV at one of the
    /// points; the least above the greatest when there is no such place. `object`: where it is at
    /// the time 0. Along each axis: what is `gap` m away comes from at least `gap` age / t farther
    /// behind, as seen from the CAV, t being the last time.
    pub(crate) fn comes_from(
        &self,
        object: &MovingRectangle,
        speed: f64,
        age: f64,
    ) -> [[f64; 2]; 2] {
        let ([ux, uy], [[cx, cy], [hx, hy]]) = (self.velocity, self.upright);
        let (first, last) = (larger(-self.seconds[0], 0.0), self.seconds[1]);
        // Before the time 0 an object moves back, but not far.
        let more = MARGIN + (speed + ux.abs() + uy.abs()) * first;
        let [reach_x, reach_y] = object.upright();
        let rate = if last > 0.0 { age / last } else { 0.0 };
        let most = speed * age + MARGIN;
        let range = |at: f64, from: f64, reach: f64, moved: f64| {
            let (below, above) = (-reach - from, from - reach);
            let least = if above > 0.0 { larger(above * rate - moved, -most) } else { -most };
            let greatest = if below > 0.0 { smaller(-below * rate - moved, most) } else { most };
            [at + least - MARGIN, at + greatest + MARGIN]
        };
        let ([x, y], [from_x, from_y]) = (object.centre, minus(object.centre, self.origin));
        let (hx, hy) = (hx + reach_x + more, hy + reach_y + more);
        [range(x, from_x - cx, hx, ux * age), range(y, from_y - cy, hy, uy * age)]
    }
}

impl Pursuit {
    /// With which velocities along the axes of the plane an object may touch the CAV at one of the
    /// points, m/s; all when the first of them is sooner than `SOON`. `object`: where it is at the time 0.
    /// Along each axis, as seen from the CAV: what has to go a way to one side goes it until the first
    /// time at the fastest, and until the last at the slowest.
    pub(crate) fn velocities(&self, object: &MovingRectangle) -> [[f64; 2]; 2] {
        let ([ux, uy], [[cx, cy], [hx, hy]]) = (self.velocity, self.upright);
        let [first, last] = self.seconds;
        let is_later = first > SOON;
        if !is_later {
            return [[f64::NEG_INFINITY, f64::INFINITY]; 2];
        }
        let (soon, late) = (1.0 / first, 1.0 / last);
        let ([reach_x, reach_y], [x, y]) = (object.upright(), minus(self.origin, object.centre));
        let (hx, hy) = (hx + reach_x + MARGIN, hy + reach_y + MARGIN);
        let range = |to: f64, half: f64, mean: f64| {
            let (least, greatest) = (to - half, to + half);
            let slowest = mean + least * if least < 0.0 { soon } else { late };
            [slowest, mean + greatest * if greatest > 0.0 { soon } else { late }]
        };
        [range(x + cx, hx, ux), range(y + cy, hy, uy)]
    }
}

impl Passing<'_> {
    #[inline]
    fn seen(&self, velocity: [f64; 2]) -> [f64; 2] {
        split(self.pursuit.along, minus(velocity, self.pursuit.velocity))
    }

    /// Whether the line on which it passes by with this velocity certainly misses the box.
    #[inline]
    pub(crate) fn misses_on_line(&self, velocity: [f64; 2]) -> bool {
        let ([a, b], [ra, rb], [va, vb]) = (self.from, self.reach, self.seen(velocity));
        (va * b - vb * a).abs() > va.abs() * rb + vb.abs() * ra
    }

    /// Whether it certainly touches the CAV at none of the points with this velocity: that line
    /// misses the box, or it is too far along or across.
    #[inline]
    pub(crate) fn misses(&self, velocity: [f64; 2]) -> bool {
        let ([a, b], [ra, rb], [va, vb]) = (self.from, self.reach, self.seen(velocity));
        let &Pursuit { middle, spread, .. } = self.pursuit;
        self.misses_on_line(velocity)
            || (a + va * middle).abs() > ra + va.abs() * spread
            || (b + vb * middle).abs() > rb + vb.abs() * spread
    }

    /// When it may touch the CAV, s; the first after the last when never.
    pub(crate) fn window(&self, velocity: [f64; 2]) -> [f64; 2] {
        let mut window = self.pursuit.seconds;
        let axes = self.from.into_iter().zip(self.seen(velocity)).zip(self.reach);
        for ((from, rate), reach) in axes {
            let [first, last] = window;
            if rate.abs() > 1e-3 {
                let (middle, spread) = (-from / rate, reach / rate.abs());
                window = [larger(first, middle - spread), smaller(last, middle + spread)];
            } else if from.abs() > reach + 1e-3 * LONGEST {
                return [f64::INFINITY, f64::NEG_INFINITY];
            }
        }
        window
    }
}

#[cfg(test)]
mod tests;
