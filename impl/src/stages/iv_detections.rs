//! Stage iv: trajectory with detections (`spec/3-stages.md#stage-iv-trajectory-with-detections`).

use crate::hardened::h10_explained::{Explained, points_of_explained};
use crate::hardened::h13_moving::MovingDetections;
use crate::input::cycle::{Cycle, DetectionList, Lead, Trajectory, TrajectoryPoint};
use crate::input::scratch::Scratch;
use crate::numbers::rounding::Real;
use crate::report::{Rule, Witness};
use crate::stages::distances::s_follow;
use crate::stages::horizon::{Horizon, PointsExamined};
use crate::stages::llcc::sweep::MovingRectangle;
use crate::stages::llcc::{CavMotion, Collision};

/// Why stage iv fails, if it does. `lead`: the current leading vehicle; `moving`: how the
/// detections have moved.
pub(crate) fn trajectory_with_detections(
    cycle: &Cycle<'_>,
    trajectory: &Trajectory<'_>,
    detections: &DetectionList<'_>,
    lead: Option<&Lead>,
    moving: &MovingDetections<'_, '_>,
    scratch: &mut Scratch<'_>,
) -> Option<Witness> {
    gap_failure(cycle, lead).or_else(|| {
        let explained = Explained::new(&moving.history, moving.tracks, scratch);
        let points = points_of_explained(cycle, trajectory, &explained);
        let up_to = |detection: usize| {
            let by = |_: &usize| explained.by(detection, scratch.rows, scratch.columns).is_some();
            points.filter(by).unwrap_or(usize::MAX)
        };
        collision(cycle, trajectory, detections, lead, up_to)
            .or_else(|| moving.failure(cycle, trajectory, &explained, scratch))
    })
}

/// Why the gap to the current leading vehicle may be <= `s_follow`, if it may.
pub(crate) fn gap_failure(cycle: &Cycle<'_>, lead: Option<&Lead>) -> Option<Witness> {
    let lead = lead?;
    let s_follow: Real = s_follow(&cycle.parameters, cycle.ego.speed, lead.speed);
    let gap = Real::new(lead.gap);
    gap.possibly_at_most(s_follow).then(|| Witness::of(Rule::Gap, [gap.value(), s_follow.value()]))
}

/// The first collision with a detection, which stands still, within `s_valid`. `up_to`: at how many
/// points of the trajectory a detection is examined, by its index.
fn collision(
    cycle: &Cycle<'_>,
    trajectory: &Trajectory<'_>,
    detections: &DetectionList<'_>,
    lead: Option<&Lead>,
    up_to: impl Fn(usize) -> usize,
) -> Option<Witness> {
    let examined = PointsExamined::new(cycle, trajectory.points, Horizon::Valid(lead));
    let everywhere = |cycle: &Cycle<'_>, points: &[TrajectoryPoint]| {
        first_collision(cycle, points, detections, |_| usize::MAX)
    };
    first_collision(cycle, examined.points, detections, up_to)
        .or_else(|| examined.first_beyond(everywhere))
}

fn first_collision(
    cycle: &Cycle<'_>,
    points: &[TrajectoryPoint],
    detections: &DetectionList<'_>,
    up_to: impl Fn(usize) -> usize,
) -> Option<Witness> {
    let motion = CavMotion::new(cycle, points, detections.stamp_ns);
    let standing = detections.items.iter().map(MovingRectangle::detection);
    let found = motion.first_collision(standing, up_to);
    found.map(|Collision { point, object, compared }| {
        let witness = Witness::of(Rule::Collision, compared).at_point(point);
        Witness { detection: Some(object), ..witness }
    })
}
