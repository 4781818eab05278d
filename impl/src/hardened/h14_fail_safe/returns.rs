//! Whether the path comes back to where the CAV may be (H-14.68, `spec/hardened/H-14.md#requirements-reach`).

use crate::hardened::h14_fail_safe::nodes::Nodes;
use crate::hardened::h14_fail_safe::times::Times;
use crate::input::cycle::{Cycle, TrajectoryPoint};
use crate::numbers::plane::Vector;
use crate::numbers::range::larger;
use crate::numbers::rounding::Real;
use crate::report::{Rule, Witness};
use crate::stages::llcc::sweep::{minus, split};
use crate::stages::llcc::vector;

/// How far behind an earlier node the path may be, m.
const BACK: f64 = 0.125;
/// What gains less progress than that is all equally far ahead, m: less than any delta.
const LEVEL: f64 = 1e-9;
/// More than what plain doubles err by from p on, m, up to 2^26 m and up to the greatest `s_stop`.
const ROUGH: f64 = 1e-6;

/// The first way from a node to the next that is not certainly kept. Of most paths plain doubles tell that none comes back.
pub(crate) fn return_failure(cycle: &Cycle<'_>, points: &[TrajectoryPoint]) -> Option<Witness> {
    let nodes = Nodes::new(cycle, points);
    let beside = larger(1.0, cycle.parameters.lateral_tolerance);
    if !may_return(cycle, nodes.points, beside) {
        return None;
    }
    let (p, h) = ([cycle.ego.x, cycle.ego.y], vector([cycle.ego.cos, cycle.ego.sin]));
    let near = Times::<Real>::new(cycle).s_stop;
    let far = near + Real::new(beside);
    let first = nodes.others(points).len();
    let (mut from, mut was_far) = (Vector::new(0.0, 0.0), false);
    let (mut progress, mut greatest) = (Real::ZERO, Real::ZERO);
    nodes.points.iter().zip(first..).find_map(|(node, index)| {
        let to = Vector::between(p, [node.x, node.y]);
        let ends = [from, to];
        let [begins, comes_to] = [progress, to.dot(h)];
        let earlier = greatest;
        was_far |= !from.dot(from).certainly_at_most(far.squared());
        (from, progress, greatest) = (to, comes_to, greatest.max(comes_to));
        let compared =
            |pair: [Real; 2]| Witness::of(Rule::Reach, pair.map(Real::value)).at_point(index);
        // H-14.68
        let (back, most) = (earlier - begins.min(comes_to), Real::new(BACK));
        if !back.certainly_at_most(most) {
            let part = below(ends, [begins, comes_to], earlier - most);
            if !far.certainly_at_most(least_distance(part)) {
                return Some(compared([back, most]));
            }
        }
        let away = least_distance(ends);
        let is_near = was_far && !near.certainly_at_most(away);
        is_near.then(|| compared([away, near]))
    })
}

/// The part of a way that has less progress than the limit; one of its ends has.
fn below([a, b]: [Vector; 2], [begins, comes_to]: [Real; 2], limit: Real) -> [Vector; 2] {
    let gain = comes_to - begins;
    if gain.abs().certainly_at_most(Real::new(LEVEL)) {
        return [a, b];
    }
    let share = (limit - begins).over(gain).max(Real::ZERO).min(Real::ONE);
    let at = a + (b - a).times(share);
    if gain.value() > 0.0 { [a, at] } else { [at, b] }
}

/// From p to the nearest point of the way from a to b.
fn least_distance([a, b]: [Vector; 2]) -> Real {
    let u = b - a;
    if Real::ZERO.certainly_at_most(a.dot(u)) {
        a.norm()
    } else if b.dot(u).certainly_at_most(Real::ZERO) {
        b.norm()
    } else {
        // No point of its line is nearer.
        let line = a.cross(u).abs().over(u.norm());
        // Of a way of next to no length the line is lost in underflow.
        let length = u.x.magnitude() + u.y.magnitude();
        if line.off().is_finite() { line } else { a.norm().widened(length) }
    }
}

/// Whether some way may come back, in plain doubles: a node before the first that is far away is behind an earlier one, or
/// a way from there on is nearer.
fn may_return(cycle: &Cycle<'_>, nodes: &[TrajectoryPoint], beside: f64) -> bool {
    let ego = &cycle.ego;
    let far = Times::<f64>::new(cycle).s_stop + beside;
    let (leaves, enters) = ((far - ROUGH) * (far - ROUGH), (far + ROUGH) * (far + ROUGH));
    let (mut from, mut greatest, mut was_far) = ([0.0; 2], 0.0, false);
    nodes.iter().any(|node| {
        let to = [node.x - ego.x, node.y - ego.y];
        let is_clear = if was_far {
            least_square(from, to) >= enters
        } else {
            let progress = split([ego.cos, ego.sin], to)[0];
            let is_back = progress < greatest - BACK + ROUGH;
            (was_far, greatest) = (split(to, to)[0] > leaves, larger(greatest, progress));
            !is_back
        };
        from = to;
        !is_clear
    })
}

/// The square of the least distance of the way from a to b from p.
fn least_square(a: [f64; 2], b: [f64; 2]) -> f64 {
    let u = minus(b, a);
    if split(a, u)[0] >= 0.0 {
        return split(a, a)[0];
    }
    if split(b, u)[0] <= 0.0 {
        return split(b, b)[0];
    }
    let cross = split(a, u)[1];
    cross * cross / split(u, u)[0]
}
