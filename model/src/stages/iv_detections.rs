//! Stage iv: trajectory with detections
//! (`spec/3-stages.md#stage-iv-trajectory-with-detections`, H-04).

use crate::input::scene::{Object, Point, Scene};
use crate::report::{Rule, Witness};
use crate::stages::distances::{points_examined, s_follow, s_valid};
use crate::stages::llcc::llcc;

/// Compares the gap with s_follow and the trajectory with the standing detections; `None` passes.
pub fn detections(scene: &Scene, trajectory: &[Point], detections: &[Object]) -> Option<Witness> {
    gap_failure(scene).or_else(|| {
        let p = &scene.parameters;
        let v_lead = scene.lead.as_ref().map(|lead| &lead.speed);
        let s = s_valid(&scene.ego.v_now, v_lead, &p.a_b, &p.safety_time);
        let points = points_examined(scene, trajectory, &s);
        points.iter().enumerate().find_map(|(i, point)| {
            detections.iter().enumerate().find_map(|(j, detection)| {
                let collision = llcc(scene, point, detection)?;
                Some(Witness {
                    point: Some(i),
                    detection: Some(j),
                    ..Witness::new(Rule::Collision, &collision.distance, &collision.limit)
                })
            })
        })
    })
}

/// There is a leading vehicle and its gap is <= s_follow.
pub fn gap_failure(scene: &Scene) -> Option<Witness> {
    let lead = scene.lead.as_ref()?;
    let p = &scene.parameters;
    let s_follow = s_follow(&scene.ego.v_now, &lead.speed, &p.a_b, &p.safety_time);
    (lead.gap <= &s_follow + &scene.m).then(|| Witness::new(Rule::Gap, &lead.gap, &s_follow))
}
