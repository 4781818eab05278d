//! Triangles and small squares, exactly: whether a union of triangles contains a square, or meets
//! it (`spec/4-arithmetic.md#strict-and-lax`).

use crate::numbers::reading::{Comparisons, Reading};
use crate::numbers::real::Real;
use crate::numbers::vector::Vector;

/// A closed triangle, possibly degenerate.
pub type Triangle = [Vector; 3];

/// The point lies in the union of the triangles; strictly, all of the square of half side delta
/// around it does; laxly, some point of that square.
pub fn is_in_union(reads: &Comparisons, triangles: &[Triangle], point: &Vector) -> bool {
    let square = || square(point, &reads.delta);
    match reads.reading {
        Reading::Exact => triangles.iter().any(|triangle| contains_point(triangle, point)),
        Reading::Strict => union_contains(triangles, &square()),
        Reading::Lax => union_meets(triangles, &square()),
    }
}

/// The axis-parallel closed square around a point, counterclockwise.
pub fn square(centre: &Vector, half_side: &Real) -> [Vector; 4] {
    let (left, right) = (&centre.x - half_side, &centre.x + half_side);
    let (below, above) = (&centre.y - half_side, &centre.y + half_side);
    [(&left, &below), (&right, &below), (&right, &above), (&left, &above)]
        .map(|(x, y)| Vector { x: x.clone(), y: y.clone() })
}

/// The point lies in the closed triangle.
pub fn contains_point(triangle: &Triangle, point: &Vector) -> bool {
    shares_a_point(triangle, std::slice::from_ref(point))
}

/// The square and some triangle of the union have a point in common.
pub fn union_meets(triangles: &[Triangle], square: &[Vector; 4]) -> bool {
    triangles.iter().any(|triangle| shares_a_point(triangle, square))
}

/// Every point of the square lies in some triangle: nothing of positive area is left of it when
/// all triangles are cut off. (What is left of a closed square without closed triangles is open in
/// the square; it is empty or has a positive area.)
pub fn union_contains(triangles: &[Triangle], square: &[Vector; 4]) -> bool {
    let mut rest = vec![square.to_vec()];
    for triangle in triangles.iter().filter(|triangle| shares_a_point(triangle, square)) {
        rest = rest.iter().flat_map(|piece| without(piece, triangle)).collect();
    }
    rest.is_empty()
}

/// Two convex sets of corners, the first a triangle, have a point in common: neither an axis of
/// the plane nor a normal of a side of the triangle separates them. That is enough when the other
/// is an axis-parallel square or a point.
fn shares_a_point(triangle: &Triangle, other: &[Vector]) -> bool {
    let zero = Real::zero();
    let overlaps = |coordinate: fn(&Vector) -> &Real| {
        let is_beyond = |a: &[Vector], b: &[Vector]| {
            a.iter().all(|a| b.iter().all(|b| coordinate(a) > coordinate(b)))
        };
        !is_beyond(triangle, other) && !is_beyond(other, triangle)
    };
    let sides = || (0..3).map(|i| (&triangle[i], &triangle[(i + 1) % 3], &triangle[(i + 2) % 3]));
    overlaps(|point| &point.x)
        && overlaps(|point| &point.y)
        && sides().all(|(from, to, opposite)| {
            let side = to - from;
            let beside = |point: &Vector| side.cross(&(point - from));
            let opposite = beside(opposite);
            let others: Vec<Real> = other.iter().map(beside).collect();
            // The triangle lies between the side, at 0, and the opposite corner.
            let all_left = others.iter().all(|beside| *beside > zero && *beside > opposite);
            let all_right = others.iter().all(|beside| *beside < zero && *beside < opposite);
            !all_left && !all_right
        })
}

/// The convex pieces of positive area that are left of a convex piece outside the triangle.
fn without(piece: &[Vector], triangle: &Triangle) -> Vec<Vec<Vector>> {
    let area = (&triangle[1] - &triangle[0]).cross(&(&triangle[2] - &triangle[0]));
    let counterclockwise = match area.cmp(&Real::zero()) {
        std::cmp::Ordering::Equal => return vec![piece.to_vec()],
        std::cmp::Ordering::Greater => [&triangle[0], &triangle[1], &triangle[2]],
        std::cmp::Ordering::Less => [&triangle[0], &triangle[2], &triangle[1]],
    };
    let mut inside = piece.to_vec();
    let mut left = Vec::new();
    for i in 0..3 {
        let (from, to) = (counterclockwise[i], counterclockwise[(i + 1) % 3]);
        left.extend(half(&inside, to, from));
        match half(&inside, from, to) {
            Some(rest) => inside = rest,
            None => break,
        }
    }
    left
}

/// The part of a convex piece to the left of a line; `None` without a positive area.
fn half(piece: &[Vector], from: &Vector, to: &Vector) -> Option<Vec<Vector>> {
    let direction = to - from;
    let side = |point: &Vector| direction.cross(&(point - from));
    let zero = Real::zero();
    let sides: Vec<Real> = piece.iter().map(side).collect();
    if sides.iter().all(|side| *side <= zero) {
        return None;
    }
    let mut part = Vec::new();
    for (i, point) in piece.iter().enumerate() {
        let next = (i + 1) % piece.len();
        if sides[i] >= zero {
            part.push(point.clone());
        }
        let crosses =
            (sides[i] > zero && sides[next] < zero) || (sides[i] < zero && sides[next] > zero);
        if crosses {
            let share = &sides[i] / (&sides[i] - &sides[next]);
            part.push(point + &(&piece[next] - point).scaled(&share));
        }
    }
    Some(part)
}

#[cfg(test)]
mod tests {
    use super::{contains_point, square, union_contains, union_meets};
    use crate::numbers::real::Real;
    use crate::numbers::vector::Vector;

    fn point(x: f64, y: f64) -> Vector {
        Vector::from_doubles(x, y)
    }

    fn tile() -> Vec<[Vector; 3]> {
        let [a, b, c, d] = [point(0.0, 0.0), point(4.0, 0.0), point(4.0, 4.0), point(0.0, 4.0)];
        // One of each orientation, and a degenerate one.
        vec![[a.clone(), b, c.clone()], [a.clone(), d, c.clone()], [a.clone(), c, a]]
    }

    #[test]
    fn square_across_the_shared_edge_is_contained() {
        let half = Real::from_double(0.5);
        assert!(union_contains(&tile(), &square(&point(2.0, 2.0), &half)));
        assert!(union_contains(&tile(), &square(&point(0.5, 0.5), &half)));
        assert!(!union_contains(&tile(), &square(&point(0.5, 0.499_999), &half)));
        assert!(!union_contains(&tile()[..1], &square(&point(2.0, 2.0), &half)));
        assert!(!union_contains(&tile()[2..], &square(&point(2.0, 2.0), &half)));
    }

    #[test]
    fn squares_meet_at_a_corner() {
        let half = Real::from_double(0.5);
        assert!(union_meets(&tile(), &square(&point(-0.5, -0.5), &half)));
        assert!(!union_meets(&tile(), &square(&point(-0.500_001, -0.5), &half)));
        assert!(union_meets(&tile()[2..], &square(&point(2.0, 3.0), &half)));
        assert!(!union_meets(&tile()[2..], &square(&point(2.0, 3.000_001), &half)));
    }

    #[test]
    fn triangles_are_closed() {
        assert!(contains_point(&tile()[0], &point(2.0, 2.0)));
        assert!(contains_point(&tile()[0], &point(4.0, 4.0)));
        assert!(!contains_point(&tile()[0], &point(2.0, 2.000_001)));
        assert!(contains_point(&tile()[2], &point(3.0, 3.0)));
        assert!(!contains_point(&tile()[2], &point(5.0, 5.0)));
    }
}
