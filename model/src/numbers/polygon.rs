//! Triangles and small squares, exactly: whether a union of triangles contains a square, or meets
//! it (`spec/4-arithmetic.md#strict-and-lax`).

use std::cmp::Ordering;

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

/// The point lies in the union of the triangles, each of which has a side in common with the next, in a
/// closed strip the last with the first. Strictly, all of its square, of half side delta or 10^-5 m, the greater, lies
/// in one of them, or in two neighbours and on the inner side of each of their outer sides; laxly, some point of the
/// square of half side delta in one.
pub fn is_in_strip(reads: &Comparisons, strip: &[Triangle], closed: bool, point: &Vector) -> bool {
    match reads.reading {
        Reading::Exact | Reading::Lax => is_in_union(reads, strip, point),
        Reading::Strict => {
            let half_side = reads.m_at_least(Real::from_double(1e-5));
            strip_contains(strip, closed, &square(point, &half_side))
        }
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

/// One triangle with an area, or two neighbours with an area that turn the same way round, have the
/// square on the inner side of each side that is not common to both. (Others than those that the
/// square meets cannot.)
pub fn strip_contains(strip: &[Triangle], closed: bool, square: &[Vector; 4]) -> bool {
    let meets = |triangle: &Triangle| shares_a_point(triangle, square);
    let closing = closed.then(|| [&strip[strip.len() - 1], &strip[0]]);
    let neighbours = strip.windows(2).map(|pair| [&pair[0], &pair[1]]).chain(closing);
    let mut pairs = neighbours.filter(|[a, b]| meets(a) || meets(b));
    let mut triangles = strip.iter().filter(|triangle| meets(triangle));
    triangles.any(|triangle| are_around(&sides(triangle), turn(triangle), square))
        || pairs.any(|[a, b]| {
            let outer = [outer_sides(a, b), outer_sides(b, a)].concat();
            turn(a) == turn(b) && are_around(&outer, turn(a), square)
        })
}

/// The sides of a triangle, from corner to corner.
fn sides([a, b, c]: &Triangle) -> [[&Vector; 2]; 3] {
    [[a, b], [b, c], [c, a]]
}

/// The sides of a triangle that are no side of another one.
fn outer_sides<'a>(triangle: &'a Triangle, other: &Triangle) -> Vec<[&'a Vector; 2]> {
    let is_common = |side: &[&Vector; 2]| side.iter().all(|end| other.contains(end));
    sides(triangle).into_iter().filter(|side| !is_common(side)).collect()
}

/// All of the square is on the inner side of sides that turn left (`Greater`) or right (`Less`).
fn are_around(sides: &[[&Vector; 2]], turn: Ordering, square: &[Vector; 4]) -> bool {
    let is_inside = |[from, to]: &[&Vector; 2], corner: &Vector| {
        (*to - *from).cross(&(corner - *from)).cmp(&Real::zero()) != turn.reverse()
    };
    turn != Ordering::Equal
        && sides.iter().all(|side| square.iter().all(|corner| is_inside(side, corner)))
}

/// Which way round a triangle turns: left (`Greater`), right (`Less`), or it has no area.
fn turn([a, b, c]: &Triangle) -> Ordering {
    (b - a).cross(&(c - a)).cmp(&Real::zero())
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
    let counterclockwise = match turn(triangle) {
        Ordering::Equal => return vec![piece.to_vec()],
        Ordering::Greater => [&triangle[0], &triangle[1], &triangle[2]],
        Ordering::Less => [&triangle[0], &triangle[2], &triangle[1]],
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
    use super::{contains_point, square, strip_contains, union_contains, union_meets};
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

    /// Two squares of 4 m side by side, (left, right, next right) and (left, next right, next left) of each.
    fn strip(last_left: Vector) -> Vec<[Vector; 3]> {
        let left = [point(0.0, 4.0), point(4.0, 4.0), last_left];
        let right = [point(0.0, 0.0), point(4.0, 0.0), point(8.0, 0.0)];
        let triangles = |i: usize| {
            [[&left[i], &right[i], &right[i + 1]], [&left[i], &right[i + 1], &left[i + 1]]]
        };
        (0..2).flat_map(triangles).map(|triangle| triangle.map(Vector::clone)).collect()
    }

    #[test]
    fn neighbours_contain_a_square_across_their_common_side() {
        let contains = |x: f64, y: f64| {
            let square = square(&point(x, y), &Real::from_double(0.5));
            let strip = strip(point(8.0, 4.0));
            let mirrored: Vec<_> =
                strip.iter().map(|[a, b, c]| [b, a, c].map(Vector::clone)).collect();
            let found = strip_contains(&strip, false, &square);
            assert_eq!(strip_contains(&mirrored, false, &square), found, "turned the other way");
            assert!(!found || union_contains(&strip, &square));
            found
        };
        assert!(contains(1.0, 1.0), "in one triangle");
        assert!(contains(2.0, 2.0), "across the diagonal of a square");
        assert!(contains(4.0, 2.0), "across the side of two squares");
        assert!(contains(0.5, 3.5) && contains(0.5, 0.5), "on the boundary");
        assert!(!contains(0.499_999, 0.5) && !contains(0.5, 3.500_001));
        assert!(!contains(4.0, 0.5), "across three triangles");
    }

    #[test]
    fn a_closed_strip_has_a_neighbour_of_the_last() {
        let mut strip = strip(point(8.0, 4.0));
        strip.rotate_left(2);
        let across = square(&point(4.0, 2.0), &Real::from_double(0.5));
        assert!(!strip_contains(&strip, false, &across));
        assert!(strip_contains(&strip, true, &across));
    }

    #[test]
    fn triangles_at_a_fold_or_without_an_area_are_no_neighbours() {
        let half = Real::from_double(0.5);
        // The last triangle, (4, 4), (8, 0), (4, 1), folds back.
        let folded = strip(point(4.0, 1.0));
        assert!(!strip_contains(&folded, false, &square(&point(6.0, 2.0), &half)));
        assert!(strip_contains(&folded[3..], false, &square(&point(5.0, 2.0), &half)));
        // Its corners are on a line now.
        let flat = strip(point(6.0, 2.0));
        let dot = square(&point(6.0, 2.0), &Real::zero());
        assert!(!strip_contains(&flat[3..], false, &dot));
        assert!(strip_contains(&flat, false, &dot));
    }

    #[test]
    fn neighbours_with_a_corner_inwards_contain_what_all_their_outer_sides_see() {
        // The boundary turns right at (8, 0), on to (12, -2).
        let inwards = strip(point(12.0, -2.0));
        let contained = |x: f64, y: f64| {
            let square = square(&point(x, y), &Real::from_double(0.25));
            [strip_contains(&inwards, false, &square), union_contains(&inwards, &square)]
        };
        assert_eq!(contained(7.25, 0.75), [true, true]);
        assert_eq!(contained(7.5, 0.5), [false, true]);
    }
}
