//! By how much the CAV is wider at its places (H-14.64, `spec/hardened/H-14.md#requirements-the-cav`).

use crate::hardened::h14_fail_safe::nodes::Nodes;
use crate::hardened::h14_fail_safe::times::{CIRCLE, HALF_TYRES, Times};
use crate::input::cycle::{Cycle, TrajectoryPoint};
use crate::numbers::plane::Vector;
use crate::numbers::range::larger;
use crate::numbers::rounding::Real;
use crate::stages::llcc::sweep::{minus, split};
use crate::stages::llcc::vector;

/// More than what plain doubles err in a progress, in the way aside, and in their squares, relatively.
const ROUGH: f64 = 1e-15;

/// How much farther aside than the CAV the trajectory is: where it passes the CAV, and at the points that the
/// CAV cannot come to. It does not say where the CAV joins it. Not below the number of the text, and above it by less than
/// 1e-13 of the greatest coordinate, m; exact where no point is beyond what the CAV can drive.
pub(crate) fn wider_by(cycle: &Cycle<'_>, points: &[TrajectoryPoint]) -> Real {
    let (ego, nodes) = (&cycle.ego, Nodes::new(cycle, points));
    let passes = passes(cycle, points);
    // H-14.64
    let (v, s_b) = (ego.speed, Times::<f64>::new(cycle).s_b);
    let until = s_b * (1.0 + ROUGH) + 1e-9;
    //
    let bend = |f: f64| {
        let u = larger(v - cycle.parameters.a_b * f / v, 0.5 * v);
        // Where v is 0 this is no number, and the circle is taken.
        let tyres = HALF_TYRES / (u * u);
        if tyres < 0.5 / CIRCLE { tyres } else { 0.5 / CIRCLE }
    };
    let mut length = 0.0;
    let mut from = ([0.0; 2], [ego.cos, ego.sin]);
    let mut beyond = 0.0;
    for (index, point) in nodes.points.iter().enumerate() {
        let to = minus([point.x, point.y], [ego.x, ego.y]);
        let [along, across] = split(from.1, minus(to, from.0)).map(f64::abs);
        length += along + across;
        // Lengths only grow.
        if index > 0 && length > until {
            break;
        }
        from = (to, [point.cos, point.sin]);
        let [f, aside] = split([ego.cos, ego.sin], to);
        let error = (to[0].abs() + to[1].abs()) * ROUGH;
        let f = larger(f - error, 0.0);
        beyond = larger(beyond, aside.abs() + error - f * f * bend(f) * (1.0 - 8.0 * ROUGH));
    }
    passes.max(Real::new(beyond * (1.0 + ROUGH)))
}

/// How far aside of the CAV the trajectory passes it (H-14.65), m.
pub(crate) fn passes(cycle: &Cycle<'_>, points: &[TrajectoryPoint]) -> Real {
    let (ego, nodes) = (&cycle.ego, Nodes::new(cycle, points));
    let split = |point: &TrajectoryPoint| {
        let away = Vector::between([ego.x, ego.y], [point.x, point.y]);
        let h = vector([ego.cos, ego.sin]);
        [away.dot(h), away.cross(h)]
    };
    let Some(node) = nodes.points.first() else {
        return points.first().map_or(Real::ZERO, |first| split(first)[1].abs());
    };
    let Some([f_y, y]) = nodes.others(points).last().map(split) else { return Real::ZERO };
    let [f_z, z] = split(node);
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
