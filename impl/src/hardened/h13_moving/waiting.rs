//! H-13 (c): where the CAV may not wait for an object, it has to be seen to get through
//! (`spec/3-stages.md#hardened-profile`).
//!
//! What is examined on are the points after those of (a) and (b), of pairs for which the CAV may
//! wait at the first point, and may not at any from the last of those points on. Rounding examines
//! more: at the first point it may wait when that is too close to call, at the others it may not.
//!
//! To look at few pairs, the points are taken in two stretches. Points up to a few lengths of the CAV
//! on are taken with those of (a) and (b). Farther on the CAV is met by what comes along its way alone:
//! from elsewhere no velocity leads both to where (a) and (b) end and there.

use crate::hardened::h13_moving::seen_twice::SeenTwice;
use crate::input::cycle::{Cycle, TrajectoryPoint};
use crate::numbers::plane::Vector;
use crate::numbers::range::intersection;
use crate::numbers::rectangle::{Rectangle, certainly_passes, possibly_passes};
use crate::numbers::rounding::Real;
use crate::numbers::time::{elapsed_ns, seconds};
use crate::stages::horizon::PointsExamined;
use crate::stages::llcc::pursuit::Pursuit;
use crate::stages::llcc::sweep::MovingRectangle;
use crate::stages::llcc::{CavMotion, Moving, footprint};

/// Points that are examined one after the other.
pub(super) struct Stretch<'m, 'a> {
    pub(super) motion: CavMotion<'m, 'a>,
    pub(super) pursuit: Pursuit,
    /// Index of the first of them.
    pub(super) from: usize,
}

impl<'m, 'a> Stretch<'m, 'a> {
    fn new(motion: CavMotion<'m, 'a>, from: usize) -> Self {
        Self { pursuit: motion.pursuit(), motion, from }
    }

    /// The points of (a) and (b), and the places beyond the end; or those of (c) that are near, too.
    pub(super) fn first(
        examined: &'m PointsExamined<'m, 'a>,
        waiting: Option<&Waiting<'m, 'a>>,
        stamp_ns: i64,
    ) -> Self {
        let motion = match waiting {
            Some(waiting) => CavMotion::new(waiting.cycle, waiting.near, stamp_ns),
            None => CavMotion::with_beyond(examined, stamp_ns),
        };
        Self::new(motion, 0)
    }
}

/// The points of (c) that are far.
pub(super) struct Far<'m, 'a> {
    pub(super) stretch: Stretch<'m, 'a>,
    /// The CAV where (a) and (b) end, and at the first of the points.
    ends: [MovingRectangle; 2],
    /// Waiting where (a) and (b) end.
    standing: Pursuit,
    /// Whether that is after the time 0, so that objects do not move back.
    is_later: bool,
}

impl Far<'_, '_> {
    /// Whether some velocity may lead to where the CAV may not wait, and later to one of the points.
    /// `object`: where it is at the time 0.
    #[inline]
    pub(super) fn may_be_met(&self, object: &MovingRectangle) -> bool {
        let [one, other] = &self.ends;
        !(self.is_later && object.is_beside(one, other))
    }

    /// With which velocities along the axes of the plane, m/s.
    pub(super) fn velocities(&self, object: &MovingRectangle) -> [[f64; 2]; 2] {
        intersection(self.stretch.pursuit.velocities(object), self.standing.velocities(object))
    }
}

/// Where the CAV may have to wait.
pub(super) struct Waiting<'m, 'a> {
    cycle: &'m Cycle<'a>,
    points: &'m [TrajectoryPoint],
    /// So many are examined by (a) and (b).
    pub(super) examined: usize,
    /// All of them up to some of (c).
    near: &'m [TrajectoryPoint],
    /// Objects move from this time on.
    stamp_ns: i64,
}

/// The points of (c) that are near are up to so many times the length of the CAV and its width,
/// together.
const LONG: f64 = 2.0;

impl<'m, 'a> Waiting<'m, 'a> {
    /// `points`: of the whole trajectory, of which so many are examined by (a) and (b). `None` when
    /// there are none after those.
    pub(super) fn new(
        cycle: &'m Cycle<'a>,
        points: &'m [TrajectoryPoint],
        examined: usize,
        stamp_ns: i64,
    ) -> Option<Self> {
        let on = points.get(examined.saturating_sub(1)..).filter(|on| on.len() > 1)?;
        let start = on.first()?;
        let far = LONG * (cycle.ego.length + cycle.ego.width);
        let is_near = |at: &&TrajectoryPoint| {
            let (x, y) = (at.x - start.x, at.y - start.y);
            x * x + y * y < far * far
        };
        let near = examined.saturating_add(on.iter().take_while(is_near).count());
        let near = points.get(..near).unwrap_or(points);
        Some(Self { cycle, points, examined, near, stamp_ns })
    }

    /// The points from the last one that is near on, if there are others.
    pub(super) fn far(&self) -> Option<Far<'m, 'a>> {
        let from = self.near.len().saturating_sub(1);
        let points = self.points.get(from..).filter(|points| points.len() > 1)?;
        let at = |point: &TrajectoryPoint| MovingRectangle::footprint(&self.cycle.ego, point);
        let (first, last) = (points.first()?, self.last()?);
        let motion = CavMotion::unswept(self.cycle, points, self.stamp_ns);
        let since = seconds(elapsed_ns(self.stamp_ns, last.t_ns));
        Some(Far {
            stretch: Stretch::new(motion, from),
            ends: [at(last), at(first)],
            standing: Pursuit::standing(&at(last), since),
            is_later: since > 0.0,
        })
    }

    /// The last point of (a) and (b).
    fn last(&self) -> Option<&'m TrajectoryPoint> {
        self.points.get(self.examined.saturating_sub(1))
    }

    /// Whether the CAV certainly may wait at the last point of (a) and (b), by plain doubles.
    pub(super) fn is_passed_by(&self, seen: &SeenTwice) -> bool {
        let Some(at) = self.last() else { return false };
        let seconds = seconds(elapsed_ns(self.stamp_ns, at.t_ns));
        let cav = MovingRectangle::footprint(&self.cycle.ego, at);
        cav.is_passed_by(&seen.now, seconds) == Some(true)
    }

    /// Whether a pair is examined at the point with this index, if so far nothing was found.
    pub(super) fn is_examined_at(&self, point: usize, seen: &SeenTwice) -> bool {
        let before = self.points.get(self.examined.saturating_sub(1)..point).unwrap_or(&[]);
        let may_wait_at_first =
            |first: &TrajectoryPoint| self.may_wait(first, seen, possibly_passes);
        point < self.examined
            || self.points.first().is_some_and(may_wait_at_first)
                && !before.iter().any(|at| self.may_wait(at, seen, certainly_passes))
    }

    /// `rounded`: what is asked when plain doubles cannot tell.
    fn may_wait(
        &self,
        at: &TrajectoryPoint,
        seen: &SeenTwice,
        rounded: fn(&Rectangle, &Rectangle, Vector) -> bool,
    ) -> bool {
        let dt_ns = elapsed_ns(self.stamp_ns, at.t_ns);
        let cav = MovingRectangle::footprint(&self.cycle.ego, at);
        cav.is_passed_by(&seen.now, seconds(dt_ns)).unwrap_or_else(|| {
            let velocity = enlarged(seen.moved());
            rounded(&footprint(&self.cycle.ego, at), &seen.exactly(dt_ns), velocity)
        })
    }
}

/// A vector of the same direction, of which nothing underflows when it is multiplied.
fn enlarged(vector: Vector) -> Vector {
    /// 2^-400
    const TINY: f64 = f64::from_bits((1023 - 400) << 52);
    let is_tiny = vector.x.magnitude() < TINY && vector.y.magnitude() < TINY;
    if is_tiny { vector.times(Real::new(1.0 / TINY)) } else { vector }
}
