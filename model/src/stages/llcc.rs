//! The low-level collision check: paper Sec. IV-D, its two steps
//! (`spec/3-stages.md#low-level-collision-check-llcc`, H-03).

use crate::hardened::h03_circumradii;
use crate::input::profile::Profile;
use crate::input::scene::{Object, Point, Scene};
use crate::numbers::real::Real;
use crate::numbers::rectangle::{Rectangle, may_share_a_point};
use crate::numbers::vector::Frame;
use crate::report::{Rule, Witness};

/// A collision: the distance of the centres and the limit that made the object examined, m.
#[derive(Debug)]
pub struct Collision {
    /// Distance of the centres, m.
    pub distance: Real,
    /// theta_obj, or the sum of the circumradii where that is larger (H-03), m.
    pub limit: Real,
}

/// LLCC of the CAV at a trajectory point with an object: an object whose centre is closer than
/// theta_obj is examined; it is a collision when the rectangles share a point.
pub fn llcc(scene: &Scene, point: &Point, object: &Object) -> Option<Collision> {
    let centre = centre(scene, point);
    let distance = object.frame.origin.distance(&centre.origin);
    let theta_obj = &scene.parameters.theta_obj;
    let (examined, limit) = match scene.profile {
        Profile::Paper => (scene.reads.may_be_less(&distance, theta_obj), theta_obj.clone()),
        Profile::Hardened => h03_circumradii::is_examined(scene, &distance, object),
    };
    let cav = || Rectangle::new(centre, &scene.ego.length, &scene.ego.width);
    let collides = examined && may_share_a_point(&scene.reads, &cav(), &object.rectangle());
    collides.then_some(Collision { distance, limit })
}

/// The first collision in the order of the points, then of the list: the index of the item, and the
/// witness at the point. `object`: what the item is when the CAV is at the point.
pub fn first_collision<T>(
    scene: &Scene,
    rule: Rule,
    points: impl Iterator<Item = Point>,
    items: &[T],
    object: impl Fn(&Point, &T) -> Object,
) -> Option<(usize, Witness)> {
    points.enumerate().find_map(|(i, point)| {
        items.iter().enumerate().find_map(|(j, item)| {
            let Collision { distance, limit } = llcc(scene, &point, &object(&point, item))?;
            Some((j, Witness::new(rule, &distance, &limit).at_point(i)))
        })
    })
}

/// The centre of the CAV's rectangle at a trajectory point: the pose shifted forward.
pub fn centre(scene: &Scene, point: &Point) -> Frame {
    Frame {
        origin: point.pose.point(&scene.ego.center_offset, &Real::zero()),
        direction: point.pose.direction.clone(),
    }
}
