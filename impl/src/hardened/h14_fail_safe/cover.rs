//! Boxes around the CAV's rectangles at consecutive places, with the time when it may be there: what
//! certainly sweeps over no point of such a box meets the CAV at none of them.
//!
//! Plain doubles. Places count from the CAV's reference point and are below 2^26 m, so that with less than
//! 32 roundings they err by less than 2^-20 m; what is longer errs by less than 1e-12 of itself.

use crate::hardened::h14_fail_safe::motion::Motion;
use crate::hardened::h14_fail_safe::nodes::{Line, Nodes};
use crate::hardened::h14_fail_safe::times::{Times, a_tyre};
use crate::input::cycle::{Cycle, Ego};
use crate::numbers::plane::Vector;
use crate::numbers::range::{EMPTY, extend, larger, smaller};
use crate::numbers::rounding::Real;
use crate::numbers::time::seconds;
use crate::stages::llcc::sweep::{MovingRectangle, minus, split};

/// More than plain doubles err, m.
const ERROR: f64 = 1e-6;
/// The same, of what is long.
const ROUGH: f64 = 1e-12;
/// No two places that follow each other are farther apart, m, and no length grows by more from one to the next.
const APART: f64 = 0.4;
const LONGER: f64 = 0.6;

/// What decides when an object may meet the CAV, s.
#[derive(Clone, Copy, Debug)]
pub(super) struct Clock {
    pub(super) times: Times<f64>,
    /// tau + `t_yield`
    yields: f64,
    /// 1 / (2 `a_yield`), 1 / `a_tyre`
    yielding: f64,
    braking: f64,
    a_tyre: f64,
}

impl Clock {
    pub(super) fn new(cycle: &Cycle<'_>) -> Self {
        let (times, parameters) = (Times::new(cycle), &cycle.parameters);
        let a_tyre = a_tyre(parameters);
        Self {
            times,
            yields: parameters.tau + parameters.t_yield,
            yielding: 0.5 / parameters.a_yield,
            braking: 1.0 / a_tyre,
            a_tyre,
        }
    }

    /// For how long an object of that speed and age moves on, rounded up.
    pub(super) fn longest(&self, speed: f64, age: f64) -> f64 {
        (age + self.until_yielded(speed)) * (1.0 + 1e-9) + 1e-9
    }

    /// H(w) (H-14.10), as rounded as plain doubles are.
    pub(super) fn until_yielded(&self, speed: f64) -> f64 {
        larger(self.times.until_stop, self.yields + speed * self.yielding)
    }

    /// The time in which an object that goes on covers `r_b` of H-14.24: the way that it covers from the time
    /// of its list until so many seconds after now when it brakes.
    pub(super) fn braked(&self, object: &Object, seconds: f64) -> f64 {
        let &Object { speed, least, age, .. } = object;
        let brakes = smaller(larger(age + seconds, 0.0), least * self.braking);
        // No more than half is taken, so that this errs by less than 2^-50 of itself.
        let mean = least - 0.5 * (self.a_tyre * brakes);
        if least > 0.0 { brakes * (mean / speed) } else { 0.0 }
    }
}

/// An object as plain doubles have it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Object {
    /// The centre from the CAV's reference point, at the time of its list.
    pub(super) at: MovingRectangle,
    pub(super) speed: f64,
    /// `w_least`, up to 2^-49 of the speed.
    pub(super) least: f64,
    /// Age of its list, s.
    pub(super) age: f64,
}

impl Object {
    #[inline]
    pub(super) fn new(ego: &Ego, motion: &Motion, clock: &Clock) -> Self {
        let centre = minus(motion.now.centre, [ego.x, ego.y]);
        let [x, y] = motion.now.velocity;
        let speed = libm::sqrt(x * x + y * y);
        // H-14.24, A-09
        let lost = motion.from.map_or(0.0, |(_, dt_ns)| 0.5 * clock.a_tyre * seconds(dt_ns));
        let least = larger(speed - lost, 0.0);
        let at = MovingRectangle { centre, ..motion.now };
        Self { at, speed, least, age: motion.age }
    }

    /// The same, so far from the CAV's reference point, and standing there from now on.
    pub(super) fn standing(&self, from: Vector) -> Self {
        let centre = [from.x, from.y].map(Real::value);
        let at = MovingRectangle { centre, velocity: [0.0; 2], ..self.at };
        Self { at, speed: 0.0, least: 0.0, age: 0.0 }
    }
}

/// A box, and when the CAV may be in it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cover {
    axis: [f64; 2],
    /// Along the axis and across it, from the CAV's reference point.
    ranges: [[f64; 2]; 2],
    /// From when on the CAV may be there, s, and until when, if it may not stand there.
    start: f64,
    end: Option<f64>,
}

impl Cover {
    /// Of nothing, yet, at any time from now on.
    pub(super) const fn new(axis: [f64; 2]) -> Self {
        Self { axis, ranges: [EMPTY; 2], start: 0.0, end: None }
    }

    /// With the windows of places of that least progress and that greatest length.
    pub(super) fn lasts_for(&mut self, [progress, length]: [f64; 2], times: &Times<f64>) {
        let round = |it: f64| it.abs() * ROUGH + ERROR;
        let from = larger(progress - APART - round(progress), 0.0);
        self.start = times.first(from) * (1.0 - 1e-9) - 1e-9;
        let to = length + LONGER + round(length);
        let passes = to < times.s_tyre * (1.0 - ROUGH);
        self.end = passes.then(|| times.last(to) * (1.0 + 1e-9) + 1e-9);
    }

    /// With the CAV at two places and between, of that heading.
    #[inline]
    pub(super) fn add(&mut self, ego: &Ego, places: [[f64; 2]; 2], heading: [f64; 2]) {
        let cav = MovingRectangle::cav(ego, heading);
        let (reach, forward) = (cav.extents(self.axis), split(self.axis, cav.centre));
        for place in places {
            let [along, across] = split(self.axis, place);
            extend(&mut self.ranges, [along + forward[0], across + forward[1]], reach);
        }
    }

    /// The box as seen from an object.
    #[inline]
    pub(super) fn seen_from(&self, at: &MovingRectangle) -> Seen {
        let [a, b] = split(self.axis, at.centre);
        let [[back, front], [right, left]] = self.ranges;
        let error = ERROR + ROUGH * self.size();
        Seen {
            axis: self.axis,
            from: [a - 0.5 * (back + front), b - 0.5 * (right + left)],
            half: [0.5 * (front - back) + error, 0.5 * (left - right) + error],
            direction: split(self.axis, at.direction),
            size: at.size.map(|size| 0.5 * size),
        }
    }

    /// Whether the object certainly sweeps over no point of the box in this time.
    #[inline]
    pub(super) fn misses(&self, object: &Object, clock: &Clock) -> bool {
        let &Object { at, speed, age, .. } = object;
        let until = match self.end {
            Some(end) => age + end,
            None => clock.longest(speed, age),
        };
        let mut seen = self.seen_from(&at);
        seen.half = seen.half.map(|it| it + ROUGH * speed * until);
        if seen.is_passed(at.velocity) {
            return true;
        }
        let Seen { from: [middle_a, middle_b], half, direction: [along, across], .. } = seen;
        let [half_a, half_b] = half;
        let (along, across, [length, width]) = (along.abs(), across.abs(), seen.size);
        let [va, vb] = split(self.axis, at.velocity);
        let from = clock.braked(object, self.start);
        let apart = |middle: f64, rate: f64, half: f64| {
            let (one, other) = (middle + rate * from, middle + rate * until);
            smaller(one, other) > half || larger(one, other) < -half
        };
        apart(middle_a, va, half_a + along * length + across * width)
            || apart(middle_b, vb, half_b + across * length + along * width)
    }

    fn size(&self) -> f64 {
        let [[back, front], [right, left]] = self.ranges;
        larger(front.abs(), back.abs()) + larger(left.abs(), right.abs())
    }
}

/// See `Cover::seen_from`: where the object is from the middle of the box, half of the box, m, and the
/// object's direction and half its size.
#[derive(Clone, Copy, Debug)]
pub(super) struct Seen {
    axis: [f64; 2],
    from: [f64; 2],
    half: [f64; 2],
    direction: [f64; 2],
    size: [f64; 2],
}

impl Seen {
    /// Whether the strip that it sweeps over with this velocity certainly misses the box; products with a
    /// tiny velocity underflow. Without it stage iv of W2 takes half as many instructions more.
    #[inline]
    pub(super) fn is_passed(&self, velocity: [f64; 2]) -> bool {
        let ([a, b], [half_a, half_b]) = (self.from, self.half);
        let [va, vb] = split(self.axis, velocity);
        let ([along, across], [length, width]) = (self.direction, self.size);
        let aside = (va * across - vb * along).abs() * length;
        let reach = va.abs() * half_b + vb.abs() * half_a + aside + f64::MIN_POSITIVE;
        (va * b - vb * a).abs() > reach + (va * along + vb * across).abs() * width
    }
}

/// Some places that follow each other. Without them, by the box around all alone, stage iv of W2 takes a
/// third more instructions.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stretch {
    pub(super) cover: Cover,
    /// On which lines they are: the first and the last one.
    pub(super) lines: [usize; 2],
    /// The least progress, and the greatest length, m.
    from: f64,
    to: f64,
}

/// All places, and stretches of them.
pub(super) struct Covers {
    pub(super) all: Cover,
    stretches: [Stretch; MOST],
    count: usize,
    /// Along the axes of the plane.
    pub(super) upright: [[f64; 2]; 2],
}

/// So many stretches, each of at least a metre.
pub(super) const MOST: usize = 16;

impl Covers {
    /// Of a path, with the CAV so large.
    pub(super) fn new(ego: &Ego, path: Nodes<'_, '_>, times: &Times<f64>) -> Self {
        let h = [ego.cos, ego.sin];
        let all = Cover::new(h);
        let none = Stretch { cover: all, lines: [0; 2], from: f64::MAX, to: 0.0 };
        let mut covers = Self { all, stretches: [none; MOST], count: 0, upright: [EMPTY; 2] };
        let part = times.s_stop / f64::from(u8::try_from(MOST).unwrap_or(u8::MAX));
        let mut to = 0.0;
        for line in path.lines().enumerate() {
            covers.add_line(ego, line, (&mut to, larger(part, 1.0)));
        }
        for Stretch { cover, from, to, .. } in covers.stretches.iter_mut().take(covers.count) {
            cover.lasts_for([*from, *to], times);
        }
        covers
    }

    /// Cut where stretches of that length end; the latest one ends at that length of the path.
    fn add_line(
        &mut self,
        ego: &Ego,
        (number, Line { from, to, heading, length: start, more }): (usize, Line),
        (end, part): (&mut f64, f64),
    ) {
        let (h, u, next) = ([ego.cos, ego.sin], minus(to, from), start + more);
        let at = |length: f64| {
            let share = smaller((length - start) / more, 1.0);
            [from[0] + u[0] * share, from[1] + u[1] * share]
        };
        let (mut place, mut length) = (from, start);
        loop {
            if self.count == 0 || length >= *end && self.count < MOST {
                *end += part;
                let cover = Cover::new(heading);
                self.stretches.iter_mut().skip(self.count).take(1).for_each(|it| {
                    (it.cover, it.lines) = (cover, [number; 2]);
                });
                self.count = self.count.saturating_add(1);
            }
            let is_last = self.count >= MOST || next <= *end;
            let stop = if is_last { to } else { at(*end) };
            let latest = self.count.saturating_sub(1);
            for stretch in self.stretches.iter_mut().skip(latest).take(1) {
                stretch.cover.add(ego, [place, stop], heading);
                stretch.lines[1] = number;
                let [here, there] = [place, stop].map(|at| split(h, at)[0]);
                stretch.from = smaller(stretch.from, smaller(here, there));
                stretch.to = if is_last { next } else { *end };
            }
            self.all.add(ego, [place, stop], heading);
            self.extend_upright(ego, [place, stop], heading);
            if is_last {
                return;
            }
            (place, length) = (stop, *end);
        }
    }

    fn extend_upright(&mut self, ego: &Ego, places: [[f64; 2]; 2], heading: [f64; 2]) {
        let cav = MovingRectangle::cav(ego, heading);
        for [x, y] in places {
            let centre = [x + cav.centre[0], y + cav.centre[1]];
            extend(&mut self.upright, centre, [cav.reach(); 2]);
        }
    }

    /// All places are on these, in order.
    pub(super) fn stretches(&self) -> impl Iterator<Item = &Stretch> {
        self.stretches.iter().take(self.count)
    }

    /// Whether the object certainly meets the CAV at no place.
    #[inline]
    pub(super) fn miss(&self, object: &Object, clock: &Clock) -> bool {
        self.stretches().all(|it| it.cover.misses(object, clock))
    }
}
