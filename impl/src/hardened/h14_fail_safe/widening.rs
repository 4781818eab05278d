//! By how much the CAV is wider at its places (H-14.64, `spec/hardened/H-14.md#requirements-the-cav`).

use crate::hardened::h14_fail_safe::nodes::Nodes;
use crate::hardened::h14_fail_safe::reach::{CIRCLE, HALF_TYRES};
use crate::hardened::h14_fail_safe::times::Times;
use crate::input::cycle::{Cycle, Ego, TrajectoryPoint};
use crate::numbers::plane::Vector;
use crate::numbers::range::{larger, smaller};
use crate::numbers::rounding::Real;
use crate::stages::llcc::sweep::{minus, split};
use crate::stages::llcc::vector;

/// More than what plain doubles err in a progress, in the way aside, and in their squares, relatively.
const ROUGH: f64 = 1e-15;

/// How much farther aside than the CAV the trajectory is: where it passes the CAV, and at the points that the
/// CAV cannot come to. It does not say where the CAV joins it. Not below the number of the text, and above it by less than
/// 1e-13 of the greatest coordinate, m; exact where no point is beyond what the CAV can drive.
pub(crate) fn widening(cycle: &Cycle<'_>, points: &[TrajectoryPoint]) -> Real {
    let (ego, nodes) = (&cycle.ego, Nodes::new(cycle, points));
    let passes = passes(ego, nodes.others(points).last(), nodes.points.first());
    //
    let bend = smaller(0.5 / CIRCLE, HALF_TYRES / (ego.speed * ego.speed)) * (1.0 - ROUGH);
    // H-14.64
    let until = Times::<f64>::new(cycle).s_b * (1.0 + ROUGH) + 1e-9;
    let beyond = nodes.points.iter().enumerate().fold(0.0, |most, (index, point)| {
        let [x, y] = minus([point.x, point.y], [ego.x, ego.y]);
        let [f, aside] = split([ego.cos, ego.sin], [x, y]);
        if index > 0 && f > until {
            return most;
        }
        let error = (x.abs() + y.abs()) * ROUGH;
        let least = larger(f - error, 0.0);
        larger(most, aside.abs() + error - least * least * bend)
    });
    passes.max(Real::new(beyond * (1.0 + ROUGH)))
}

/// How far aside of the CAV the trajectory passes it, between the point before the first node and that (H-14.65).
fn passes(ego: &Ego, before: Option<&TrajectoryPoint>, node: Option<&TrajectoryPoint>) -> Real {
    let split = |point: &TrajectoryPoint| {
        let away = Vector::between([ego.x, ego.y], [point.x, point.y]);
        let h = vector([ego.cos, ego.sin]);
        [away.dot(h), away.cross(h)]
    };
    let Some([f_y, y]) = before.map(split) else { return Real::ZERO };
    let Some([f_z, z]) = node.map(split) else { return y.abs() };
    let on_the_way = || (y * f_z - z * f_y).abs().over(f_z - f_y);
    if f_y.certainly_at_most(Real::ZERO) {
        on_the_way()
    } else if Real::ZERO.certainly_below(f_y) {
        y.abs()
    } else {
        // Both are the same at 0.
        on_the_way().max(y.abs())
    }
}

#[cfg(test)]
mod tests;
