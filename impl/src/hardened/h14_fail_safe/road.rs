//! Whether the path keeps to the road (`spec/hardened/H-14.md#requirements-the-road`).

use core::cmp::Ordering::{self, Equal, Greater, Less};
use core::iter;

use crate::hardened::h14_fail_safe::path::{Nodes, Path};
use crate::input::cycle::{CrossSection, Cycle, TrajectoryPoint};
use crate::numbers::plane::Vector;
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
            let mut found = route.plainly_between(ends, hint);
            if let (None, [one, last]) = (found, run)
                && one == last
            {
                found = route.between(piece.place(one).pose.at);
            }
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
    /// A pair of cross sections at which both points, and so all between them, certainly are in the corridor, from
    /// that of the hint on.
    fn plainly_between(&self, ends: [[f64; 2]; 2], hint: usize) -> Option<usize> {
        let at = self.walked(ends[0], hint);
        self.shapes(at).any(|shape| shape.holds_plainly(ends)).then_some(at)
    }

    /// A pair of cross sections at which the place certainly is in the corridor.
    fn between(&self, place: Vector) -> Option<usize> {
        let q = [place.x.value(), place.y.value()];
        self.pairs_around(q, MARGIN).find(|&at| self.shapes(at).any(|shape| shape.holds(place)))
    }

    /// Both triangles of a pair, those before and behind its last cross section, and each of the pair.
    fn shapes(&self, at: usize) -> impl Iterator<Item = Shape> {
        self.pair(at).into_iter().flat_map(move |(a, b)| {
            let across = self.after(at).map(|c| Shape::across(a, b, c));
            let each = triangles(a, b).map(Shape::of_triangle);
            iter::once(Shape::of_pair(a, b)).chain(across).chain(each)
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
        let q = [place.x.value(), place.y.value()];
        let plain = self.sides.map(|side| sign(side, q));
        if plain.contains(&Less) && plain.contains(&Greater) {
            return false;
        }
        let beside = |[from, to]: [[f64; 2]; 2], at: Vector| {
            Vector::between(from, to).cross(at - Vector::new(from[0], from[1]))
        };
        let [one, other] = self.triangles.map(|[a, b, [x, y]]| beside([a, b], Vector::new(x, y)));
        let turns_left = Real::ZERO.certainly_below(one.min(other));
        if !turns_left && !one.max(other).certainly_below(Real::ZERO) {
            return false;
        }
        self.sides.iter().all(|&side| {
            let beside = beside(side, place);
            let [least, most] =
                if turns_left { [Real::ZERO, beside] } else { [beside, Real::ZERO] };
            least.certainly_at_most(most)
        })
    }

    /// Whether both points are in it, in plain doubles, and by more than these may err.
    fn holds_plainly(&self, points: [[f64; 2]; 2]) -> bool {
        let [turn, other] = self.triangles.map(|[a, b, c]| sign([a, b], c));
        turn == other
            && turn != Equal
            && self.sides.iter().all(|&side| points.iter().all(|&point| sign(side, point) == turn))
    }
}

/// On which side the point is, `Greater` is left; in plain doubles, `Equal` where it is not beside by more than
/// these may err.
fn sign([[ax, ay], [bx, by]]: [[f64; 2]; 2], [x, y]: [f64; 2]) -> Ordering {
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
