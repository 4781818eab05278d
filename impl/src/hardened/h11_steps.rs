//! What every step of a trajectory has to be like to be driven (H-11 of
//! `spec/3-stages.md#hardened-profile`).

use crate::input::cycle::{Cycle, TrajectoryPoint};
use crate::input::parameters::Parameters;
use crate::numbers::plane::{Vector, same_point};
use crate::numbers::rounding::Real;
use crate::numbers::time::{elapsed_ns, seconds};
use crate::report::{Rule, Witness};

/// The first rule that some step does not certainly keep, and the first such step.
pub(crate) fn step_failure(cycle: &Cycle<'_>, points: &[TrajectoryPoint]) -> Option<Witness> {
    let mut first: Option<Witness> = None;
    for ((from, to), index) in points.iter().zip(points.iter().skip(1)).zip(1_usize..) {
        if is_fine(cycle, from, to) {
            continue;
        }
        let Some((rule, compared)) = first_broken(cycle, from, to) else { continue };
        if first.is_none_or(|found| rule < found.rule) {
            first = Some(Witness::of(rule, compared).at_point(index));
        }
    }
    first
}

/// More than plain doubles err in the comparisons of one step, m: its numbers are below 2^26 m,
/// those that are compared below 2^19 m.
const STEP_ERROR: f64 = 1e-9;

/// Whether the step keeps all rules by more than plain doubles err.
#[inline]
fn is_fine(cycle: &Cycle<'_>, from: &TrajectoryPoint, to: &TrajectoryPoint) -> bool {
    let dt_ns = elapsed_ns(from.t_ns, to.t_ns);
    let (x, y) = (to.x - from.x, to.y - from.y);
    let size = libm::sqrt(x * x + y * y) + STEP_ERROR;
    let fits = |point: &TrajectoryPoint| {
        let along = x * point.cos + y * point.sin;
        let aside = x * point.sin - y * point.cos;
        along > STEP_ERROR && aside.abs() + STEP_ERROR <= 0.5 * cycle.ego.width
    };
    dt_ns <= cycle.parameters.step_max_ns
        && size <= cycle.ego.length
        && size <= cycle.parameters.v_max * seconds(dt_ns)
        && fits(from)
        && fits(to)
        && from.cos * to.cos + from.sin * to.sin >= 0.866 + STEP_ERROR
        && (same_heading(from, to) || {
            let turned = (from.cos * to.sin - from.sin * to.cos).abs() + STEP_ERROR;
            let dt = seconds(dt_ns);
            turned <= 0.5 * (size - 2.0 * STEP_ERROR) + 0.1 * dt - STEP_ERROR
                && turned * size + STEP_ERROR <= cycle.parameters.a_b * dt * dt
        })
}

/// The first rule that the step does not certainly keep, and the two numbers.
fn first_broken(
    cycle: &Cycle<'_>,
    from: &TrajectoryPoint,
    to: &TrajectoryPoint,
) -> Option<(Rule, [f64; 2])> {
    let Parameters { step_max_ns, v_max, a_b, .. } = cycle.parameters;
    let dt_ns = elapsed_ns(from.t_ns, to.t_ns);
    if dt_ns > step_max_ns {
        let compared = [dt_ns, step_max_ns].map(|time_ns| Real::seconds(time_ns).value());
        return Some((Rule::StepTime, compared));
    }
    let (at, next) = ([from.x, from.y], [to.x, to.y]);
    let [before, after] = [from, to].map(|point| Vector::new(point.cos, point.sin));
    let (u, dt) = (Vector::between(at, next), Real::seconds(dt_ns));
    let (size, turned) = (u.norm(), before.cross(after).abs());
    // An empty step leads nowhere, and between equal headings there is no angle.
    let (moves, turns) = (!same_point(at, next), !same_heading(from, to));
    let at_most = |value: Real, limit| (value, limit, value.certainly_at_most(limit));
    let at_least = |value: Real, limit: Real| (value, limit, limit.certainly_at_most(value));
    let aside = |heading| at_most(u.cross(heading).abs(), Real::new(0.5 * cycle.ego.width));
    let rules = [
        (Rule::StepLength, true, at_most(size, Real::new(cycle.ego.length))),
        (Rule::StepSpeed, true, at_most(size, Real::new(v_max) * dt)),
        (Rule::StepForward, moves, at_least(u.dot(before), Real::ZERO)),
        (Rule::StepForward, moves, at_least(u.dot(after), Real::ZERO)),
        (Rule::StepLateral, true, aside(before)),
        (Rule::StepLateral, true, aside(after)),
        (Rule::StepTurn, true, at_least(before.dot(after), Real::new(0.866))),
        (Rule::StepTurn, turns, at_most(turned, Real::new(0.5) * size + Real::new(0.1) * dt)),
        (Rule::StepTurn, turns, at_most(turned * size, Real::new(a_b) * dt.squared())),
    ];
    let broken = rules.into_iter().find(|&(_, applies, (.., is_kept))| applies && !is_kept);
    broken.map(|(rule, _, (value, limit, _))| (rule, [value.value(), limit.value()]))
}

/// Numbers, not bits, are compared: 0 and -0 are the same.
fn same_heading(from: &TrajectoryPoint, to: &TrajectoryPoint) -> bool {
    same_point([from.cos, from.sin], [to.cos, to.sin])
}
