//! Stage ii: what a trajectory has to be like to be driven (H-11, H-12 of
//! `spec/3-stages.md#hardened-profile`).

use core::cmp::Ordering;

use crate::input::cycle::{Cycle, TrajectoryPoint};
use crate::input::domain::elapsed_ns;
use crate::numbers::exact::{Product, compare};
use crate::numbers::plane::{Vector, same_point};
use crate::numbers::rounding::Real;
use crate::report::{Rule, Witness};
use crate::stages::distances::s_b;
use crate::stages::examined::{exact_s_stop, length, plain_way, way};

/// H-11: the first rule that some step breaks, and the first step that breaks it.
pub(crate) fn step_rules(cycle: &Cycle<'_>, points: &[TrajectoryPoint]) -> Option<Witness> {
    if steps_are_fine(cycle, points) {
        return None;
    }
    let rules: [(Rule, StepRule); 6] = [
        (Rule::StepTime, step_time),
        (Rule::StepLength, step_length),
        (Rule::StepSpeed, step_speed),
        (Rule::StepForward, step_forward),
        (Rule::StepLateral, step_lateral),
        (Rule::StepTurn, step_turn),
    ];
    rules.iter().find_map(|&(rule, broken)| {
        let steps = points.iter().zip(points.iter().skip(1)).zip(1_usize..);
        steps.into_iter().find_map(|((from, to), index)| {
            let u = Vector::between([from.x, from.y], [to.x, to.y]);
            let compared = broken(cycle, &Step { from, to, u })?;
            Some(Witness::of(rule, compared).at_point(index))
        })
    })
}

/// H-12: way, arc length and end of the trajectory.
pub(crate) fn arc_rules(cycle: &Cycle<'_>, points: &[TrajectoryPoint]) -> Option<Witness> {
    let (first, last) = (points.first()?, points.last()?);
    let end_ns = elapsed_ns(first.t_ns, last.t_ns);
    let stopped = || stands_at(cycle, first, end_ns) || end_ns >= LONGEST_NS;
    let end = exact_s_stop(cycle, points) - Real::new(cycle.ego.length);
    if arcs_are_fine(cycle, first, points, end) && stopped() {
        return None;
    }
    let bounds = Bounds::new(cycle, first);
    let tolerance = Real::new(cycle.parameters.start_tolerance);
    let too_short = sums(points, way).find_map(|(index, t_ns, way)| {
        let least = bounds.braking(Real::seconds(t_ns)) - tolerance;
        let least = if index.saturating_add(1) < points.len() { least } else { least.max(end) };
        let witness = Witness::of(Rule::ArcTooShort, [way.value(), least.value()]);
        (!least.certainly_at_most(way)).then(|| witness.at_point(index))
    });
    let too_long = || {
        sums(points, length).find_map(|(index, t_ns, arc)| {
            let most = bounds.accelerating(Real::seconds(t_ns)) + tolerance;
            let witness = Witness::of(Rule::ArcTooLong, [arc.value(), most.value()]);
            (!arc.certainly_at_most(most)).then(|| witness.at_point(index))
        })
    };
    too_short.or_else(too_long).or_else(|| {
        let needed = bounds.v_lo.over(Real::new(cycle.parameters.a_b)).min(Real::new(50.0));
        let compared = [Real::seconds(end_ns).value(), needed.value()];
        let index = points.len().saturating_sub(1);
        (!stopped()).then(|| Witness::of(Rule::EndsTooSoon, compared).at_point(index))
    })
}

/// 50 s: no trajectory has to be longer.
const LONGEST_NS: i64 = 50_000_000_000;

/// Two consecutive points and the displacement between them.
struct Step<'a> {
    from: &'a TrajectoryPoint,
    to: &'a TrajectoryPoint,
    u: Vector,
}

impl Step<'_> {
    fn dt_ns(&self) -> i64 {
        elapsed_ns(self.from.t_ns, self.to.t_ns)
    }

    fn headings(&self) -> [Vector; 2] {
        let Self { from, to, .. } = self;
        [Vector::new(from.cos, from.sin), Vector::new(to.cos, to.sin)]
    }

    /// The two points are the same; differences of doubles are exact.
    fn is_empty(&self) -> bool {
        same_point([self.from.x, self.from.y], [self.to.x, self.to.y])
    }
}

/// More than plain doubles err in the comparisons of one step, m: its numbers are below 2^26 m,
/// those that are compared below 2^19 m.
const STEP_ERROR: f64 = 1e-9;

/// Whether every step keeps all rules of H-11 by more than plain doubles err; else the rules
/// decide, one after the other.
fn steps_are_fine(cycle: &Cycle<'_>, points: &[TrajectoryPoint]) -> bool {
    let (v_max, step_max_ns) = (cycle.parameters.v_max, cycle.parameters.step_max_ns);
    let (length, half_width) = (cycle.ego.length, 0.5 * cycle.ego.width);
    points.iter().zip(points.iter().skip(1)).all(|(from, to)| {
        let dt_ns = elapsed_ns(from.t_ns, to.t_ns);
        let (x, y) = (to.x - from.x, to.y - from.y);
        let size = libm::sqrt(x * x + y * y) + STEP_ERROR;
        let fits = |point: &TrajectoryPoint| {
            let along = x * point.cos + y * point.sin;
            let aside = x * point.sin - y * point.cos;
            along > STEP_ERROR && aside.abs() + STEP_ERROR <= half_width
        };
        dt_ns <= step_max_ns
            && size <= length
            && size <= v_max * seconds(dt_ns)
            && fits(from)
            && fits(to)
            && from.cos * to.cos + from.sin * to.sin >= 0.866 + STEP_ERROR
            && (same_heading(from, to) || {
                let turned = (from.cos * to.sin - from.sin * to.cos).abs() + STEP_ERROR;
                let dt = seconds(dt_ns);
                turned <= 0.5 * (size - 2.0 * STEP_ERROR) + 0.1 * dt - STEP_ERROR
                    && turned * size + STEP_ERROR <= cycle.parameters.a_b * dt * dt
            })
    })
}

/// Whether every way and arc length keeps the bounds of H-12 by more than plain doubles err: the bounds
/// are below 2^21 m.
fn arcs_are_fine(
    cycle: &Cycle<'_>,
    first: &TrajectoryPoint,
    points: &[TrajectoryPoint],
    end: Real,
) -> bool {
    let (parameters, v_now) = (&cycle.parameters, cycle.ego.speed);
    let (a_b, a_max) = (parameters.a_b, parameters.a_max);
    let d = seconds(elapsed_ns(first.t_ns, cycle.now_ns)).abs();
    let (v_lo, v_hi) = ((v_now - a_max * d).max(0.0), v_now + a_b * d);
    let tolerance = parameters.start_tolerance - 1e-6;
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
        least - tolerance <= driven - error && arc + error <= most + tolerance
    });
    all && end.value() + 1e-6 <= driven - error
}

/// A time in s, with two roundings.
fn seconds(time_ns: i64) -> f64 {
    Real::integer(time_ns).value() * 1e-9
}

/// The two compared numbers when the rule is not certainly kept.
type StepRule = fn(&Cycle<'_>, &Step<'_>) -> Option<[f64; 2]>;

fn step_time(cycle: &Cycle<'_>, step: &Step<'_>) -> Option<[f64; 2]> {
    let (dt_ns, most_ns) = (step.dt_ns(), cycle.parameters.step_max_ns);
    let compared = [dt_ns, most_ns].map(|time_ns| Real::seconds(time_ns).value());
    (dt_ns > most_ns).then_some(compared)
}

fn step_length(cycle: &Cycle<'_>, step: &Step<'_>) -> Option<[f64; 2]> {
    exceeds(step.u.norm(), Real::new(cycle.ego.length))
}

fn step_speed(cycle: &Cycle<'_>, step: &Step<'_>) -> Option<[f64; 2]> {
    exceeds(step.u.norm(), Real::new(cycle.parameters.v_max) * Real::seconds(step.dt_ns()))
}

fn step_forward(_: &Cycle<'_>, step: &Step<'_>) -> Option<[f64; 2]> {
    if step.is_empty() {
        return None;
    }
    step.headings().iter().find_map(|&heading| falls_short(step.u.dot(heading), Real::ZERO))
}

fn step_lateral(cycle: &Cycle<'_>, step: &Step<'_>) -> Option<[f64; 2]> {
    let half_width = Real::new(0.5 * cycle.ego.width);
    step.headings().iter().find_map(|&heading| exceeds(step.u.cross(heading).abs(), half_width))
}

fn step_turn(cycle: &Cycle<'_>, step: &Step<'_>) -> Option<[f64; 2]> {
    let [from, to] = step.headings();
    falls_short(from.dot(to), Real::new(0.866)).or_else(|| {
        if same_heading(step.from, step.to) {
            return None;
        }
        let (turned, length) = (from.cross(to).abs(), step.u.norm());
        let dt = Real::seconds(step.dt_ns());
        let curve = Real::new(0.5) * length + Real::new(0.1) * dt;
        let swerve = || exceeds(turned * length, Real::new(cycle.parameters.a_b) * dt.squared());
        exceeds(turned, curve).or_else(swerve)
    })
}

/// Numbers, not bits, are compared: 0 and -0 are the same.
fn same_heading(from: &TrajectoryPoint, to: &TrajectoryPoint) -> bool {
    same_point([from.cos, from.sin], [to.cos, to.sin])
}

fn exceeds(value: Real, most: Real) -> Option<[f64; 2]> {
    (!value.certainly_at_most(most)).then(|| [value.value(), most.value()])
}

fn falls_short(value: Real, least: Real) -> Option<[f64; 2]> {
    (!least.certainly_at_most(value)).then(|| [value.value(), least.value()])
}

/// Index, time after the first point in ns, and sum over the steps, for every point.
fn sums(
    points: &[TrajectoryPoint],
    of: impl Fn(&TrajectoryPoint, &TrajectoryPoint) -> Real,
) -> impl Iterator<Item = (usize, i64, Real)> {
    let first_ns = points.first().map_or(0, |first| first.t_ns);
    let steps = points.iter().zip(points.iter().skip(1)).zip(1_usize..);
    let later = steps.scan(Real::ZERO, move |sum, ((a, b), index)| {
        *sum = *sum + of(a, b);
        Some((index, elapsed_ns(first_ns, b.t_ns), *sum))
    });
    core::iter::once((0, 0, Real::ZERO)).chain(later)
}

/// H-12: how far the CAV gets at least and at most.
struct Bounds {
    v_lo: Real,
    v_hi: Real,
    a_b: Real,
    a_max: Real,
    stopping: Real,
}

impl Bounds {
    fn new(cycle: &Cycle<'_>, first: &TrajectoryPoint) -> Self {
        let parameters = &cycle.parameters;
        let (a_b, a_max) = (Real::new(parameters.a_b), Real::new(parameters.a_max));
        let d = Real::seconds(elapsed_ns(first.t_ns, cycle.now_ns)).abs();
        let v_now = Real::new(cycle.ego.speed);
        let v_lo = (v_now - a_max * d).max(Real::ZERO);
        Self { v_lo, v_hi: v_now + a_b * d, a_b, a_max, stopping: s_b(parameters, v_lo) }
    }

    /// b(t): with w = max(`v_lo` - `a_b` t, 0), the speed that is left, both branches of H-12 are
    /// `s_b(v_lo)` - w^2 / (2 `a_b`).
    fn braking(&self, t: Real) -> Real {
        let left = (self.v_lo - self.a_b * t).max(Real::ZERO);
        self.stopping - left.squared().over(self.a_b + self.a_b)
    }

    /// `v_hi` t + `a_max` t^2/2.
    fn accelerating(&self, t: Real) -> Real {
        self.v_hi * t + self.a_max * t.squared() * Real::new(0.5)
    }
}

/// Whether t >= `v_lo` / `a_b` at that time; exact, since no margin applies to times:
/// `a_b` t + `a_max` d >= `v_now` in units of 1e-9 m/s. (When `v_lo` is 0, every t >= 0 is enough,
/// and the inequality holds.)
fn stands_at(cycle: &Cycle<'_>, first: &TrajectoryPoint, t_ns: i64) -> bool {
    let parameters = &cycle.parameters;
    let d_ns = elapsed_ns(first.t_ns, cycle.now_ns).saturating_abs();
    let (t, d) = (Real::integer(t_ns).value(), Real::integer(d_ns).value());
    let gained =
        [Product([t, 0.0], [parameters.a_b, 0.0]), Product([d, 0.0], [parameters.a_max, 0.0])];
    compare(&gained, &[Product([1e9, 0.0], [cycle.ego.speed, 0.0])]) != Ordering::Less
}
