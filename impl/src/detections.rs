//! Stage iv: trajectory with detections (`spec/3-stages.md#stage-iv-trajectory-with-detections`).

use crate::collision::{collision, examined, footprint};
use crate::cycle::{Cycle, Detection, DetectionList, Lead, Trajectory};
use crate::distance::{s_follow, s_valid};
use crate::plane::Vector;
use crate::rectangle::Rectangle;
use crate::rounding::Real;
use crate::verdict::{Rule, Witness};

/// Why the gap to the current leading vehicle may be <= `s_follow`, if it may.
pub(crate) fn gap(cycle: &Cycle<'_>, lead: &Lead) -> Option<Witness> {
    let s_follow = s_follow(&cycle.parameters, cycle.ego.speed, lead.speed);
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
    let s = s_valid(&cycle.parameters, cycle.ego.speed, lead);
    let count = examined(cycle, trajectory.points, s);
    trajectory.points.iter().take(count).enumerate().find_map(|(index, point)| {
        let cav = footprint(&cycle.ego, point);
        detections.items.iter().enumerate().find_map(|(item, detection)| {
            let compared = collision(cycle, &cav, &standing(detection))?;
            let witness = Witness::of(Rule::Collision, compared).at_point(index);
            Some(Witness { detection: Some(item), ..witness })
        })
    })
}

/// A detection stands still.
fn standing(detection: &Detection) -> Rectangle {
    Rectangle {
        centre: Vector::new(detection.x, detection.y),
        direction: Vector::new(detection.cos, detection.sin),
        length: detection.length,
        width: detection.width,
    }
}
