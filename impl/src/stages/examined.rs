//! The places that stages iii, iv and v examine: trajectory points up to a horizon, and with H-04
//! the next one and places beyond the end of a remote trajectory
//! (`spec/3-stages.md#hardened-profile`).

use core::ops::RangeInclusive;
use core::slice;

use crate::input::cycle::{Cycle, Profile, TrajectoryPoint};
use crate::numbers::plane::{Vector, distance};
use crate::numbers::range::larger;
use crate::numbers::rounding::Real;
use crate::report::Witness;
use crate::services::configuration::Configuration;
use crate::stages::distances::{Horizon, Number, s_b, s_stop};

/// The places that a stage examines.
pub(crate) struct Examined<'c, 'a> {
    cycle: &'c Cycle<'a>,
    /// Points of the trajectory, from the first on.
    pub(crate) points: &'a [TrajectoryPoint],
    /// H-04: quarters of a metre, by which the CAV's centre is ahead of the last point.
    beyond: RangeInclusive<i64>,
}

impl<'c, 'a> Examined<'c, 'a> {
    pub(crate) fn new(
        cycle: &'c Cycle<'a>,
        points: &'a [TrajectoryPoint],
        horizon: Horizon<'_>,
    ) -> Self {
        let bounds = plain_bounds(cycle, points, horizon);
        let exactly = || exactly_farthest(cycle, points, horizon);
        let within = match cycle.profile {
            Profile::Paper => plainly_within(points, bounds, plain_length)
                .unwrap_or_else(|| within(points, exactly(), length)),
            Profile::Hardened => plainly_within(points, bounds, plain_way_and_size)
                .unwrap_or_else(|| within(points, exactly(), way)),
        };
        if cycle.profile == Profile::Paper {
            let points = points.get(..within).unwrap_or(points);
            return Self { cycle, points, beyond: NOTHING };
        }
        let is_remote =
            matches!(cycle.configuration, Configuration::AllRemote | Configuration::PlanRemote);
        let ends = is_remote && within == points.len();
        let beyond = if ends { quarters_beyond(cycle, points) } else { NOTHING };
        let count = within.saturating_add(1);
        Self { cycle, points: points.get(..count).unwrap_or(points), beyond }
    }

    /// The first place beyond the end where `find` finds something: it gets the cycle with the CAV
    /// moved on, and the last point.
    pub(crate) fn first_beyond(
        &self,
        find: impl Fn(&Cycle<'a>, &[TrajectoryPoint]) -> Option<Witness>,
    ) -> Option<Witness> {
        let last = self.points.last()?;
        self.beyond.clone().zip(self.points.len()..).find_map(|(quarters, index)| {
            let mut moved = *self.cycle;
            moved.ego.center_offset = 0.25 * Real::integer(quarters).value();
            find(&moved, slice::from_ref(last)).map(|witness| witness.at_point(index))
        })
    }
}

#[allow(clippy::reversed_empty_ranges, reason = "it has to be empty")]
const NOTHING: RangeInclusive<i64> = 1..=0;

/// H-04: from the first quarter above `center_offset` to the first that is certainly not below
/// `center_offset` + `s_stop` - way. H-12 lets no trajectory end more than L before `s_stop`;
/// a stage that is run alone looks no farther than that either.
#[allow(clippy::cast_possible_truncation, reason = "below 2^10")]
fn quarters_beyond(cycle: &Cycle<'_>, points: &[TrajectoryPoint]) -> RangeInclusive<i64> {
    let steps = points.iter().zip(points.iter().skip(1));
    let driven = steps.fold(Real::ZERO, |driven, (a, b)| driven + way(a, b));
    let missing = exact_s_stop(cycle, points) - driven;
    let missing = missing.min(Real::new(cycle.ego.length));
    if missing.certainly_at_most(Real::ZERO) {
        return NOTHING;
    }
    let offset = cycle.ego.center_offset;
    let first = (libm::floor(4.0 * offset) as i64).saturating_add(1);
    let needed = (Real::new(offset) + missing) * Real::new(4.0);
    let near = libm::floor(needed.value()) as i64;
    let reaches = |&quarters: &i64| needed.certainly_at_most(Real::integer(quarters));
    let candidates = near.saturating_sub(1)..=near.saturating_add(1);
    let last = candidates.into_iter().find(reaches).unwrap_or(near.saturating_add(2));
    first..=last
}

/// H-04: `s_stop` with e = abs(p - first point).
pub(crate) fn exact_s_stop(cycle: &Cycle<'_>, points: &[TrajectoryPoint]) -> Real {
    let ego = &cycle.ego;
    let e = points.first().map(|first| distance([ego.x, ego.y], [first.x, first.y]));
    s_stop(cycle, e.unwrap_or(Real::ZERO))
}

/// The horizon; H-04: max(s, `s_stop`).
fn exactly_farthest(cycle: &Cycle<'_>, points: &[TrajectoryPoint], horizon: Horizon<'_>) -> Real {
    let s = horizon.distance::<Real>(cycle);
    match cycle.profile {
        Profile::Paper => s,
        Profile::Hardened => s.or_larger(exact_s_stop(cycle, points)),
    }
}

/// Doubles on either side of it: of at most twenty roundings all but those of one difference are
/// of summands >= 0; its summands are `s_b(v_now)` and, unless 0 is larger, less. (The coordinates
/// of e are differences of doubles, each off by 2^-53 of itself.)
fn plain_bounds(cycle: &Cycle<'_>, points: &[TrajectoryPoint], horizon: Horizon<'_>) -> [f64; 2] {
    let mut s = horizon.distance::<f64>(cycle);
    if let (Profile::Hardened, Some(first)) = (cycle.profile, points.first()) {
        let (dx, dy) = (cycle.ego.x - first.x, cycle.ego.y - first.y);
        s = larger(s, s_stop(cycle, libm::sqrt(dx * dx + dy * dy)));
    }
    let error = 1e-13 * (s + s_b(&cycle.parameters, cycle.ego.speed)) + 1e-140;
    [s - error, s + error]
}

/// The length of a step, m.
pub(crate) fn length(from: &TrajectoryPoint, to: &TrajectoryPoint) -> Real {
    distance([from.x, from.y], [to.x, to.y])
}

/// The same in plain doubles, and what its error is relative to.
#[inline]
fn plain_length(from: &TrajectoryPoint, to: &TrajectoryPoint) -> [f64; 2] {
    let (dx, dy) = (to.x - from.x, to.y - from.y);
    [libm::sqrt(dx * dx + dy * dy); 2]
}

/// H-04: the way of a step, m.
pub(crate) fn way(from: &TrajectoryPoint, to: &TrajectoryPoint) -> Real {
    let u = Vector::between([from.x, from.y], [to.x, to.y]);
    u.dot(Vector::new(from.cos, from.sin)).max(Real::ZERO)
}

/// The same in plain doubles, off by less than 2^-50 of the two coordinates of the step.
#[inline]
pub(crate) fn plain_way(from: &TrajectoryPoint, to: &TrajectoryPoint) -> f64 {
    larger((to.x - from.x) * from.cos + (to.y - from.y) * from.sin, 0.0)
}

#[inline]
fn plain_way_and_size(from: &TrajectoryPoint, to: &TrajectoryPoint) -> [f64; 2] {
    [plain_way(from, to), (to.x - from.x).abs() + (to.y - from.y).abs()]
}

/// How many points are within s. They form a prefix, since `step` is never below 0; the first
/// point always counts.
fn within(
    points: &[TrajectoryPoint],
    s: Real,
    step: impl Fn(&TrajectoryPoint, &TrajectoryPoint) -> Real,
) -> usize {
    let mut arc = Real::ZERO;
    let mut count = 1_usize;
    for (a, b) in points.iter().zip(points.iter().skip(1)) {
        arc = arc + step(a, b);
        if !arc.possibly_at_most(s) {
            break;
        }
        count = count.saturating_add(1);
    }
    count.min(points.len())
}

/// The same in plain doubles, unless they cannot tell. A step errs by less than 2^-50 of its size
/// and 1e-150 m (squares may underflow), a sum of at most 1023 of them by less than 2^-40 of all
/// sizes together.
fn plainly_within(
    points: &[TrajectoryPoint],
    [least, most]: [f64; 2],
    step: impl Fn(&TrajectoryPoint, &TrajectoryPoint) -> [f64; 2],
) -> Option<usize> {
    let (mut arc, mut sizes) = (0.0, 0.0);
    let mut count = 1_usize;
    for (a, b) in points.iter().zip(points.iter().skip(1)) {
        let [length, size] = step(a, b);
        arc += length;
        sizes += size;
        let error = sizes * 1e-12 + 1e-140;
        if arc - error > most {
            return Some(count);
        }
        if arc + error > least {
            return None;
        }
        count = count.saturating_add(1);
    }
    Some(count.min(points.len()))
}
