//! How far the hardened profile looks: way instead of arc length, at least `s_stop`, and beyond the
//! end of the trajectory (H-04 of `spec/3-stages.md#hardened-profile`).

use core::ops::RangeInclusive;
use core::slice;

use crate::input::cycle::{Cycle, Ego, TrajectoryPoint};
use crate::input::parameters::Parameters;
use crate::numbers::plane::{Vector, distance};
use crate::numbers::range::{larger, smaller};
use crate::numbers::rounding::Real;
use crate::report::Witness;
use crate::stages::distances::{Number, s_b};

/// `s_stop` = e + v tau + `a_max` tau^2/2 + (v + `a_max` tau)^2/(2 `a_b`), m; `e` is how far
/// the CAV is ahead of the first point.
fn s_stop<N: Number>(cycle: &Cycle<'_>, e: N) -> N {
    let Parameters { tau, a_max, .. } = cycle.parameters;
    let [v, tau, a_max, half] = [cycle.ego.speed, tau, a_max, 0.5].map(N::from_double);
    let reaction = v.times(tau).plus(a_max.times(tau.times(tau)).times(half));
    e.plus(reaction).plus(s_b(&cycle.parameters, v.plus(a_max.times(tau))))
}

/// `s_stop` with e = abs(p - first point), unless the CAV is certainly not ahead of it: then e = 0.
pub(crate) fn exact_s_stop(cycle: &Cycle<'_>, points: &[TrajectoryPoint]) -> Real {
    let Some(first) = points.first() else { return s_stop(cycle, Real::ZERO) };
    let (p, start) = ([cycle.ego.x, cycle.ego.y], [first.x, first.y]);
    let ahead = Vector::between(start, p).dot(Vector::new(first.cos, first.sin));
    let e = if ahead.certainly_at_most(Real::ZERO) { Real::ZERO } else { distance(start, p) };
    s_stop(cycle, e)
}

/// The same in plain doubles, from below and from above: where these cannot tell whether the CAV is
/// ahead, e is between. The coordinates of e are differences of doubles, each off by 2^-53 of
/// itself, and their product with the heading by less than 2^-50 of their sizes.
pub(crate) fn plain_s_stop(cycle: &Cycle<'_>, first: &TrajectoryPoint) -> [f64; 2] {
    let (dx, dy) = (cycle.ego.x - first.x, cycle.ego.y - first.y);
    let (ahead, size) = (dx * first.cos + dy * first.sin, dx.abs() + dy.abs());
    let e = libm::sqrt(dx * dx + dy * dy);
    let least = if ahead > size * 1e-15 + 1e-300 { e } else { 0.0 };
    let most = if ahead < -(size * 1e-15 + 1e-300) { 0.0 } else { e };
    [least, most].map(|e| s_stop(cycle, e))
}

/// The way of a step, m.
pub(crate) fn way(from: &TrajectoryPoint, to: &TrajectoryPoint) -> Real {
    let u = Vector::between([from.x, from.y], [to.x, to.y]);
    u.dot(Vector::new(from.cos, from.sin)).max(Real::ZERO)
}

/// The same in plain doubles, off by less than 2^-50 of the two coordinates of the step.
#[inline]
pub(crate) fn plain_way(from: &TrajectoryPoint, to: &TrajectoryPoint) -> f64 {
    larger((to.x - from.x) * from.cos + (to.y - from.y) * from.sin, 0.0)
}

/// The places beyond the end of a trajectory, by which the CAV's centre is ahead of the last point:
/// multiples of a length.
pub(crate) struct PlacesBeyond {
    multiples: RangeInclusive<i64>,
    /// m
    length: f64,
}

/// A quarter of a metre, or the length of a CAV that is shorter.
const QUARTER: f64 = 0.25;

impl PlacesBeyond {
    #[allow(clippy::reversed_empty_ranges, reason = "it has to be empty")]
    pub(crate) const NONE: Self = Self { multiples: 1..=0, length: QUARTER };

    /// From the first multiple above `center_offset` to the first that is certainly not below
    /// `center_offset` + `s_stop` - way. H-12 lets no trajectory end more than L before `s_stop`; a
    /// stage that is run alone looks no farther than that either.
    pub(crate) fn new(cycle: &Cycle<'_>, points: &[TrajectoryPoint]) -> Self {
        let steps = points.iter().zip(points.iter().skip(1));
        let driven = steps.fold(Real::ZERO, |driven, (a, b)| driven + way(a, b));
        let missing = exact_s_stop(cycle, points) - driven;
        let missing = missing.min(Real::new(cycle.ego.length));
        if missing.certainly_at_most(Real::ZERO) {
            return Self::NONE;
        }
        let length = smaller(QUARTER, cycle.ego.length);
        let multiple = |k: i64| Real::integer(k) * Real::new(length);
        let offset = Real::new(cycle.ego.center_offset);
        let needed = offset + missing;
        let first = least_multiple(offset, length, |k| offset.certainly_below(multiple(k)));
        let last = least_multiple(needed, length, |k| needed.certainly_at_most(multiple(k)));
        Self { multiples: first..=last, length }
    }

    /// How many there are.
    pub(crate) fn count(&self) -> usize {
        self.multiples.clone().count()
    }

    /// The CAV at each of the places, if it is at the last point.
    pub(crate) fn moved_on(&self, ego: Ego) -> impl Iterator<Item = Ego> + Clone + use<> {
        let length = self.length;
        self.multiples.clone().map(move |k| {
            let mut moved = Ego { center_offset: length * Real::integer(k).value(), ..ego };
            if length < QUARTER {
                // A multiple of L is rounded, by less than 1e-13 m: the CAV is made larger by more,
                // its rectangle along the heading, its disks, of which the length moves the centres
                // by less than 1e-12 m, by the width.
                moved.length += 1e-12;
                moved.width += 1e-9;
            }
            moved
        })
    }

    /// The first place where `find` finds something: it gets the cycle with the CAV moved on, and
    /// the last of the points.
    pub(crate) fn first<'a>(
        &self,
        cycle: &Cycle<'a>,
        points: &[TrajectoryPoint],
        mut find: impl FnMut(&Cycle<'a>, &[TrajectoryPoint]) -> Option<Witness>,
    ) -> Option<Witness> {
        let last = points.last()?;
        self.moved_on(cycle.ego).zip(points.len()..).find_map(|(ego, index)| {
            let moved = Cycle { ego, ..*cycle };
            find(&moved, slice::from_ref(last)).map(|witness| witness.at_point(index))
        })
    }
}

/// The least multiple of the length for which `is_enough` holds, near a number; the one after the
/// next of the number when rounding leaves it open.
#[allow(clippy::cast_possible_truncation, reason = "below 2^16")]
fn least_multiple(near: Real, length: f64, is_enough: impl Fn(i64) -> bool) -> i64 {
    let quotient = libm::floor(near.value() / length) as i64;
    let candidates = quotient.saturating_sub(1)..=quotient.saturating_add(1);
    candidates.into_iter().find(|&k| is_enough(k)).unwrap_or(quotient.saturating_add(2))
}
