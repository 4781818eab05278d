//! Stage iv: paper Sec. IV-E, "Trajectory Validation with Detections", Eq. (4) to (6)
//! (`spec/3-stages.md#stage-iv-trajectory-with-detections`):
//!
//! gap > s_follow, and no collision with a detection within s_valid

use crate::input::scene::{Detections, Point, Scene};
use crate::report::{Rule, Witness};
use crate::stages::distances::{s_follow, s_valid};
use crate::stages::horizon::points_within;
use crate::stages::llcc::first_collision;

/// Compares the gap with s_follow, and the trajectory within s_valid with the detections, which are
/// taken as standing still; `None` passes.
pub fn trajectory_with_detections(
    scene: &Scene,
    trajectory: &[Point],
    detections: &Detections,
) -> Option<Witness> {
    gap_failure(scene).or_else(|| {
        let p = &scene.parameters;
        let v_lead = scene.lead.as_ref().map(|lead| &lead.speed);
        let s_valid = s_valid(&scene.ego.v_now, v_lead, &p.a_b, &p.safety_time);
        let points = points_within(scene, trajectory, &s_valid);
        first_collision(scene, points, &detections.items, |_, d| d.clone())
            .map(|(j, witness)| Witness { detection: Some(j), ..witness })
    })
}

/// The distance to the leading vehicle must be larger than s_follow.
pub fn gap_failure(scene: &Scene) -> Option<Witness> {
    let lead = scene.lead.as_ref()?;
    let p = &scene.parameters;
    let s_follow = s_follow(&scene.ego.v_now, &lead.speed, &p.a_b, &p.safety_time);
    Witness::unless(scene.reads.greater(&lead.gap, &s_follow), Rule::Gap, &lead.gap, &s_follow)
}
