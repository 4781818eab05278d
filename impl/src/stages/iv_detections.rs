//! Stage iv: trajectory with detections (`spec/3-stages.md#stage-iv-trajectory-with-detections`).

use crate::input::cycle::{Cycle, DetectionList, Lead, Trajectory, TrajectoryPoint};
use crate::numbers::rounding::Real;
use crate::report::{Rule, Witness};
use crate::stages::distances::{Horizon, s_follow};
use crate::stages::examined::Examined;
use crate::stages::llcc::sweep::Moving;
use crate::stages::llcc::{Collision, Course};

/// Why the gap to the current leading vehicle may be <= `s_follow`, if it may.
pub(crate) fn gap(cycle: &Cycle<'_>, lead: &Lead) -> Option<Witness> {
    let s_follow: Real = s_follow(&cycle.parameters, cycle.ego.speed, lead.speed);
    let gap = Real::new(lead.gap);
    gap.possibly_at_most(s_follow).then(|| Witness::of(Rule::Gap, [gap.value(), s_follow.value()]))
}

/// Why stage iv fails for a reason other than the gap, if it does.
pub(crate) fn detections(
    cycle: &Cycle<'_>,
    trajectory: &Trajectory<'_>,
    detections: &DetectionList<'_>,
    lead: Option<&Lead>,
) -> Option<Witness> {
    let examined = Examined::new(cycle, trajectory.points, Horizon::Valid(lead));
    let first = |cycle: &Cycle<'_>, points: &[TrajectoryPoint]| {
        let course = Course::new(cycle, points, detections.stamp_ns);
        let standing = detections.items.iter().map(Moving::detection);
        course.first(standing, |_| true).map(|Collision { point, object, compared }| {
            let witness = Witness::of(Rule::Collision, compared).at_point(point);
            Witness { detection: Some(object), ..witness }
        })
    };
    first(cycle, examined.points).or_else(|| examined.first_beyond(first))
}
