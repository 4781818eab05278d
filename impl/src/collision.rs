//! The low-level collision check (`spec/3-stages.md#low-level-collision-check-llcc`) and the
//! trajectory points that stages iii to v examine.

use crate::cycle::{Cycle, Ego, Profile, TrajectoryPoint};
use crate::distance::s_stop;
use crate::plane::{Vector, distance};
use crate::rectangle::{Rectangle, possibly_touch};
use crate::rounding::Real;

/// The CAV's rectangle at a trajectory point: shifted forward by `center_offset`.
pub(crate) fn footprint(ego: &Ego, point: &TrajectoryPoint) -> Rectangle {
    let direction = Vector::new(point.cos, point.sin);
    let shift = direction.times(Real::new(ego.center_offset));
    let centre = Vector::new(point.x, point.y) + shift;
    Rectangle { centre, direction, length: ego.length, width: ego.width }
}

/// How many of the points may have an arc length <= s; H-04: <= max(s, `s_stop`), and one more.
pub(crate) fn examined(cycle: &Cycle<'_>, points: &[TrajectoryPoint], s: Real) -> usize {
    match cycle.profile {
        Profile::Paper => within(points, s),
        Profile::Hardened => {
            let s = s.max(s_stop(&cycle.parameters, cycle.ego.speed));
            within(points, s).saturating_add(1).min(points.len())
        }
    }
}

/// Whether the check may find a collision: the distance of the centres and the limit below which
/// (H-03: up to which) the object is examined.
pub(crate) fn collision(
    cycle: &Cycle<'_>,
    cav: &Rectangle,
    object: &Rectangle,
) -> Option<[f64; 2]> {
    let theta_obj = cycle.parameters.theta_obj;
    if certainly_far(theta_obj, cav, object) {
        return None;
    }
    let apart = (object.centre - cav.centre).norm();
    let theta_obj = Real::new(theta_obj);
    let (limit, examined) = match cycle.profile {
        Profile::Paper => (theta_obj, apart.possibly_below(theta_obj)),
        Profile::Hardened => {
            let limit = theta_obj.max(cav.circumradius() + object.circumradius());
            (limit, apart.possibly_at_most(limit))
        }
    };
    (examined && possibly_touch(cav, object)).then(|| [apart.value(), limit.value()])
}

/// Points form a prefix, since arc lengths do not decrease; the first point always counts.
fn within(points: &[TrajectoryPoint], s: Real) -> usize {
    let mut arc = Real::ZERO;
    let mut count = 1_usize;
    for (a, b) in points.iter().zip(points.iter().skip(1)) {
        arc = arc + distance([a.x, a.y], [b.x, b.y]);
        if !arc.possibly_at_most(s) {
            break;
        }
        count = count.saturating_add(1);
    }
    count.min(points.len())
}

/// Plain doubles err by less than 1e-6 m here; 1 m covers that and the factor of the circumradii.
fn certainly_far(theta_obj: f64, cav: &Rectangle, object: &Rectangle) -> bool {
    let limit = theta_obj + cav.length + cav.width + object.length + object.width + 1.0;
    let far = |a: Real, b: Real| {
        let apart = a.value() - b.value();
        apart > limit || apart < -limit
    };
    far(cav.centre.x, object.centre.x) || far(cav.centre.y, object.centre.y)
}
