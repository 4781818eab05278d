//! The low-level collision check: paper Sec. IV-D, its two steps
//! (`spec/3-stages.md#low-level-collision-check-llcc`).

use crate::input::scene::{Object, Point, Scene};
use crate::numbers::real::Real;
use crate::numbers::rectangle::{Rectangle, may_share_a_point};
use crate::numbers::vector::Frame;
use crate::report::{Rule, Witness};

/// LLCC of the CAV at a pose with an object: an object whose centre is closer than theta_obj is examined;
/// it is a collision when the rectangles share a point. Of a collision the distance of the centres, m.
pub fn llcc(scene: &Scene, pose: &Frame, object: &Object) -> Option<Real> {
    let cav = cav(scene, pose);
    let distance = object.frame.origin.distance(&cav.frame.origin);
    let examined = scene.reads.may_be_less(&distance, &scene.parameters.theta_obj);
    let collides = examined && may_share_a_point(&scene.reads, &cav, &object.rectangle());
    collides.then_some(distance)
}

/// The first collision in the order of the points, then of the list: the index of the item, and the
/// witness at the point. `object`: what the item is when the CAV is at the point.
pub fn first_collision<T>(
    scene: &Scene,
    points: &[Point],
    items: &[T],
    object: impl Fn(&Point, &T) -> Object,
) -> Option<(usize, Witness)> {
    let theta_obj = &scene.parameters.theta_obj;
    points.iter().enumerate().find_map(|(i, point)| {
        items.iter().enumerate().find_map(|(j, item)| {
            let distance = llcc(scene, &point.pose, &object(point, item))?;
            Some((j, Witness::new(Rule::Collision, &distance, theta_obj).at_point(i)))
        })
    })
}

/// The rectangle of the CAV at a pose: its length and width around the pose shifted forward.
pub fn cav(scene: &Scene, pose: &Frame) -> Rectangle {
    let ego = &scene.ego;
    let origin = pose.point(&ego.center_offset, &Real::zero());
    Rectangle::new(Frame { origin, direction: pose.direction.clone() }, &ego.length, &ego.width)
}
