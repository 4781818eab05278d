//! The low-level collision check (`spec/3-stages.md#low-level-collision-check-llcc`).

pub(crate) mod pursuit;
mod strip;
pub(crate) mod sweep;

use crate::hardened::h03_circumradii::examined_up_to;
use crate::hardened::h04_horizon::PlacesBeyond;
use crate::input::cycle::{Cycle, Ego, TrajectoryPoint};
use crate::input::profile::Profile;
use crate::numbers::plane::Vector;
use crate::numbers::rectangle::{Rectangle, possibly_touch};
use crate::numbers::rounding::Real;
use crate::numbers::time::{elapsed_ns, seconds};
use crate::stages::horizon::PointsExamined;
use crate::stages::llcc::pursuit::Pursuit;
use crate::stages::llcc::sweep::{MovingRectangle, Sweep};

/// A collision: the point, the object, both as indices, and the distance of the centres with the
/// limit below which (H-03: up to which) the object is examined.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Collision {
    pub(crate) point: usize,
    pub(crate) object: usize,
    pub(crate) compared: [f64; 2],
}

/// What an object is to the check: a rectangle that moves from a time on.
pub(crate) trait Moving {
    /// In plain doubles.
    fn plainly(&self) -> &MovingRectangle;

    /// The rectangle after so many ns.
    fn exactly(&self, dt_ns: i64) -> Rectangle;
}

impl Moving for MovingRectangle {
    fn plainly(&self) -> &MovingRectangle {
        self
    }

    fn exactly(&self, dt_ns: i64) -> Rectangle {
        self.displaced(vector(self.velocity).times(Real::seconds(dt_ns)))
    }
}

impl MovingRectangle {
    /// The rectangle, moved with unchanged direction.
    pub(crate) fn displaced(&self, by: Vector) -> Rectangle {
        let [length, width] = self.size;
        let centre = vector(self.centre) + by;
        Rectangle { centre, direction: vector(self.direction), length, width }
    }
}

const fn vector([x, y]: [f64; 2]) -> Vector {
    Vector::new(x, y)
}

/// For how long objects have moved when the CAV is at a point.
#[derive(Clone, Copy, Debug)]
enum Clock {
    /// Since this time.
    Since(i64),
    /// For so many ns, whatever the point.
    Still(i64),
}

impl Clock {
    fn elapsed_ns(self, at: &TrajectoryPoint) -> i64 {
        match self {
            Self::Since(stamp_ns) => elapsed_ns(stamp_ns, at.t_ns),
            Self::Still(dt_ns) => dt_ns,
        }
    }
}

/// The CAV at the points that are examined, with the time from which objects are moved on.
pub(crate) struct CavMotion<'c, 'a> {
    cycle: &'c Cycle<'a>,
    points: &'c [TrajectoryPoint],
    /// Further places at the last point.
    beyond: &'c PlacesBeyond,
    clock: Clock,
    pub(crate) sweep: Sweep,
}

impl<'c, 'a> CavMotion<'c, 'a> {
    /// Objects move from this time on.
    pub(crate) fn new(cycle: &'c Cycle<'a>, points: &'c [TrajectoryPoint], stamp_ns: i64) -> Self {
        Self::timed(cycle, points, &PlacesBeyond::NONE, Clock::Since(stamp_ns))
    }

    /// As `new`, with the places beyond the end, which count as points behind the last.
    pub(crate) fn with_beyond(examined: &'c PointsExamined<'c, 'a>, stamp_ns: i64) -> Self {
        let PointsExamined { cycle, points, beyond } = examined;
        Self::timed(cycle, points, beyond, Clock::Since(stamp_ns))
    }

    /// As `new`, where no object is asked whether it misses the sweep.
    pub(crate) const fn unswept(
        cycle: &'c Cycle<'a>,
        points: &'c [TrajectoryPoint],
        stamp_ns: i64,
    ) -> Self {
        let (beyond, clock) = (&PlacesBeyond::NONE, Clock::Since(stamp_ns));
        Self { cycle, points, beyond, clock, sweep: Sweep::EVERYWHERE }
    }

    /// Objects stand still where they are after so many ns.
    pub(crate) fn among_standing(
        cycle: &'c Cycle<'a>,
        points: &'c [TrajectoryPoint],
        dt_ns: i64,
    ) -> Self {
        Self::timed(cycle, points, &PlacesBeyond::NONE, Clock::Still(dt_ns))
    }

    fn timed(
        cycle: &'c Cycle<'a>,
        points: &'c [TrajectoryPoint],
        beyond: &'c PlacesBeyond,
        clock: Clock,
    ) -> Self {
        let time = |point: Option<&TrajectoryPoint>| {
            point.map_or(0.0, |point| seconds(clock.elapsed_ns(point)))
        };
        let times = [time(points.first()), time(points.last())];
        let sweep = Sweep::new(poses(cycle, points, beyond), times);
        Self { cycle, points, beyond, clock, sweep }
    }

    /// The first collision in the order of points, then objects. Object after object, looking
    /// only at the points before that of the first collision so far. `up_to`: at how many of the
    /// points an object is examined, by its index.
    pub(crate) fn first_collision(
        &self,
        objects: impl Iterator<Item = impl Moving>,
        up_to: impl Fn(usize) -> usize,
    ) -> Option<Collision> {
        let mut found: Option<Collision> = None;
        for (object, moving) in objects.enumerate() {
            if self.sweep.misses(moving.plainly()) {
                continue;
            }
            let before = found.map_or(usize::MAX, |found| found.point).min(up_to(object));
            let hit = self.collision_with(&moving, before);
            found = hit.map(|(point, compared)| Collision { point, object, compared }).or(found);
        }
        found
    }

    /// The CAV as seen by someone who moves along with it.
    pub(crate) fn pursuit(&self) -> Pursuit {
        let poses = poses(self.cycle, self.points, self.beyond);
        Pursuit::new(poses.map(|(ego, at)| (ego, at, seconds(self.clock.elapsed_ns(at)))))
    }

    /// The first point with an index below `before` at which the check may find a collision.
    fn collision_with(&self, object: &impl Moving, before: usize) -> Option<(usize, [f64; 2])> {
        let poses = poses(self.cycle, self.points, self.beyond).enumerate().take(before);
        poses
            .into_iter()
            .find_map(|(point, (ego, at))| Some((point, self.collision(&ego, at, object)?)))
    }

    /// The same for an object that touches the CAV at no other times than these, s.
    pub(crate) fn collision_within(
        &self,
        [from, to]: [f64; 2],
        object: &impl Moving,
        before: usize,
    ) -> Option<(usize, [f64; 2])> {
        let poses = poses(self.cycle, self.points, self.beyond).enumerate().take(before);
        poses.into_iter().find_map(|(point, (ego, at))| {
            let time = seconds(self.clock.elapsed_ns(at));
            if time < from || time > to {
                return None;
            }
            Some((point, self.collision(&ego, at, object)?))
        })
    }

    /// Whether the check may find a collision at a point.
    fn collision(&self, ego: &Ego, at: &TrajectoryPoint, object: &impl Moving) -> Option<[f64; 2]> {
        let dt_ns = self.clock.elapsed_ns(at);
        let cav = MovingRectangle::footprint(ego, at);
        let theta_obj = self.cycle.parameters.theta_obj;
        let published = self.cycle.profile == Profile::Paper;
        let plain = object.plainly();
        if cav.certainly_apart(plain, seconds(dt_ns))
            || published && cav.certainly_far(plain, seconds(dt_ns), theta_obj)
        {
            return None;
        }
        let (cav, object) = (footprint(ego, at), object.exactly(dt_ns));
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

/// The CAV at the points, and at the places beyond the last one.
fn poses<'c>(
    cycle: &Cycle<'_>,
    points: &'c [TrajectoryPoint],
    beyond: &PlacesBeyond,
) -> impl Iterator<Item = (Ego, &'c TrajectoryPoint)> + Clone {
    let ego = cycle.ego;
    let last = points.last();
    let beyond = beyond.moved_on(ego).filter_map(move |ego| Some((ego, last?)));
    points.iter().map(move |point| (ego, point)).chain(beyond)
}

/// The CAV's rectangle at a trajectory point: shifted forward by `center_offset`.
pub(crate) fn footprint(ego: &Ego, point: &TrajectoryPoint) -> Rectangle {
    let direction = Vector::new(point.cos, point.sin);
    let shift = direction.times(Real::new(ego.center_offset));
    let centre = Vector::new(point.x, point.y) + shift;
    Rectangle { centre, direction, length: ego.length, width: ego.width }
}
