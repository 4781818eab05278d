//! Two closed rectangles and the separating-axis test
//! (`spec/3-stages.md#low-level-collision-check-llcc`), which stage iii asks of tracks
//! (`spec/3-stages.md#stage-iii-trajectory-with-tracks`). Directions are any vectors but 0: used as
//! given, they scale the rectangle.

use crate::claim::{Theorem, Wrong};
use crate::numbers::real::Real;
use crate::numbers::real::formula::{Formula, at_most, given, less, same};
use crate::numbers::rectangle::{Rectangle, is_swept_over, is_swept_over_between, share_a_point};
use crate::numbers::vector::{Frame, Vector};

/// The theorems of this file.
pub const THEOREMS: &[Theorem] = &[
    Theorem {
        id: "the_test_of_two_rectangles_is_independent_of_the_frame",
        statement: "moving and turning both rectangles alike changes nothing",
        domain: "all positions, sizes > 0, directions other than 0",
        claim: || {
            let (a, b) = (rectangle("a"), rectangle("b"));
            let motion = motion();
            let moved = share_a_point(&motion(&a), &motion(&b));
            Formula::from(share_a_point(&a, &b) == moved)
        },
        wrong: Wrong {
            statement: "moving one rectangle changes nothing",
            claim: || {
                let (a, b) = (at_home("a"), at_home("b"));
                let mut moved = b.clone();
                moved.frame.origin.x = Real::variable("by");
                Formula::from(share_a_point(&a, &b) == share_a_point(&a, &moved))
            },
        },
    },
    Theorem {
        id: "the_test_of_two_rectangles_is_symmetric",
        statement: "a meets b exactly when b meets a",
        domain: "all positions, sizes > 0, directions other than 0; a at the origin along x",
        claim: || {
            let (a, b) = (at_home("a"), rectangle("b"));
            Formula::from(share_a_point(&a, &b) == share_a_point(&b, &a))
        },
        wrong: Wrong {
            statement: "also when they exchange their sizes",
            claim: || {
                let (a, b) = (at_home("a"), rectangle("b"));
                let of_size = |frame: &Rectangle, size: &Rectangle| Rectangle {
                    frame: frame.frame.clone(),
                    ..size.clone()
                };
                let exchanged = share_a_point(&of_size(&a, &b), &of_size(&b, &a));
                Formula::from(share_a_point(&a, &b) == exchanged)
            },
        },
    },
    Theorem {
        id: "two_rectangles_that_share_a_point_are_found",
        statement: "a point of both closed rectangles makes the separating-axis test say so",
        domain: "all positions, sizes > 0, directions other than 0; a at the origin along x",
        claim: || shared_point_is_found(&Real::from_integer(1)),
        wrong: Wrong {
            statement: "a point of both rectangles, one enlarged by 1 %, makes the test say so",
            claim: || shared_point_is_found(&Real::ratio(101, 100)),
        },
    },
    Theorem {
        id: "a_rectangle_that_is_swept_over_is_found",
        statement: "a point of a that is one of b + w t for some t >= 0 makes the test say so",
        domain: "both along x, a at the origin, w_x, w_y > 0, all positions, t and sizes > 0",
        claim: || swept_over_is_found(&Real::zero()),
        wrong: Wrong {
            statement: "for some t >= -1",
            claim: || swept_over_is_found(&Real::from_integer(-1)),
        },
    },
    Theorem {
        id: "a_rectangle_that_is_swept_over_between_is_found",
        statement: "a point of a that is one of b + w t for some t from t1 to t2 makes the test of b moved by w t1 to w t2 say \
                    so",
        domain: "all positions, w, t1 <= t2, sizes > 0; a at the origin along x, b turned left by less than 90 degrees",
        claim: || swept_over_between_is_found(&Real::zero()),
        wrong: Wrong {
            statement: "for some t from t1 to t2 + 1",
            claim: || swept_over_between_is_found(&Real::from_integer(1)),
        },
    },
    Theorem {
        id: "a_rectangle_is_swept_over_only_where_it_shares_a_point",
        statement: "when the test of a and b + w t says so, they share a point at t = 0 or where a side of b comes to one of a",
        domain: "both along x, a at the origin, w_x, w_y > 0, all positions and sizes > 0",
        claim: || shares_a_point(is_swept_over, 0, None),
        wrong: Wrong {
            statement: "at t = 1 or there",
            claim: || shares_a_point(is_swept_over, 1, None),
        },
    },
    Theorem {
        id: "a_rectangle_is_swept_over_between_only_where_it_shares_a_point",
        statement: "when the test of a and b moved by 0 to w says so, they share a point at t = 0 or where a side of b comes to \
                    one of a, before t = 1",
        domain: "both along x, a at the origin, w_x, w_y > 0, all positions and sizes > 0",
        claim: || shares_a_point(until_1, 0, Some(1)),
        wrong: Wrong {
            statement: "at t = 1 or there",
            claim: || shares_a_point(until_1, 1, Some(1)),
        },
    },
    Theorem {
        id: "an_object_that_stands_sweeps_over_itself",
        statement: "both tests of b that does not move are the test of a and b",
        domain: "all positions, sizes > 0; a at the origin along x, b turned left by less than 90 degrees",
        claim: || stands(&Real::zero()),
        wrong: Wrong {
            statement: "of b that moves along x",
            claim: || stands(&Real::from_integer(1)),
        },
    },
];

/// Any rectangle.
fn rectangle(name: &str) -> Rectangle {
    let direction = vector(&format!("direction {name}"));
    given(less(&Real::zero(), &direction.squared()));
    sized(name, Frame { origin: vector(name), direction })
}

/// A rectangle at the origin along x: any rectangle, seen from its own frame.
fn at_home(name: &str) -> Rectangle {
    let scale = Real::variable(&format!("scale {name}"));
    given(less(&Real::zero(), &scale));
    let direction = Vector { x: scale, y: Real::zero() };
    sized(name, Frame { origin: Vector { x: Real::zero(), y: Real::zero() }, direction })
}

fn sized(name: &str, frame: Frame) -> Rectangle {
    let [half_length, half_width] =
        ["length", "width"].map(|side| Real::variable(&format!("half {side} {name}")));
    given(less(&Real::zero(), &half_length));
    given(less(&Real::zero(), &half_width));
    Rectangle { frame, half_length, half_width }
}

/// Any point or vector.
pub fn vector(name: &str) -> Vector {
    let [x, y] = ["x", "y"].map(|axis| Real::variable(&format!("{axis} {name}")));
    Vector { x, y }
}

/// Any point of a closed rectangle of this frame and these half sides.
pub fn point_of(name: &str, rectangle: &Rectangle) -> Vector {
    let sides = [("along", &rectangle.half_length), ("across", &rectangle.half_width)];
    let [a, b] = sides.map(|(axis, half)| {
        let coordinate = Real::variable(&format!("{axis} {name}"));
        given(at_most(&-half, &coordinate));
        given(at_most(&coordinate, half));
        coordinate
    });
    rectangle.frame.point(&a, &b)
}

/// Turning by any angle and moving by any vector.
fn motion() -> impl Fn(&Rectangle) -> Rectangle {
    let ([cos, sin], by) = (Real::unit("motion"), vector("motion"));
    let turned =
        move |v: &Vector| Vector { x: &cos * &v.x - &sin * &v.y, y: &sin * &v.x + &cos * &v.y };
    move |rectangle| Rectangle {
        frame: Frame {
            origin: &turned(&rectangle.frame.origin) + &by,
            direction: turned(&rectangle.frame.direction),
        },
        ..rectangle.clone()
    }
}

fn shared_point_is_found(enlarged: &Real) -> Formula {
    let (a, b) = (at_home("a"), rectangle("b"));
    let larger = Rectangle { half_length: &a.half_length * enlarged, ..a.clone() };
    given(same(&point_of("a", &larger), &point_of("b", &b)));
    Formula::from(share_a_point(&a, &b))
}

/// A rectangle at the origin, another one anywhere, both along x.
fn both_along_x() -> [Rectangle; 2] {
    let zero = || Vector { x: Real::zero(), y: Real::zero() };
    [("a", zero()), ("b", vector("b"))].map(|(name, origin)| {
        let direction = Vector { x: Real::from_integer(1), y: Real::zero() };
        sized(name, Frame { origin, direction })
    })
}

/// A velocity with parts along x and y above 0.
fn ahead_and_left() -> Vector {
    let w = vector("w");
    for part in [&w.x, &w.y] {
        given(less(&Real::zero(), part));
    }
    w
}

/// How far apart the centres are along x and y, and how far the rectangles reach together.
fn sides(a: &Rectangle, b: &Rectangle) -> [(Real, Real); 2] {
    let Vector { x, y } = &b.frame.origin - &a.frame.origin;
    [(x, &a.half_length + &b.half_length), (y, &a.half_width + &b.half_width)]
}

/// a shares a point with b moved by `moved`, both along x.
fn shared_along_x(a: &Rectangle, b: &Rectangle, moved: &Vector) -> Formula {
    let [x, y] = sides(a, b);
    let within = |(apart, most): (Real, Real), moved: &Real| {
        let apart = apart + moved;
        [at_most(&apart, &most), at_most(&-most, &apart)]
    };
    Formula::All([within(x, &moved.x), within(y, &moved.y)].concat())
}

/// A rectangle turned left by less than a right angle: any rectangle has such a direction, when its sides
/// may change their names.
fn turned_left(name: &str) -> Rectangle {
    let direction = vector(&format!("direction {name}"));
    given(less(&Real::zero(), &direction.x));
    given(at_most(&Real::zero(), &direction.y));
    sized(name, Frame { origin: vector(name), direction })
}

/// Assumes that a point of a is one of b moved by `moved`.
fn given_shared(a: &Rectangle, b: &Rectangle, moved: &Vector) {
    given(same(&point_of("a", a), &(&point_of("b", b) + moved)));
}

fn swept_over_is_found(least: &Real) -> Formula {
    let ([a, b], w, t) = (both_along_x(), ahead_and_left(), Real::variable("t"));
    given(at_most(least, &t));
    given(shared_along_x(&a, &b, &w.scaled(&t)));
    Formula::from(is_swept_over(&a, &b, &w))
}

fn swept_over_between_is_found(later: &Real) -> Formula {
    let (a, b, w) = (at_home("a"), turned_left("b"), vector("w"));
    let [t1, t, t2] = ["t1", "t", "t2"].map(Real::variable);
    given(at_most(&t1, &t));
    given(at_most(&t, &(&t2 + later)));
    given(at_most(&t1, &t2));
    given_shared(&a, &b, &w.scaled(&t));
    Formula::from(between(&a, &b, &w, [&t1, &t2]))
}

/// b moved by w t for some t between two.
fn between(a: &Rectangle, b: &Rectangle, w: &Vector, times: [&Real; 2]) -> bool {
    is_swept_over_between(a, b, w, &times.map(|t| w.scaled(t)))
}

/// b moved by 0 to w.
fn until_1(a: &Rectangle, b: &Rectangle, w: &Vector) -> bool {
    between(a, b, w, [&Real::zero(), &Real::from_integer(1)])
}

type Test = fn(&Rectangle, &Rectangle, &Vector) -> bool;

/// What the test finds shares a point at the time `at`, or at one from 0 to `end` at which a side of b
/// comes to one of a.
fn shares_a_point(test: Test, at: i128, end: Option<i128>) -> Formula {
    let ([a, b], w) = (both_along_x(), ahead_and_left());
    if !test(&a, &b, &w) {
        return Formula::Known(true);
    }
    let [(x, most_x), (y, most_y)] = sides(&a, &b);
    let comes = [-(most_x + x) / &w.x, -(most_y + y) / &w.y];
    let is_shared = |t: &Real| {
        let end = end.map(|end| at_most(t, &Real::from_integer(end)));
        let shared = shared_along_x(&a, &b, &w.scaled(t));
        Formula::All([shared, at_most(&Real::zero(), t)].into_iter().chain(end).collect())
    };
    Formula::Any([&Real::from_integer(at), &comes[0], &comes[1]].map(is_shared).into())
}

fn stands(speed: &Real) -> Formula {
    let (a, b) = (at_home("a"), turned_left("b"));
    let w = Vector { x: speed.clone(), y: Real::zero() };
    let shares = share_a_point(&a, &b);
    Formula::from(is_swept_over(&a, &b, &w) == shares && until_1(&a, &b, &w) == shares)
}
