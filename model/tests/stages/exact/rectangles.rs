//! Whether two rectangles share a point: by corners inside and sides that cross, in integers.

use mufasa_model::numbers::real::Real;
use mufasa_model::numbers::rectangle::{Rectangle, share_a_point};
use mufasa_model::numbers::vector::{Frame, Vector};

use super::Draw;

/// Units in a metre: 2^-23 m.
const METRE: i64 = 1 << 23;
/// The length of a direction: 2^20, up to rounding.
const ONE: i64 = 1 << 20;
/// Sizes are multiples of an eighth of a metre.
const EIGHTH: i64 = METRE / 8 / ONE;

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

/// The sides of a rectangle, counterclockwise.
fn sides(corners: &[[i64; 2]; 4]) -> [[[i64; 2]; 2]; 4] {
    [0, 1, 2, 3].map(|i| [corners[i], corners[(i + 1) % 4]])
}

/// The point is in the closed rectangle.
fn holds(corners: &[[i64; 2]; 4], point: [i64; 2]) -> bool {
    sides(corners).iter().all(|[a, b]| turn(*a, *b, point) >= 0)
}

/// Two sides cross at a point inside both; touching ends are corners inside.
fn cross([a, b]: [[i64; 2]; 2], [c, d]: [[i64; 2]; 2]) -> bool {
    turn(a, b, c).signum() * turn(a, b, d).signum() < 0
        && turn(c, d, a).signum() * turn(c, d, b).signum() < 0
}

fn meet(a: &Whole, b: &Whole) -> bool {
    let (a, b) = (a.corners(), b.corners());
    a.iter().any(|corner| holds(&b, *corner))
        || b.iter().any(|corner| holds(&a, *corner))
        || sides(&a).iter().any(|one| sides(&b).iter().any(|other| cross(*one, *other)))
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
