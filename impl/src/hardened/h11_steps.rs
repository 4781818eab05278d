//! What every step of a trajectory has to be like to be driven (H-11 of
//! `spec/3-stages.md#hardened-profile`).

use crate::input::cycle::{Cycle, TrajectoryPoint};
use crate::numbers::plane::{Vector, same_point};
use crate::numbers::rounding::Real;
use crate::numbers::time::{elapsed_ns, seconds};
use crate::report::{Rule, Witness};

/// The first rule that some step breaks, and the first step that breaks it.
pub(crate) fn step_failure(cycle: &Cycle<'_>, points: &[TrajectoryPoint]) -> Option<Witness> {
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
