//! Whether the path keeps to the road (`spec/hardened/H-14.md#requirements-the-road`).

use core::cmp::Ordering;

use crate::hardened::h14_fail_safe::path::{Nodes, Path, Place};
use crate::input::cycle::{CrossSection, Cycle, TrajectoryPoint};
use crate::numbers::exact::{certain_orientation, orientation};
use crate::numbers::plane::{Vector, same_point};
use crate::numbers::rounding::Real;
use crate::report::{Rule, Witness};
use crate::stages::ii_trajectory_to_map::indexed_route::IndexedRoute;

/// What plain doubles leave open, m: places err by less than 2^-20 m in them.
const MARGIN: f64 = 1e-6;

/// The first place that is not certainly in the corridor.
pub(crate) fn road_failure(
    cycle: &Cycle<'_>,
    route: IndexedRoute<'_, '_>,
    points: &[TrajectoryPoint],
) -> Option<Witness> {
    let (path, mut hint) = (Path::new(Nodes::new(cycle, points)), 0);
    path.pieces().find_map(|piece| {
        let is_inside = |run: [i64; 2]| {
            let ends = piece.between(run, [0.0; 2]).map(|[x, y, _]| [x, y]);
            let found = route.plainly_between(ends, hint);
            hint = found.unwrap_or(hint);
            found.is_some()
        };
        piece.first_place(is_inside, |place| failure_at(route, points.len(), place))
    })
}

fn failure_at(route: IndexedRoute<'_, '_>, points: usize, place: &Place) -> Option<Witness> {
    // H-14.58
    if place.number == 0 || route.is_between(place.pose.at) {
        return None;
    }
    let Vector { x, y } = place.pose.at;
    let witness = route.too_far([x.value(), y.value()], 0, Rule::Corridor, 0.0);
    Some(witness.at_point(place.point(points)))
}

impl IndexedRoute<'_, '_> {
    /// A pair of cross sections between which both points, and so all between them, certainly are: from that of
    /// the hint on, a point alone anywhere.
    fn plainly_between(&self, ends: [[f64; 2]; 2], hint: usize) -> Option<usize> {
        let holds = |at: &usize| {
            self.pair(*at).is_some_and(|(a, b)| Shape::of_pair(a, b).holds_plainly(ends))
        };
        let [from, to] = ends;
        let expected = Some(self.walked(from, hint)).filter(holds);
        expected.or_else(|| {
            same_point(from, to).then(|| self.pairs_around(from, 0.0).find(holds)).flatten()
        })
    }

    /// Whether the place certainly is in the corridor.
    fn is_between(&self, place: Vector) -> bool {
        let q = [place.x.value(), place.y.value()];
        self.pairs_around(q, MARGIN).any(|at| {
            self.pair(at).is_some_and(|(a, b)| {
                let across = self.after(at).map(|c| Shape::across(a, b, c));
                let [one, other] = triangles(a, b).map(Shape::of_triangle);
                let shapes = [Some(Shape::of_pair(a, b)), Some(one), Some(other), across];
                shapes.into_iter().flatten().any(|shape| shape.holds(place))
            })
        })
    }
}

type Triangle = [[f64; 2]; 3];

/// Those between two cross sections (S2-02).
const fn triangles(a: &CrossSection, b: &CrossSection) -> [Triangle; 2] {
    [[a.left, a.right, b.right], [a.left, b.right, b.left]]
}

/// What is on the inner side of the sides of two triangles that share a side, other than that one: convex, and
/// in one of them. A triangle is two of itself.
struct Shape {
    triangles: [Triangle; 2],
    sides: [[[f64; 2]; 2]; 4],
}

impl Shape {
    fn of_pair(a: &CrossSection, b: &CrossSection) -> Self {
        let sides = [[a.left, a.right], [a.right, b.right], [b.right, b.left], [b.left, a.left]];
        Self { triangles: triangles(a, b), sides }
    }

    /// The triangles on both sides of a cross section.
    fn across(a: &CrossSection, b: &CrossSection, c: &CrossSection) -> Self {
        let ([_, before], [after, _]) = (triangles(a, b), triangles(b, c));
        let sides = [[a.left, b.right], [b.right, c.right], [c.right, b.left], [b.left, a.left]];
        Self { triangles: [before, after], sides }
    }

    fn of_triangle([a, b, c]: Triangle) -> Self {
        Self { triangles: [[a, b, c]; 2], sides: [[a, b], [b, c], [c, a], [c, a]] }
    }

    /// Whether the place certainly is in it. MARGIN-17: nothing is in triangles that turn differently.
    fn holds(&self, place: Vector) -> bool {
        let [turn, other] = self.triangles.map(|[a, b, c]| orientation(a, b, c));
        turn != Ordering::Equal
            && turn == other
            && self.sides.iter().all(|&[from, to]| {
                let beside = Vector::between(from, to).cross(place - Vector::new(from[0], from[1]));
                let [least, most] = if turn == Ordering::Less {
                    [beside, Real::ZERO]
                } else {
                    [Real::ZERO, beside]
                };
                least.certainly_at_most(most)
            })
    }

    /// Whether both points are in it, in plain doubles, and by more than these may err.
    fn holds_plainly(&self, points: [[f64; 2]; 2]) -> bool {
        let [turn, other] = self.triangles.map(|[a, b, c]| certain_orientation(a, b, c));
        let sign = if turn < 0.0 { -1.0 } else { 1.0 };
        turn * other > 0.0
            && self.sides.iter().all(|&[[ax, ay], [bx, by]]| {
                let (ux, uy) = (bx - ax, by - ay);
                points.iter().all(|&[x, y]| {
                    let (one, less) = (ux * (y - ay), uy * (x - ax));
                    let error = MARGIN * (ux.abs() + uy.abs()) + 1e-15 * (one.abs() + less.abs());
                    sign * (one - less) > error
                })
            })
    }
}

#[cfg(test)]
mod tests;
