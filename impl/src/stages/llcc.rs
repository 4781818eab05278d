//! The low-level collision check (`spec/3-stages.md#low-level-collision-check-llcc`).

pub(crate) mod sweep;

use crate::input::cycle::{Cycle, Ego, TrajectoryPoint};
use crate::numbers::plane::Vector;
use crate::numbers::rectangle::Rectangle;
use crate::numbers::rounding::Real;
use crate::numbers::time::{elapsed_ns, seconds};
use crate::stages::llcc::sweep::{MovingRectangle, SLACK, Sweep, minus};

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
    /// only at the points before that of the first collision so far.
    pub(crate) fn first_collision(
        &self,
        objects: impl Iterator<Item = MovingRectangle>,
    ) -> Option<Collision> {
        let mut found: Option<Collision> = None;
        for (object, moving) in objects.enumerate() {
            if self.sweep.misses(&moving) {
                continue;
            }
            let before = found.map_or(usize::MAX, |found| found.point);
            let hit = self.collision_with(&moving, before);
            found = hit.map(|(point, compared)| Collision { point, object, compared }).or(found);
        }
        found
    }

    /// The first point with an index below `before` at which the check may find a collision.
    #[inline(never)]
    fn collision_with(&self, object: &MovingRectangle, before: usize) -> Option<(usize, [f64; 2])> {
        let mut points = self.points.iter().enumerate().take(before);
        points.find_map(|(index, at)| Some((index, self.collision(at, object)?)))
    }

    /// Whether the check may find a collision at a point.
    ///
    /// All counts from the point, so that differences alone are rounded. Where the centres are within
    /// 2000 m, twice the greatest `theta_obj`, no number is above 2^16 m: an object moves by at most 18,000 m
    /// along x and y (150 m/s for 120 s), and all sizes together are less than 500 m. Each comparison rounds
    /// less than 32 times, so that it errs by less than 32 * 2^-53 * 2^16 m, a sixteenth of `SLACK`. Centres
    /// farther apart err by less than 2^-47 of that, and neither rectangle reaches beyond 150 m.
    fn collision(&self, at: &TrajectoryPoint, object: &MovingRectangle) -> Option<[f64; 2]> {
        let (ego, theta_obj) = (&self.cycle.ego, self.cycle.parameters.theta_obj);
        // S3-01: below 0 at a point that is earlier than the list
        let seconds = seconds(elapsed_ns(self.stamp_ns, at.t_ns));
        let cav = MovingRectangle::cav(ego, [at.cos, at.sin]);
        let between = minus(object.seen_from([at.x, at.y]).after(seconds), cav.centre);
        let ([x, y], limit) = (between, theta_obj + SLACK);
        let squared = x * x + y * y;
        // LLCC-01, LLCC-02; what touches is not apart: I-03
        if squared > limit * limit || cav.is_apart(object, between, SLACK) {
            return None;
        }
        Some([libm::sqrt(squared), theta_obj])
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
    //
    let direction = vector(pose.heading);
    let centre = pose.at + direction.times(Real::new(ego.center_offset));
    Rectangle { centre, direction, length: ego.length, width: ego.width }
}
