//! Stage iv: trajectory with detections (`spec/3-stages.md#stage-iv-trajectory-with-detections`).

use crate::input::cycle::{Cycle, DetectionList, Lead, Trajectory, TrajectoryPoint};
use crate::numbers::rounding::Real;
use crate::report::{Rule, Witness};
use crate::stages::distances::s_follow;
use crate::stages::horizon::{Horizon, PointsExamined};
use crate::stages::llcc::sweep::MovingRectangle;
use crate::stages::llcc::{CavMotion, Collision};

/// Why stage iv fails, if it does. `lead`: the current leading vehicle.
pub(crate) fn trajectory_with_detections(
    cycle: &Cycle<'_>,
    trajectory: &Trajectory<'_>,
    detections: &DetectionList<'_>,
    lead: Option<&Lead>,
) -> Option<Witness> {
    gap_failure(cycle, lead).or_else(|| collision(cycle, trajectory, detections, lead))
}

/// Why the gap to the current leading vehicle may be <= `s_follow`, if it may.
pub(crate) fn gap_failure(cycle: &Cycle<'_>, lead: Option<&Lead>) -> Option<Witness> {
    let lead = lead?;
    let s_follow: Real = s_follow(&cycle.parameters, cycle.ego.speed, lead.speed);
    let gap = Real::new(lead.gap);
    gap.possibly_at_most(s_follow).then(|| Witness::of(Rule::Gap, [gap.value(), s_follow.value()]))
}

/// The first collision with a detection, which stands still, within `s_valid`.
fn collision(
    cycle: &Cycle<'_>,
    trajectory: &Trajectory<'_>,
    detections: &DetectionList<'_>,
    lead: Option<&Lead>,
) -> Option<Witness> {
    let examined = PointsExamined::new(cycle, trajectory.points, Horizon::Valid(lead));
    let first = |cycle: &Cycle<'_>, points: &[TrajectoryPoint]| {
        let motion = CavMotion::new(cycle, points, detections.stamp_ns);
        let standing = detections.items.iter().map(MovingRectangle::detection);
        let found = motion.first_collision(standing, |_| true);
        found.map(|Collision { point, object, compared }| {
            let witness = Witness::of(Rule::Collision, compared).at_point(point);
            Witness { detection: Some(object), ..witness }
        })
    };
    first(cycle, examined.points).or_else(|| examined.first_beyond(first))
}
