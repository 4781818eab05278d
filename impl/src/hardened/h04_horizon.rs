//! How far the hardened profile looks: way instead of arc length, at least `s_stop`, and beyond the
//! end of a remote trajectory (H-04 of `spec/3-stages.md#hardened-profile`).

use core::ops::RangeInclusive;
use core::slice;

use crate::input::cycle::{Cycle, TrajectoryPoint};
use crate::input::parameters::Parameters;
use crate::numbers::plane::{Vector, distance};
use crate::numbers::range::larger;
use crate::numbers::rounding::Real;
use crate::report::Witness;
use crate::services::configuration::Group;
use crate::stages::distances::{Number, s_b};

/// `s_stop` = e + v tau + `a_max` tau^2/2 + (v + `a_max` tau)^2/(2 `a_b`), m; `e` is how far
/// the CAV is from the first point.
fn s_stop<N: Number>(cycle: &Cycle<'_>, e: N) -> N {
    let Parameters { tau, a_max, .. } = cycle.parameters;
    let [v, tau, a_max, half] = [cycle.ego.speed, tau, a_max, 0.5].map(N::from_double);
    let reaction = v.times(tau).plus(a_max.times(tau.times(tau)).times(half));
    e.plus(reaction).plus(s_b(&cycle.parameters, v.plus(a_max.times(tau))))
}

/// `s_stop` with e = abs(p - first point).
pub(crate) fn exact_s_stop(cycle: &Cycle<'_>, points: &[TrajectoryPoint]) -> Real {
    let ego = &cycle.ego;
    let e = points.first().map(|first| distance([ego.x, ego.y], [first.x, first.y]));
    s_stop(cycle, e.unwrap_or(Real::ZERO))
}

/// The same in plain doubles. The coordinates of e are differences of doubles, each off by 2^-53 of
/// itself.
pub(crate) fn plain_s_stop(cycle: &Cycle<'_>, first: &TrajectoryPoint) -> f64 {
    let (dx, dy) = (cycle.ego.x - first.x, cycle.ego.y - first.y);
    s_stop(cycle, libm::sqrt(dx * dx + dy * dy))
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

/// The places beyond the end of a trajectory: quarters of a metre, by which the CAV's centre is
/// ahead of the last point.
pub(crate) struct PlacesBeyond(RangeInclusive<i64>);

impl PlacesBeyond {
    #[allow(clippy::reversed_empty_ranges, reason = "it has to be empty")]
    pub(crate) const NONE: Self = Self(1..=0);

    /// From the first quarter above `center_offset` to the first that is certainly not below
    /// `center_offset` + `s_stop` - way; none when the trajectory is local. H-12 lets no trajectory
    /// end more than L before `s_stop`; a stage that is run alone looks no farther than that either.
    #[allow(clippy::cast_possible_truncation, reason = "below 2^10")]
    pub(crate) fn new(cycle: &Cycle<'_>, points: &[TrajectoryPoint]) -> Self {
        if !cycle.configuration.is_remote(Group::Plan) {
            return Self::NONE;
        }
        let steps = points.iter().zip(points.iter().skip(1));
        let driven = steps.fold(Real::ZERO, |driven, (a, b)| driven + way(a, b));
        let missing = exact_s_stop(cycle, points) - driven;
        let missing = missing.min(Real::new(cycle.ego.length));
        if missing.certainly_at_most(Real::ZERO) {
            return Self::NONE;
        }
        let offset = cycle.ego.center_offset;
        let first = (libm::floor(4.0 * offset) as i64).saturating_add(1);
        let needed = (Real::new(offset) + missing) * Real::new(4.0);
        let near = libm::floor(needed.value()) as i64;
        let reaches = |&quarters: &i64| needed.certainly_at_most(Real::integer(quarters));
        let candidates = near.saturating_sub(1)..=near.saturating_add(1);
        let last = candidates.into_iter().find(reaches).unwrap_or(near.saturating_add(2));
        Self(first..=last)
    }

    /// The first place where `find` finds something: it gets the cycle with the CAV moved on, and
    /// the last of the points.
    pub(crate) fn first<'a>(
        &self,
        cycle: &Cycle<'a>,
        points: &[TrajectoryPoint],
        find: impl Fn(&Cycle<'a>, &[TrajectoryPoint]) -> Option<Witness>,
    ) -> Option<Witness> {
        let last = points.last()?;
        self.0.clone().zip(points.len()..).find_map(|(quarters, index)| {
            let mut moved = *cycle;
            moved.ego.center_offset = 0.25 * Real::integer(quarters).value();
            find(&moved, slice::from_ref(last)).map(|witness| witness.at_point(index))
        })
    }
}
