//! What is known only up to a bound.

use super::{Rectangle, certainly_touch, possibly_touch};
use crate::numbers::plane::Vector;
use crate::numbers::rounding::Real;

/// Squares of 2 m whose centres are so far apart along x, known up to 1 mm.
fn touch(apart: f64) -> [bool; 2] {
    let square = |x| Rectangle {
        centre: Vector { x, y: Real::ZERO },
        direction: Vector::new(1.0, 0.0),
        length: 2.0,
        width: 2.0,
    };
    let (a, b) = (square(Real::ZERO), square(Real::new(apart).widened(1e-3)));
    [possibly_touch(&a, &b), certainly_touch(&b, &a)]
}

#[test]
fn what_certainly_touches_does_so_wherever_it_is() {
    assert_eq!(touch(1.998), [true, true]);
    assert_eq!(touch(1.9995), [true, false]);
    assert_eq!(touch(2.0005), [true, false]);
    assert_eq!(touch(2.002), [false, false]);
    assert_eq!(touch(f64::NAN), [true, false]);
}
