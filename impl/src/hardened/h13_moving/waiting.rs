//! H-13 (c): where the CAV may not wait for an object, it has to be seen to get through
//! (`spec/3-stages.md#hardened-profile`).
//!
//! What is examined on are the points after those of (a) and (b), of pairs for which the CAV may
//! wait at the first point, and may not at any from the last of those points on. Rounding examines
//! more: at the first point it may wait when that is too close to call, at the others it may not.

use crate::hardened::h13_moving::seen_twice::SeenTwice;
use crate::input::cycle::{Ego, TrajectoryPoint};
use crate::numbers::plane::Vector;
use crate::numbers::rectangle::{Rectangle, certainly_passes, possibly_passes};
use crate::numbers::rounding::Real;
use crate::numbers::time::{elapsed_ns, seconds};
use crate::stages::llcc::pursuit::Pursuit;
use crate::stages::llcc::sweep::MovingRectangle;
use crate::stages::llcc::{Moving, footprint};

/// The CAV where it may have to wait.
pub(super) struct Waiting<'a> {
    ego: Ego,
    first: TrajectoryPoint,
    /// The points from the last one of (a) and (b) on.
    on: &'a [TrajectoryPoint],
    /// Index of the first of them.
    pub(super) from: usize,
    /// Objects move from this time on.
    stamp_ns: i64,
    /// The CAV, standing at the first of them for ever.
    pub(super) standing: Pursuit,
}

impl<'a> Waiting<'a> {
    /// `points`: of the whole trajectory, of which so many are examined by (a) and (b). `None` when
    /// there are none after those.
    pub(super) fn new(
        ego: Ego,
        points: &'a [TrajectoryPoint],
        examined: usize,
        stamp_ns: i64,
    ) -> Option<Self> {
        let from = examined.saturating_sub(1);
        let on = points.get(from..).filter(|on| on.len() > 1)?;
        let (&first, last) = points.first().zip(on.first())?;
        let since = seconds(elapsed_ns(stamp_ns, last.t_ns));
        let standing = Pursuit::standing(&MovingRectangle::footprint(&ego, last), since);
        Some(Self { ego, first, on, from, stamp_ns, standing })
    }

    /// The points from the last one of (a) and (b) on.
    pub(super) const fn points(&self) -> &'a [TrajectoryPoint] {
        self.on
    }

    /// Whether a pair is examined at the point with this index, if so far nothing was found.
    pub(super) fn is_examined_at(&self, point: usize, seen: &SeenTwice) -> bool {
        let before = self.on.iter().take(point.saturating_sub(self.from));
        self.may_wait(&self.first, seen, possibly_passes)
            && !before.into_iter().any(|at| self.may_wait(at, seen, certainly_passes))
    }

    /// `rounded`: what is asked when plain doubles cannot tell.
    fn may_wait(
        &self,
        at: &TrajectoryPoint,
        seen: &SeenTwice,
        rounded: fn(&Rectangle, &Rectangle, Vector) -> bool,
    ) -> bool {
        let dt_ns = elapsed_ns(self.stamp_ns, at.t_ns);
        let cav = MovingRectangle::footprint(&self.ego, at);
        cav.is_passed_by(&seen.now, seconds(dt_ns)).unwrap_or_else(|| {
            let velocity = enlarged(seen.moved());
            rounded(&footprint(&self.ego, at), &seen.exactly(dt_ns), velocity)
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
