//! How far a trajectory gets, and where it ends (H-12 of `spec/3-stages.md#hardened-profile`).

use core::cmp::Ordering;

use crate::hardened::h04_horizon::{exact_s_stop, plain_way, way};
use crate::input::cycle::{Cycle, TrajectoryPoint};
use crate::input::parameters::Parameters;
use crate::numbers::exact::{Product, compare};
use crate::numbers::rounding::Real;
use crate::numbers::time::{elapsed_ns, seconds};
use crate::report::{Rule, Witness};
use crate::stages::distances::s_b;
use crate::stages::horizon::length;

/// Way, arc length and end of the trajectory.
pub(crate) fn progress_failure(cycle: &Cycle<'_>, points: &[TrajectoryPoint]) -> Option<Witness> {
    let (first, last) = (points.first()?, points.last()?);
    let end_ns = elapsed_ns(first.t_ns, last.t_ns);
    let stopped = || stands_at(cycle, first, end_ns) || end_ns >= LONGEST_NS;
    let end = exact_s_stop(cycle, points) - Real::new(cycle.ego.length);
    if arcs_are_fine(cycle, first, points, end) && stopped() {
        return None;
    }
    let bounds = Bounds::new(cycle, first);
    let (mut driven, mut arc, mut before) = (Real::ZERO, Real::ZERO, first);
    let (mut lags, mut outruns) = (None, None);
    for (index, point) in points.iter().enumerate() {
        (driven, arc) = (driven + way(before, point), arc + length(before, point));
        before = point;
        let t = Real::seconds(elapsed_ns(first.t_ns, point.t_ns));
        let least = bounds.braking(t);
        let is_last = index.saturating_add(1) == points.len();
        let least = if is_last { least.max(end) } else { least };
        if lags.is_none() && !least.certainly_at_most(driven) {
            let compared = [driven.value(), least.value()];
            lags = Some(Witness::of(Rule::ArcTooShort, compared).at_point(index));
        }
        let most = bounds.accelerating(t);
        if outruns.is_none() && !arc.certainly_at_most(most) {
            let compared = [arc.value(), most.value()];
            outruns = Some(Witness::of(Rule::ArcTooLong, compared).at_point(index));
        }
    }
    lags.or(outruns).or_else(|| {
        let needed = bounds.v_lo.over(Real::new(cycle.parameters.a_b)).min(Real::new(50.0));
        let compared = [Real::seconds(end_ns).value(), needed.value()];
        let index = points.len().saturating_sub(1);
        (!stopped()).then(|| Witness::of(Rule::EndsTooSoon, compared).at_point(index))
    })
}

/// 50 s: no trajectory has to be longer.
const LONGEST_NS: i64 = 50_000_000_000;

/// Whether every way and arc length keeps the bounds by more than plain doubles err: the bounds are
/// below 2^21 m.
fn arcs_are_fine(
    cycle: &Cycle<'_>,
    first: &TrajectoryPoint,
    points: &[TrajectoryPoint],
    end: Real,
) -> bool {
    let (parameters, v_now) = (&cycle.parameters, cycle.ego.speed);
    let (a_b, a_max) = (parameters.a_b, parameters.a_max);
    let (slower, faster) = rates(cycle, first);
    let d = seconds(elapsed_ns(first.t_ns, cycle.now_ns)).abs();
    let (v_lo, v_hi) = ((v_now - slower * d).max(0.0), v_now + faster * d);
    let (behind, ahead) = (parameters.lag_tolerance - 1e-6, parameters.start_tolerance - 1e-6);
    let (mut arc, mut driven, mut error, mut before) = (0.0, 0.0, 0.0, first);
    let all = points.iter().all(|point| {
        let (x, y) = (point.x - before.x, point.y - before.y);
        arc += libm::sqrt(x * x + y * y);
        driven += plain_way(before, point);
        error += 1e-11 * (x.abs() + y.abs());
        before = point;
        let t = seconds(elapsed_ns(first.t_ns, point.t_ns));
        let left = (v_lo - a_b * t).max(0.0);
        let least = (v_lo * v_lo - left * left) / (2.0 * a_b);
        let most = v_hi * t + 0.5 * a_max * t * t;
        least - behind <= driven - error && arc + error <= most + ahead
    });
    all && end.value() + 1e-6 <= driven - error
}

/// How much less and how much more than `v_now` the speed at the first point may be for each second
/// between now and then: before now the CAV accelerated or braked since, after now it still may.
fn rates(cycle: &Cycle<'_>, first: &TrajectoryPoint) -> (f64, f64) {
    let Parameters { a_b, a_max, .. } = cycle.parameters;
    if first.t_ns <= cycle.now_ns { (a_max, a_b) } else { (a_b, a_max) }
}

/// How far the CAV gets at least and at most, with the tolerances.
struct Bounds {
    v_lo: Real,
    v_hi: Real,
    a_b: Real,
    a_max: Real,
    stopping: Real,
    behind: Real,
    ahead: Real,
}

impl Bounds {
    fn new(cycle: &Cycle<'_>, first: &TrajectoryPoint) -> Self {
        let parameters = &cycle.parameters;
        let (a_b, a_max) = (Real::new(parameters.a_b), Real::new(parameters.a_max));
        let d = Real::seconds(elapsed_ns(first.t_ns, cycle.now_ns)).abs();
        let v_now = Real::new(cycle.ego.speed);
        let (slower, faster) = rates(cycle, first);
        let v_lo = (v_now - Real::new(slower) * d).max(Real::ZERO);
        let (v_hi, stopping) = (v_now + Real::new(faster) * d, s_b(parameters, v_lo));
        let behind = Real::new(parameters.lag_tolerance);
        let ahead = Real::new(parameters.start_tolerance);
        Self { v_lo, v_hi, a_b, a_max, stopping, behind, ahead }
    }

    /// b(t) - `lag_tolerance`: with w = max(`v_lo` - `a_b` t, 0), the speed that is left, both
    /// branches of H-12 are `s_b(v_lo)` - w^2 / (2 `a_b`).
    fn braking(&self, t: Real) -> Real {
        let left = (self.v_lo - self.a_b * t).max(Real::ZERO);
        self.stopping - left.squared().over(self.a_b + self.a_b) - self.behind
    }

    /// `v_hi` t + `a_max` t^2/2 + `start_tolerance`.
    fn accelerating(&self, t: Real) -> Real {
        self.v_hi * t + self.a_max * t.squared() * Real::new(0.5) + self.ahead
    }
}

/// Whether t >= `v_lo` / `a_b` at that time; exact, since no margin applies to times:
/// `a_b` t + rate d >= `v_now` in units of 1e-9 m/s. (When `v_lo` is 0, every t >= 0 is enough,
/// and the inequality holds.)
fn stands_at(cycle: &Cycle<'_>, first: &TrajectoryPoint, t_ns: i64) -> bool {
    let parameters = &cycle.parameters;
    let d_ns = elapsed_ns(first.t_ns, cycle.now_ns).saturating_abs();
    let (t, d) = (Real::integer(t_ns).value(), Real::integer(d_ns).value());
    let (slower, _) = rates(cycle, first);
    let gained = [Product([t, 0.0], [parameters.a_b, 0.0]), Product([d, 0.0], [slower, 0.0])];
    compare(&gained, &[Product([1e9, 0.0], [cycle.ego.speed, 0.0])]) != Ordering::Less
}
