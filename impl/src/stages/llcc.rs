//! The low-level collision check (`spec/3-stages.md#low-level-collision-check-llcc`).

pub(crate) mod sweep;

use crate::hardened::h03_circumradii::examined_up_to;
use crate::input::cycle::{Cycle, Ego, TrajectoryPoint};
use crate::input::profile::Profile;
use crate::numbers::plane::Vector;
use crate::numbers::rectangle::{Rectangle, possibly_touch};
use crate::numbers::rounding::Real;
use crate::numbers::time::{elapsed_ns, seconds};
use crate::stages::llcc::sweep::{MovingRectangle, Sweep};

/// A collision: the point, the object, both as indices, and the distance of the centres with the
/// limit below which (H-03: up to which) the object is examined.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Collision {
    pub(crate) point: usize,
    pub(crate) object: usize,
    pub(crate) compared: [f64; 2],
}

/// The CAV at the points that are examined, with the time from which objects are moved on.
pub(crate) struct CavMotion<'c, 'a> {
    cycle: &'c Cycle<'a>,
    points: &'c [TrajectoryPoint],
    stamp_ns: i64,
    sweep: Sweep,
}

impl<'c, 'a> CavMotion<'c, 'a> {
    pub(crate) fn new(cycle: &'c Cycle<'a>, points: &'c [TrajectoryPoint], stamp_ns: i64) -> Self {
        let time = |point: Option<&TrajectoryPoint>| {
            point.map_or(0.0, |point| seconds(elapsed_ns(stamp_ns, point.t_ns)))
        };
        let times = [time(points.first()), time(points.last())];
        Self { cycle, points, stamp_ns, sweep: Sweep::new(&cycle.ego, points, times) }
    }

    /// The first collision in the order of points, then objects. Object after object, looking
    /// only at the points before that of the first collision so far.
    pub(crate) fn first_collision(
        &self,
        objects: impl Iterator<Item = MovingRectangle>,
        counts: impl Fn(usize) -> bool,
    ) -> Option<Collision> {
        let mut points = self.points;
        let mut found = None;
        for (object, moving) in objects.enumerate() {
            if self.sweep.misses(&moving) || !counts(object) {
                continue;
            }
            let hit = points.iter().enumerate().find_map(|(point, at)| {
                let compared = self.collision(at, &moving)?;
                Some(Collision { point, object, compared })
            });
            if let Some(hit) = hit {
                points = points.get(..hit.point).unwrap_or_default();
                found = Some(hit);
            }
        }
        found
    }

    /// Whether the check may find a collision at a point.
    fn collision(&self, at: &TrajectoryPoint, object: &MovingRectangle) -> Option<[f64; 2]> {
        let ego = &self.cycle.ego;
        let dt_ns = elapsed_ns(self.stamp_ns, at.t_ns);
        let cav = MovingRectangle::footprint(ego, at);
        let theta_obj = self.cycle.parameters.theta_obj;
        let published = self.cycle.profile == Profile::Paper;
        if cav.certainly_apart(object, seconds(dt_ns))
            || published && cav.certainly_far(object, seconds(dt_ns), theta_obj)
        {
            return None;
        }
        let (cav, object) = (footprint(ego, at), moved(object, Real::seconds(dt_ns)));
        let apart = (object.centre - cav.centre).norm();
        let theta_obj = Real::new(theta_obj);
        let (limit, examined) = match self.cycle.profile {
            Profile::Paper => (theta_obj, apart.possibly_below(theta_obj)),
            Profile::Hardened => {
                let limit = examined_up_to(theta_obj, &cav, &object);
                (limit, apart.possibly_at_most(limit))
            }
        };
        (examined && possibly_touch(&cav, &object)).then(|| [apart.value(), limit.value()])
    }
}

/// The CAV's rectangle at a trajectory point: shifted forward by `center_offset`.
fn footprint(ego: &Ego, point: &TrajectoryPoint) -> Rectangle {
    let direction = Vector::new(point.cos, point.sin);
    let shift = direction.times(Real::new(ego.center_offset));
    let centre = Vector::new(point.x, point.y) + shift;
    Rectangle { centre, direction, length: ego.length, width: ego.width }
}

/// The rectangle of an object after `dt` seconds with unchanged velocity and direction.
fn moved(object: &MovingRectangle, dt: Real) -> Rectangle {
    let vector = |[x, y]: [f64; 2]| Vector::new(x, y);
    let [length, width] = object.size;
    let centre = vector(object.centre) + vector(object.velocity).times(dt);
    Rectangle { centre, direction: vector(object.direction), length, width }
}
