//! Stage iv: trajectory with detections (`spec/3-stages.md#stage-iv-trajectory-with-detections`).

use crate::input::cycle::{Cycle, DetectionList, Lead, Trajectory};
use crate::numbers::rounding::Real;
use crate::report::{Rule, Witness};
use crate::stages::distances::s_follow;
use crate::stages::horizon::{Horizon, points_examined};
use crate::stages::llcc::sweep::MovingRectangle;
use crate::stages::llcc::{CavMotion, Collision};

/// Why stage iv fails, if it does. `lead`: the current leading vehicle.
pub(crate) fn trajectory_with_detections(
    cycle: &Cycle<'_>,
    trajectory: &Trajectory<'_>,
    detections: &DetectionList<'_>,
    lead: Option<&Lead>,
) -> Option<Witness> {
    let follow = |lead: &Lead| s_follow(&cycle.parameters, cycle.ego.speed, lead.speed);
    // S4-02; A-02
    gap_failure(lead, follow).or_else(|| collision(cycle, trajectory, detections, lead))
}

/// Why the gap to the current leading vehicle may be at most what is needed, in m, if it may.
pub(crate) fn gap_failure(
    lead: Option<&Lead>,
    needed: impl FnOnce(&Lead) -> Real,
) -> Option<Witness> {
    let lead = lead?;
    //
    let (gap, needed) = (Real::new(lead.gap), needed(lead));
    gap.possibly_at_most(needed).then(|| Witness::of(Rule::Gap, [gap.value(), needed.value()]))
}

/// The first collision with a detection, which stands still, within `s_valid`.
fn collision(
    cycle: &Cycle<'_>,
    trajectory: &Trajectory<'_>,
    detections: &DetectionList<'_>,
    lead: Option<&Lead>,
) -> Option<Witness> {
    // S4-02
    let points = points_examined(cycle, trajectory.points, Horizon::Valid(lead));
    let motion = CavMotion::new(cycle, points, detections.stamp_ns);
    //
    let found = motion.first_collision(detections.items.iter().map(MovingRectangle::detection));
    found.map(|Collision { point, object, compared }| {
        let witness = Witness::of(Rule::Collision, compared).at_point(point);
        Witness { detection: Some(object), ..witness }
    })
}
