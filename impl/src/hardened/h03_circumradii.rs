//! Which objects the low-level collision check examines (H-03 of
//! `spec/3-stages.md#hardened-profile`).

use crate::numbers::rectangle::Rectangle;
use crate::numbers::rounding::Real;

/// The distance of the centres up to which an object is examined, m: max(`theta_obj`, both
/// circumradii).
pub(crate) fn examined_up_to(theta_obj: Real, cav: &Rectangle, object: &Rectangle) -> Real {
    theta_obj.max(circumradius(cav) + circumradius(object))
}

/// Half the diagonal times (1 + 1e-6), m.
fn circumradius(rectangle: &Rectangle) -> Real {
    let (length, width) = (Real::new(rectangle.length), Real::new(rectangle.width));
    let diagonal = (length.squared() + width.squared()).sqrt();
    diagonal * Real::new(0.5) * (Real::ONE + Real::new(1e-6))
}
