//! Whether the path keeps to the road (`spec/hardened/H-14.md#requirements-the-road`).

use core::cmp::Ordering::{self, Equal, Greater, Less};

use crate::hardened::h14_fail_safe::nodes::{Line, Nodes};
use crate::hardened::h14_fail_safe::path::Path;
use crate::input::cycle::{CrossSection, Cycle, TrajectoryPoint};
use crate::numbers::plane::Vector;
use crate::numbers::range::{larger, smaller};
use crate::report::{Rule, Witness};
use crate::stages::ii_trajectory_to_map::indexed_route::{IndexedRoute, triangles};
use crate::stages::llcc::sweep::minus;

/// What plain doubles leave open, m: places err by less than 2^-20 m in them.
const MARGIN: f64 = 1e-6;

/// So long is what is looked at in plain doubles at least, m: about from place to place.
const SHORTEST: f64 = 0.25;

/// The first place that is not certainly in the corridor. Of most paths plain doubles tell line by line that there is none.
pub(crate) fn road_failure(
    cycle: &Cycle<'_>,
    route: IndexedRoute<'_, '_>,
    points: &[TrajectoryPoint],
) -> Option<Witness> {
    let (nodes, p, mut hint) = (Nodes::new(cycle, points), [cycle.ego.x, cycle.ego.y], 0);
    route.in_corridor(p, &mut hint);
    if nodes.lines().all(|line| route.plainly_contains(p, &line, &mut hint)) {
        return None;
    }
    let path = Path::new(nodes);
    path.pieces().find_map(|piece| {
        let is_inside = |run: [i64; 2]| {
            let ends = piece.between(run, [0.0; 2]).map(|[x, y, _]| [x, y]);
            let is_one = run[0] == run[1];
            let is_known = is_one && piece.has_certain_end();
            let place =
                || is_known.then(|| route.between(piece.plainly(run[0], [0.0; 2]))).flatten();
            let found = route.plainly_between(ends, hint).or_else(place);
            hint = found.unwrap_or(hint);
            // H-14.58, A-04
            found.is_some() || piece.first.saturating_add(run[1]) == 0
        };
        piece.first_place(is_inside, |place| {
            let Vector { x, y } = place.pose.at;
            let witness = route.too_far([x.value(), y.value()], 0, Rule::Corridor, 0.0);
            Some(witness.at_point(place.point(points.len())))
        })
    })
}

impl IndexedRoute<'_, '_> {
    /// Whether the line, seen from p, certainly is in the corridor: piece by piece, which are half as long where it
    /// was not.
    fn plainly_contains(&self, [x, y]: [f64; 2], line: &Line, hint: &mut usize) -> bool {
        let (from, [ux, uy]) = ([x + line.from[0], y + line.from[1]], minus(line.to, line.from));
        let shortest = SHORTEST / larger(larger(ux.abs(), uy.abs()), SHORTEST);
        let after = |part: f64| [from[0] + part * ux, from[1] + part * uy];
        let (mut at, mut size) = (0.0, 1.0);
        while at < 1.0 {
            let end = smaller(at + size, 1.0);
            if let Some(found) = self.plainly_between([at, end].map(after), *hint) {
                (*hint, at) = (found, end);
            } else if size > shortest {
                size *= 0.5;
            } else {
                return false;
            }
        }
        true
    }

    /// A pair of cross sections at which both points, and so all between them, certainly are in the corridor, from
    /// that of the hint on.
    fn plainly_between(&self, ends: [[f64; 2]; 2], hint: usize) -> Option<usize> {
        let at = self.walked(ends[0], hint);
        let (a, b) = self.pair(at)?;
        let [from, to] = ends;
        let pair = of_pair(a, b);
        let turn = inner_side(&pair, from);
        // What leaves the pair leaves its triangles.
        let is_found = if turn == Equal {
            triangles(a, b).iter().any(|triangle| are_inside(triangle, ends))
        } else {
            turn == inner_side(&pair, to)
        };
        let is_found =
            is_found || self.after(at).is_some_and(|c| are_inside(&across(a, b, c), ends));
        is_found.then_some(at)
    }

    /// A pair of cross sections at which the place certainly is in the corridor.
    fn between(&self, q: Point) -> Option<usize> {
        self.pairs_around(q, MARGIN).find(|&at| {
            self.pair(at).is_some_and(|(a, b)| {
                are_inside(&of_pair(a, b), [q; 2])
                    || self.after(at).is_some_and(|c| are_inside(&across(a, b, c), [q; 2]))
                    || triangles(a, b).iter().any(|triangle| are_inside(triangle, [q; 2]))
            })
        })
    }
}

type Point = [f64; 2];

/// The corners of the triangles of a pair, from a common one to the other and back. What is on the inner side of all
/// four sides is in one of the triangles, on whichever side of the common one it is.
const fn of_pair(a: &CrossSection, b: &CrossSection) -> [Point; 4] {
    [a.left, a.right, b.right, b.left]
}

/// The same of the triangles before and behind the cross section b.
const fn across(a: &CrossSection, b: &CrossSection, c: &CrossSection) -> [Point; 4] {
    [b.right, c.right, b.left, a.left]
}

fn sides<const N: usize>(corners: &[Point; N]) -> impl Iterator<Item = [Point; 2]> {
    let mut from = corners.last().copied().unwrap_or_default();
    corners.iter().map(move |&to| [core::mem::replace(&mut from, to), to])
}

/// Whether both points, and so all between them, certainly are inside, in plain doubles.
fn are_inside<const N: usize>(corners: &[Point; N], [from, to]: [Point; 2]) -> bool {
    let turn = inner_side(corners, from);
    turn != Equal && turn == inner_side(corners, to)
}

/// On which side of all sides the point certainly is, in plain doubles; `Equal` where it is not on one of all.
fn inner_side<const N: usize>(corners: &[Point; N], point: Point) -> Ordering {
    let mut signs = sides(corners).map(|side| sign(side, point));
    let turn = signs.next().unwrap_or(Equal);
    if signs.all(|it| it == turn) { turn } else { Equal }
}

/// On which side the point is, `Greater` is left; in plain doubles, `Equal` where it is not beside by more than
/// these may err.
fn sign([[ax, ay], [bx, by]]: [Point; 2], [x, y]: Point) -> Ordering {
    let (ux, uy) = (bx - ax, by - ay);
    let (one, other) = (ux * (y - ay), uy * (x - ax));
    let error = MARGIN * (ux.abs() + uy.abs()) + 1e-15 * (one.abs() + other.abs());
    let beside = one - other;
    if beside > error {
        Greater
    } else if beside < -error {
        Less
    } else {
        Equal
    }
}

#[cfg(test)]
mod tests;
