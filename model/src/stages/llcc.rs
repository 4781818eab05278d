//! The low-level collision check: paper Sec. IV-D, its two steps
//! (`spec/3-stages.md#low-level-collision-check-llcc`).

use crate::input::scene::{Object, Point, Scene};
use crate::numbers::reading::{Comparisons, Reading};
use crate::numbers::real::Real;
use crate::numbers::rectangle::{Rectangle, may_share_a_point};
use crate::numbers::vector::Frame;
use crate::report::{Rule, Witness};

/// What is so near that plain doubles may not decide it (LLCC-03, H-14.54), m.
const ONE_CM: f64 = 0.01;
/// So many decisions with more than plain doubles are in time (MARGIN-14, MARGIN-15).
const MOST_CLOSE: i128 = 1024;

/// LLCC of the CAV at a pose with an object: an object whose centre is closer than theta_obj is examined;
/// it is a collision when the rectangles share a point. Of a collision the distance of the centres, m.
pub fn llcc(scene: &Scene, reads: &Comparisons, pose: &Frame, object: &Object) -> Option<Real> {
    let cav = cav(scene, pose);
    let distance = object.frame.origin.distance(&cav.frame.origin);
    let examined = reads.may_be_less(&distance, &scene.parameters.theta_obj);
    let collides = examined && may_share_a_point(reads, &cav, &object.rectangle());
    collides.then_some(distance)
}

/// The first collision in the order of the points, then of the list: the index of the item, and the
/// witness at the point. Without one, strictly: too many points and items that are close, and no index.
/// `object`: what the item is when the CAV is at the point.
pub fn first_collision<T>(
    scene: &Scene,
    points: &[Point],
    items: &[T],
    object: impl Fn(&Point, &T) -> Object,
) -> Option<(Option<usize>, Witness)> {
    let theta_obj = &scene.parameters.theta_obj;
    let [_, close] = by_one_cm();
    let mut count = 0;
    let collision = points.iter().enumerate().find_map(|(i, point)| {
        items.iter().enumerate().find_map(|(j, item)| {
            let object = object(point, item);
            // No margin is above 1 cm, so strictly what is not close is no collision.
            if scene.reads.is_strict() {
                llcc(scene, &close, &point.pose, &object)?;
                count += 1;
            }
            let distance = llcc(scene, &scene.reads, &point.pose, &object)?;
            Some((Some(j), Witness::new(Rule::Collision, &distance, theta_obj).at_point(i)))
        })
    });
    collision.or_else(|| Some((None, too_many_close(&scene.reads, count)?)))
}

/// The lax and the strict reading with a margin of 1 cm.
pub fn by_one_cm() -> [Comparisons; 2] {
    [Reading::Lax, Reading::Strict]
        .map(|reading| Comparisons::new(reading, Real::from_double(ONE_CM)))
}

/// An implementation may fail the stage instead of deciding more of what is close.
pub fn too_many_close(reads: &Comparisons, count: i128) -> Option<Witness> {
    let [close, most] = [count, MOST_CLOSE].map(Real::from_integer);
    Witness::unless(!reads.refuses(count, MOST_CLOSE), Rule::WorkLimit, &close, &most)
}

/// The rectangle of the CAV at a pose: its length and width around the pose shifted forward.
pub fn cav(scene: &Scene, pose: &Frame) -> Rectangle {
    let ego = &scene.ego;
    let origin = pose.point(&ego.center_offset, &Real::zero());
    Rectangle::new(Frame { origin, direction: pose.direction.clone() }, &ego.length, &ego.width)
}
