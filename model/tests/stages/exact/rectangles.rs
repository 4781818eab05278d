//! Whether two rectangles share a point, now or when one of them has moved on: by corners inside and
//! sides that cross, in integers.

use mufasa_model::numbers::real::Real;
use mufasa_model::numbers::rectangle::{
    Rectangle, is_swept_over, is_swept_over_between, share_a_point,
};
use mufasa_model::numbers::vector::{Frame, Vector};

use super::Draw;

/// Units in a metre: 2^-23 m.
const METRE: i64 = 1 << 23;
/// The length of a direction: 2^20, up to rounding.
const ONE: i64 = 1 << 20;
/// Sizes are multiples of an eighth of a metre.
const EIGHTH: i64 = METRE / 8 / ONE;
/// More metres than between any two points of the rectangles drawn.
const FAR: i64 = 64;

/// A rectangle in integers: origin in units, direction in 1/`ONE`, half sizes in eighths of a metre.
#[derive(Clone, Copy, Debug)]
struct Whole {
    origin: [i64; 2],
    direction: [i64; 2],
    half: [i64; 2],
}

impl Whole {
    /// Origin + a direction + b left(direction), a and b in eighths of a metre.
    fn at(&self, a: i64, b: i64) -> [i64; 2] {
        let ([x, y], [cos, sin]) = (self.origin, self.direction);
        [x + EIGHTH * (a * cos - b * sin), y + EIGHTH * (a * sin + b * cos)]
    }

    fn corners(&self) -> [[i64; 2]; 4] {
        let [l, w] = self.half;
        [self.at(l, w), self.at(-l, w), self.at(-l, -w), self.at(l, -w)]
    }

    fn exact(&self) -> Rectangle {
        let real = |value: i64, unit: i64| {
            Real::from_integer(value.into()) / Real::from_integer(unit.into())
        };
        let vector = |[x, y]: [i64; 2], unit| Vector { x: real(x, unit), y: real(y, unit) };
        Rectangle {
            frame: Frame {
                origin: vector(self.origin, METRE),
                direction: vector(self.direction, ONE),
            },
            half_length: real(self.half[0], 8),
            half_width: real(self.half[1], 8),
        }
    }
}

/// Twice the area of a triangle, positive when it turns left.
fn turn(a: [i64; 2], b: [i64; 2], c: [i64; 2]) -> i128 {
    let part = |i: usize, j: usize| i128::from(b[i] - a[i]) * i128::from(c[j] - a[j]);
    part(0, 1) - part(1, 0)
}

/// The sides of a convex polygon, counterclockwise.
fn sides(corners: &[[i64; 2]]) -> impl Iterator<Item = [[i64; 2]; 2]> + Clone {
    (0..corners.len()).map(|i| [corners[i], corners[(i + 1) % corners.len()]])
}

/// The point is in the closed polygon.
fn holds(corners: &[[i64; 2]], point: [i64; 2]) -> bool {
    sides(corners).all(|[a, b]| turn(a, b, point) >= 0)
}

/// Two sides cross at a point inside both; touching ends are corners inside.
fn cross([a, b]: [[i64; 2]; 2], [c, d]: [[i64; 2]; 2]) -> bool {
    turn(a, b, c).signum() * turn(a, b, d).signum() < 0
        && turn(c, d, a).signum() * turn(c, d, b).signum() < 0
}

fn polygons_meet(a: &[[i64; 2]], b: &[[i64; 2]]) -> bool {
    a.iter().any(|corner| holds(b, *corner))
        || b.iter().any(|corner| holds(a, *corner))
        || sides(a).any(|one| sides(b).any(|other| cross(one, other)))
}

fn meet(a: &Whole, b: &Whole) -> bool {
    polygons_meet(&a.corners(), &b.corners())
}

/// The convex polygon around points, counterclockwise: half of it from left to right, and back.
fn around(mut points: Vec<[i64; 2]>) -> Vec<[i64; 2]> {
    points.sort_unstable();
    let half = |points: &mut dyn Iterator<Item = [i64; 2]>| {
        let mut chain: Vec<[i64; 2]> = Vec::new();
        for point in points {
            while let [.., a, b] = chain[..] {
                if turn(a, b, point) > 0 {
                    break;
                }
                chain.pop();
            }
            chain.push(point);
        }
        chain.pop();
        chain
    };
    let mut there = half(&mut points.iter().copied());
    there.extend(half(&mut points.iter().rev().copied()));
    there
}

/// `a` meets what `b` covers until it has moved on by `FAR` w, farther than anything is apart here.
fn is_met_on_the_way(a: &Whole, b: &Whole, w: [i64; 2]) -> bool {
    let end = b.corners().map(|[x, y]| [x + FAR * w[0], y + FAR * w[1]]);
    polygons_meet(&a.corners(), &around([b.corners(), end].concat()))
}

/// w in units, at least a metre long.
fn drawn_velocity(draw: &mut Draw, b: &Whole) -> [i64; 2] {
    let [cos, sin] = b.direction;
    match draw.between(0, 4) {
        0 => [METRE, 0],
        1 => [0, -METRE],
        // Along a side of it, up to rounding.
        2 => [cos * 8, sin * 8],
        3 => [-sin * 8, cos * 8],
        _ => {
            let [x, y] = [(1 << 23, 1 << 24), (-1 << 24, 1 << 24)]
                .map(|(low, high)| i64::from(draw.between(low, high)));
            if draw.between(0, 1) == 0 { [x, y] } else { [-x, y] }
        }
    }
}

/// As a vector of the model.
fn velocity_of(w: [i64; 2]) -> Vector {
    let [x, y] = w.map(|it| Real::from_integer(it.into()) / Real::from_integer(METRE.into()));
    Vector { x, y }
}

fn drawn(draw: &mut Draw) -> Whole {
    let mut eighths = |low, high| i64::from(draw.between(low, high));
    let origin = [eighths(-40, 40), eighths(-40, 40)].map(|it| it * METRE / 8);
    let half = [eighths(1, 24), eighths(1, 12)];
    let direction = match draw.between(0, 3) {
        0 => [ONE, 0],
        1 => [0, -ONE],
        _ => {
            let cos = i64::from(draw.between(-1 << 20, 1 << 20));
            [cos, (ONE * ONE - cos * cos).isqrt()]
        }
    };
    Whole { origin, direction, half }
}

#[test]
fn rectangles_anywhere_meet_as_their_corners_and_sides_say() {
    let mut draw = Draw::new(5);
    let mut seen = [0; 2];
    for _ in 0..3000 {
        let (a, b) = (drawn(&mut draw), drawn(&mut draw));
        let expected = meet(&a, &b);
        assert_eq!(share_a_point(&a.exact(), &b.exact()), expected, "{a:?} {b:?}");
        seen[usize::from(expected)] += 1;
    }
    assert!(seen.iter().all(|count| *count > 300), "{seen:?}");
}

/// Side on side, corner on side, corner on corner; and 2^-23 m nearer or farther.
#[test]
fn rectangles_that_touch_meet_and_a_unit_apart_they_do_not() {
    let mut draw = Draw::new(6);
    let mut seen = [0; 2];
    for case in 0..600 {
        let a = drawn(&mut draw);
        let mut b = Whole { direction: a.direction, ..drawn(&mut draw) };
        let most = a.half[0] + b.half[0];
        let along = match case % 3 {
            0 => most,
            1 => i64::from(draw.between(-1000, 1000)) % (most + 1),
            _ => -most,
        };
        b.origin = a.at(along, a.half[1] + b.half[1]);
        if case % 2 == 0 {
            // Turned by a right angle as often, so that length meets width.
            b = Whole {
                direction: [-b.direction[1], b.direction[0]],
                half: [b.half[1], b.half[0]],
                ..b
            };
        }
        assert!(meet(&a, &b) && share_a_point(&a.exact(), &b.exact()), "{a:?} {b:?}");
        for step in [[1, 0], [-1, 0], [0, 1], [0, -1]] {
            let moved = Whole { origin: [b.origin[0] + step[0], b.origin[1] + step[1]], ..b };
            let expected = meet(&a, &moved);
            assert_eq!(share_a_point(&a.exact(), &moved.exact()), expected, "{a:?} {moved:?}");
            seen[usize::from(expected)] += 1;
        }
    }
    assert!(seen.iter().all(|count| *count > 300), "{seen:?}");
}

#[test]
fn a_rectangle_that_moves_on_sweeps_over_what_its_convex_hull_meets() {
    let mut draw = Draw::new(7);
    let mut seen = [[0; 2]; 2];
    for _ in 0..3000 {
        let (a, b) = (drawn(&mut draw), drawn(&mut draw));
        let w = drawn_velocity(&mut draw, &b);
        let expected = is_met_on_the_way(&a, &b, w);
        let swept = is_swept_over(&a.exact(), &b.exact(), &velocity_of(w));
        assert_eq!(swept, expected, "{a:?} {b:?} {w:?}");
        seen[usize::from(meet(&a, &b))][usize::from(expected)] += 1;
        let stays = is_swept_over(&a.exact(), &b.exact(), &velocity_of([0, 0]));
        assert_eq!(stays, meet(&a, &b), "{a:?} {b:?}");
    }
    let [[never, later], [no, now]] = seen;
    assert!(never.min(later).min(now) > 300 && no == 0, "{seen:?}");
}

/// A corner of one on the side of the way of the other; and 2^-23 m nearer or farther.
#[test]
fn a_rectangle_beside_the_way_is_swept_over_where_it_touches() {
    let mut draw = Draw::new(8);
    let mut seen = [0; 2];
    for case in 0..600 {
        let mut a = drawn(&mut draw);
        let b = drawn(&mut draw);
        let w = drawn_velocity(&mut draw, &b);
        let left = |[x, y]: &[i64; 2]| {
            i128::from(w[0]) * i128::from(*y) - i128::from(w[1]) * i128::from(*x)
        };
        let (mut of_a, mut of_b) = (a.corners(), b.corners());
        of_a.sort_by_key(left);
        of_b.sort_by_key(left);
        let (near, on) = if case % 2 == 0 { (of_a[0], of_b[3]) } else { (of_a[3], of_b[0]) };
        let on_by = i64::from(draw.between(0, 2));
        for axis in [0, 1] {
            a.origin[axis] += on[axis] + on_by * w[axis] - near[axis];
        }
        let swept = |a: &Whole| is_swept_over(&a.exact(), &b.exact(), &velocity_of(w));
        assert!(is_met_on_the_way(&a, &b, w) && swept(&a), "{a:?} {b:?} {w:?}");
        for step in [[1, 0], [-1, 0], [0, 1], [0, -1]] {
            let moved = Whole { origin: [a.origin[0] + step[0], a.origin[1] + step[1]], ..a };
            let expected = is_met_on_the_way(&moved, &b, w);
            assert_eq!(swept(&moved), expected, "{moved:?} {b:?} {w:?}");
            seen[usize::from(expected)] += 1;
        }
    }
    assert!(seen.iter().all(|count| *count > 300), "{seen:?}");
}

/// `a` meets what `b` covers moved by r w, r from `from` to `to`.
fn is_met_between(a: &Whole, b: &Whole, w: [i64; 2], [from, to]: [i64; 2]) -> bool {
    let moved = |r: i64| b.corners().map(|[x, y]| [x + r * w[0], y + r * w[1]]);
    polygons_meet(&a.corners(), &around([moved(from), moved(to)].concat()))
}

/// Moved by no more than to a point that is on the way: it is met there or not, with both ends.
#[test]
fn a_rectangle_that_moves_so_far_sweeps_over_what_its_convex_hull_meets() {
    let mut draw = Draw::new(9);
    let mut seen = [0; 2];
    for _ in 0..3000 {
        let (a, b) = (drawn(&mut draw), drawn(&mut draw));
        let w = drawn_velocity(&mut draw, &b);
        let from = i64::from(draw.between(-3, 4));
        let ends = [from, from + i64::from(draw.between(0, 3))];
        let moved = ends.map(|r| velocity_of(w).scaled(&Real::from_integer(r.into())));
        let expected = is_met_between(&a, &b, w, ends);
        let swept = is_swept_over_between(&a.exact(), &b.exact(), &velocity_of(w), &moved);
        assert_eq!(swept, expected, "{a:?} {b:?} {w:?} {ends:?}");
        seen[usize::from(expected)] += 1;
        let none = velocity_of([0, 0]);
        let stays = [none.clone(), none.clone()];
        let stays = is_swept_over_between(&a.exact(), &b.exact(), &none, &stays);
        assert_eq!(stays, meet(&a, &b), "{a:?} {b:?}");
    }
    assert!(seen.iter().all(|count| *count > 300), "{seen:?}");
}
