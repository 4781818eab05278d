//! The trajectory points within a distance s: paper Sec. IV-D, "each trajectory point that is within a
//! safety distance" (`spec/3-stages.md#distances`).

use crate::input::scene::{Point, Scene};
use crate::numbers::real::Real;

/// The points that a stage with the horizon `s` examines: those whose arc length is <= s, and always
/// the first.
pub fn points_within<'a>(scene: &Scene, trajectory: &'a [Point], s: &Real) -> &'a [Point] {
    let within = |length: &&Real| scene.reads.may_be_at_most(length, s);
    let count = arc_lengths(trajectory).iter().filter(within).count();
    &trajectory[..count.max(1)]
}

/// Length of the trajectory polyline from its first point to each point, m.
pub fn arc_lengths(trajectory: &[Point]) -> Vec<Real> {
    let mut lengths = vec![Real::zero()];
    for step in trajectory.windows(2) {
        let length = step[1].pose.origin.distance(&step[0].pose.origin);
        lengths.push(lengths[lengths.len() - 1].clone() + length);
    }
    lengths
}
