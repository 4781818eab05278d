//! H-03: LLCC examines an object whose circumscribed circle may reach that of the CAV.

use crate::input::scene::{Object, Scene};
use crate::numbers::real::Real;

/// Whether an object with this distance to the CAV's centre is examined: at most the limit
/// max(theta_obj, circumradius of the CAV + circumradius of the object), m.
pub fn is_examined(scene: &Scene, distance: &Real, object: &Object) -> (bool, Real) {
    let reach = circumradius(&scene.ego.length, &scene.ego.width)
        + circumradius(&object.length, &object.width);
    let limit = scene.parameters.theta_obj.clone().max(reach);
    (scene.reads.may_be_at_most(distance, &limit), limit)
}

/// Half the diagonal times (1 + 1e-6), because directions need not be exactly of length 1, m.
pub fn circumradius(length: &Real, width: &Real) -> Real {
    let diagonal = (length.square() + width.square()).sqrt();
    diagonal / Real::from_integer(2) * (Real::from_integer(1) + Real::from_double(1e-6))
}
