//! By how much the CAV is wider at its places (H-14.26, `spec/hardened/H-14.md#requirements-the-cav`).

use core::ops::ControlFlow::{Break, Continue};

use crate::hardened::h14_fail_safe::excess::Excess;
use crate::hardened::h14_fail_safe::nodes::Nodes;
use crate::hardened::h14_fail_safe::path::{Path, Piece};
use crate::input::cycle::{Cycle, TrajectoryPoint};
use crate::numbers::plane::Vector;
use crate::numbers::range::larger;
use crate::numbers::rounding::Real;
use crate::stages::llcc::vector;

/// What is less than this above the rest is not looked for, m.
const NEGLIGIBLE: f64 = 1e-9;
/// More than that, and than what plain doubles err by in a place, m.
const MORE: f64 = 3e-9;

/// The greatest of the distance at which the trajectory passes the CAV and of all excesses, m. Not below the number of the
/// text, and above it by at most 4e-9 m. Most paths are told line by line.
pub(crate) fn wider_by(cycle: &Cycle<'_>, points: &[TrajectoryPoint]) -> f64 {
    let (nodes, excess) = (Nodes::new(cycle, points), Excess::new(cycle));
    let of_others = nodes.others(points).iter().map(|point| excess.of_point(point));
    // H-14.26
    let known = of_others.fold(passes(cycle, points), Real::max).magnitude();
    let of_lines = nodes.lines().map(|it| excess.at_most([it.from, it.to], it.heading));
    let (mut most, mut count) = (known, 0);
    for (of_line, number) in of_lines.zip(1..) {
        most = larger(most, of_line);
        count = if of_line > known + NEGLIGIBLE { number } else { count };
    }
    if count == 0 {
        return most;
    }
    let p = [cycle.ego.x, cycle.ego.y];
    let of_piece = |known: f64, piece: Piece| {
        let is_free = |known: &f64, run: [i64; 2]| {
            let ends = piece.between(run, p).map(|[x, y, _]| [x, y]);
            excess.at_most(ends, piece.heading()) <= known + NEGLIGIBLE
        };
        let or_more = |known: f64, k: i64| {
            let at = piece.plainly(k, p);
            Continue(larger(known, excess.at_most([at, at], piece.heading())))
        };
        let (Continue(known) | Break(known)) = piece.over_places(known, is_free, or_more);
        known
    };
    // A piece is a line; behind these none has more.
    Path::new(nodes).pieces().take(count).fold(known, of_piece) + MORE
}

/// How far aside of the CAV the trajectory passes it (H-14.65), m.
pub(crate) fn passes(cycle: &Cycle<'_>, points: &[TrajectoryPoint]) -> Real {
    let (ego, nodes) = (&cycle.ego, Nodes::new(cycle, points));
    let split = |point: &TrajectoryPoint| {
        let away = Vector::between([ego.x, ego.y], [point.x, point.y]);
        let h = vector([ego.cos, ego.sin]);
        [away.dot(h), away.cross(h)]
    };
    let ends = (nodes.others(points).last(), nodes.points.first());
    let (Some([f_y, y]), Some([f_z, z])) = (ends.0.map(split), ends.1.map(split)) else {
        return Real::ZERO;
    };
    if Real::ZERO.certainly_below(f_y) {
        return Real::ZERO;
    }
    (y * f_z - z * f_y).abs().over(f_z - f_y)
}

#[cfg(test)]
mod tests;
