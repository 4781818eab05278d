//! The low-level collision check (`spec/3-stages.md#low-level-collision-check-llcc`).

use crate::input::profile::Profile;
use crate::input::scene::{Object, Point, Scene};
use crate::numbers::real::Real;
use crate::numbers::rectangle::{Rectangle, share_a_point};
use crate::numbers::vector::Frame;

/// A collision: the distance of the centres and the limit that made the object examined, m.
#[derive(Debug)]
pub struct Collision {
    /// Distance of the centres, m.
    pub distance: Real,
    /// theta_obj, or the sum of the circumradii where that is larger (H-03), m.
    pub limit: Real,
}

/// The centre of the CAV's rectangle at a trajectory point: the pose shifted forward.
pub fn centre(scene: &Scene, point: &Point) -> Frame {
    Frame {
        origin: point.pose.point(&scene.ego.center_offset, &Real::zero()),
        direction: point.pose.direction.clone(),
    }
}

/// LLCC of the CAV at a trajectory point with an object. An object is examined when its centre is
/// closer than theta_obj; hardened (H-03): or not farther than the circumradii together. An
/// examined object is a collision when the rectangles share a point.
pub fn llcc(scene: &Scene, point: &Point, object: &Object) -> Option<Collision> {
    let centre = centre(scene, point);
    let theta_obj = &scene.parameters.theta_obj;
    let distance = (&object.frame.origin - &centre.origin).length();
    let (examined, limit) = match scene.profile {
        Profile::Paper => (distance < theta_obj + &scene.m, theta_obj.clone()),
        Profile::Hardened => {
            let reach = circumradius(&scene.ego.length, &scene.ego.width)
                + circumradius(&object.length, &object.width);
            let limit = theta_obj.max(&reach).clone();
            (distance <= &limit + &scene.m, limit)
        }
    };
    let collides = examined && share_a_point(&footprint(scene, centre), &rectangle(object));
    collides.then_some(Collision { distance, limit })
}

/// H-03: half the diagonal times (1 + 1e-6), because directions need not be exactly of length 1, m.
pub fn circumradius(length: &Real, width: &Real) -> Real {
    let diagonal = (length.square() + width.square()).sqrt();
    diagonal / Real::from_integer(2) * (Real::from_integer(1) + Real::from_double(1e-6))
}

fn footprint(scene: &Scene, centre: Frame) -> Rectangle {
    let two = Real::from_integer(2);
    Rectangle {
        frame: centre,
        half_length: &scene.ego.length / &two + &scene.m,
        half_width: &scene.ego.width / &two + &scene.m,
    }
}

fn rectangle(object: &Object) -> Rectangle {
    let two = Real::from_integer(2);
    Rectangle {
        frame: object.frame.clone(),
        half_length: &object.length / &two,
        half_width: &object.width / &two,
    }
}
