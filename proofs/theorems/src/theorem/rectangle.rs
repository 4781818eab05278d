//! Two closed rectangles and the separating-axis test
//! (`spec/3-stages.md#low-level-collision-check-llcc`). Directions are any vectors but 0: used as
//! given, they scale the rectangle.

use crate::numbers::real::Real;
use crate::numbers::real::formula::{Formula, at_most, given, less, same};
use crate::numbers::rectangle::{Rectangle, share_a_point};
use crate::numbers::vector::{Frame, Vector};
use crate::theorem::{Theorem, Wrong};

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
