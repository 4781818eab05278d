//! The low-level collision check (`spec/3-stages.md#low-level-collision-check-llcc`).

pub(crate) mod close;
pub(crate) mod sweep;

use crate::input::cycle::{Cycle, Ego, TrajectoryPoint};
use crate::numbers::plane::Vector;
use crate::numbers::rectangle::{Rectangle, possibly_touch};
use crate::numbers::rounding::Real;
use crate::numbers::time::{elapsed_ns, seconds};
use crate::stages::llcc::close::{ClosePairs, TooMany};
use crate::stages::llcc::sweep::{MovingRectangle, Sweep};

/// A collision: the point, the object, both as indices, and the distance of the centres with the
/// limit below which the object is examined.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Collision {
    pub(crate) point: usize,
    pub(crate) object: usize,
    pub(crate) compared: [f64; 2],
}

impl MovingRectangle {
    /// The rectangle, moved with unchanged direction.
    pub(crate) fn displaced(&self, by: Vector) -> Rectangle {
        let [length, width] = self.size;
        let centre = vector(self.centre) + by;
        Rectangle { centre, direction: vector(self.direction), length, width }
    }
}

pub(crate) const fn vector([x, y]: [f64; 2]) -> Vector {
    Vector::new(x, y)
}

/// The CAV at the points that are examined, with the time from which objects are moved on.
pub(crate) struct CavMotion<'c, 'a> {
    cycle: &'c Cycle<'a>,
    points: &'c [TrajectoryPoint],
    stamp_ns: i64,
    sweep: Sweep,
}

impl<'c, 'a> CavMotion<'c, 'a> {
    /// Objects move from this time on.
    pub(crate) fn new(cycle: &'c Cycle<'a>, points: &'c [TrajectoryPoint], stamp_ns: i64) -> Self {
        let time = |point: Option<&TrajectoryPoint>| {
            point.map_or(0.0, |point| seconds(elapsed_ns(stamp_ns, point.t_ns)))
        };
        let times = [time(points.first()), time(points.last())];
        Self { cycle, points, stamp_ns, sweep: Sweep::new(&cycle.ego, points, times) }
    }

    /// The first collision in the order of points, then objects. Object after object, looking
    /// only at the points before that of the first collision so far, and at none once too many pairs are
    /// close.
    pub(crate) fn first_collision(
        &self,
        objects: impl Iterator<Item = MovingRectangle>,
        close: &mut ClosePairs,
    ) -> Option<Collision> {
        let mut found: Option<Collision> = None;
        for (object, moving) in objects.enumerate() {
            if self.sweep.misses(&moving) {
                continue;
            }
            let before = found.map_or(usize::MAX, |found| found.point);
            let hit = self.collision_with(&moving, before, close);
            found = hit.map(|(point, compared)| Collision { point, object, compared }).or(found);
        }
        found
    }

    /// The first point with an index below `before` at which the check may find a collision.
    #[inline(never)]
    fn collision_with(
        &self,
        object: &MovingRectangle,
        before: usize,
        close: &mut ClosePairs,
    ) -> Option<(usize, [f64; 2])> {
        let before = if close.are_too_many() { 0 } else { before };
        let mut points = self.points.iter().enumerate().take(before);
        let hit = points.find_map(|(index, at)| {
            let found = self.collision(at, object, close).transpose()?;
            Some(found.ok().map(|compared| (index, compared)))
        });
        hit.flatten()
    }

    /// Whether the check may find a collision at a point.
    ///
    /// What plain doubles leave open is close (LLCC-03): they take half the lengths for longer by a
    /// millionth, for directions that are too short or too long, and round, by less than a millimetre
    /// together; a centimetre more of the CAV's halves is as much along each side.
    fn collision(
        &self,
        at: &TrajectoryPoint,
        object: &MovingRectangle,
        close: &mut ClosePairs,
    ) -> Result<Option<[f64; 2]>, TooMany> {
        let (seconds, ego) = (seconds(elapsed_ns(self.stamp_ns, at.t_ns)), &self.cycle.ego);
        let cav = MovingRectangle::footprint(ego, at);
        if cav.certainly_apart(object, seconds)
            || cav.certainly_far(object, seconds, self.cycle.parameters.theta_obj)
        {
            return Ok(None);
        }
        close.decide(self.close_collision(at, object))
    }

    /// The same with error bounds.
    #[inline(never)]
    fn close_collision(&self, at: &TrajectoryPoint, object: &MovingRectangle) -> Option<[f64; 2]> {
        let cav = footprint(&self.cycle.ego, &Pose::of(at));
        let seconds = Real::seconds(elapsed_ns(self.stamp_ns, at.t_ns));
        let object = object.displaced(vector(object.velocity).times(seconds));
        let theta_obj = Real::new(self.cycle.parameters.theta_obj);
        let apart = (object.centre - cav.centre).norm();
        let collides = apart.possibly_below(theta_obj) && possibly_touch(&cav, &object);
        collides.then(|| [apart.value(), theta_obj.value()])
    }
}

/// Where the CAV's reference point may be, and its direction.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pose {
    pub(crate) at: Vector,
    pub(crate) heading: [f64; 2],
}

impl Pose {
    pub(crate) const fn of(point: &TrajectoryPoint) -> Self {
        Self { at: Vector::new(point.x, point.y), heading: [point.cos, point.sin] }
    }

    /// Of the CAV now.
    pub(crate) const fn of_cav(ego: &Ego) -> Self {
        Self { at: Vector::new(ego.x, ego.y), heading: [ego.cos, ego.sin] }
    }

    /// The same in plain doubles, at no time.
    pub(crate) fn plainly(&self) -> TrajectoryPoint {
        let ([x, y], [cos, sin]) = ([self.at.x, self.at.y].map(Real::value), self.heading);
        TrajectoryPoint { t_ns: 0, x, y, cos, sin }
    }
}

/// The CAV's rectangle at a pose: shifted forward by `center_offset`.
pub(crate) fn footprint(ego: &Ego, pose: &Pose) -> Rectangle {
    let direction = vector(pose.heading);
    let centre = pose.at + direction.times(Real::new(ego.center_offset));
    Rectangle { centre, direction, length: ego.length, width: ego.width }
}
