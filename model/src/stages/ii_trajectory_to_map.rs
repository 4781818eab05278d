//! Stage ii: paper Sec. IV-C, "Trajectory to Map Validation"
//! (`spec/3-stages.md#stage-ii-trajectory-to-map`, H-07, H-11, H-14):
//!
//! distance to the reference path <= theta_map, or inside the path boundaries

use crate::hardened::h14_fail_safe::reach;
use crate::hardened::{h07_start, h11_steps};
use crate::input::profile::HardenedRule;
use crate::input::scene::{Point, Route, Scene};
use crate::numbers::polygon::{Triangle, is_in_union};
use crate::numbers::polyline::{Beside, beside};
use crate::numbers::vector::Vector;
use crate::report::{Rule, Witness};

/// Compares the points of the whole trajectory with the route; `None` passes.
pub fn trajectory_to_map(scene: &Scene, trajectory: &[Point]) -> Option<Witness> {
    let (path, corridor) = (scene.route.reference_path(), corridor(&scene.route));
    let theta_map = &scene.parameters.theta_map;
    let position = |i: usize| &trajectory[i].pose.origin;
    let places: Vec<Beside> = (0..trajectory.len()).map(|i| beside(position(i), &path)).collect();
    let is_inside = |i: usize| is_in_union(&scene.reads, &corridor, position(i));
    let failure = places.iter().enumerate().find_map(|(i, place)| {
        let passes = scene.reads.at_most(&place.distance, theta_map) || is_inside(i);
        let witness = Witness::unless(passes, Rule::ThetaMap, &place.distance, theta_map)?;
        Some(Witness { segment: Some(place.nearest), ..witness.at_point(i) })
    });
    let rules: [(HardenedRule, &dyn Fn() -> Option<Witness>); 3] = [
        (HardenedRule::H07, &|| h07_start::failure(scene, trajectory, &path, &places, is_inside)),
        (HardenedRule::H11, &|| h11_steps::step_failure(scene, trajectory)),
        (HardenedRule::H14, &|| reach::failure(scene, trajectory)),
    ];
    let mut in_force = rules.iter().filter(|(rule, _)| scene.profile.has(*rule));
    failure
        .or_else(|| in_force.find_map(|(_, failure)| failure()))
        .or_else(|| reach::ambiguous_failure(scene, trajectory))
}

/// The union of (left_i, right_i, right_i+1) and (left_i, right_i+1, left_i+1).
fn corridor(route: &Route) -> Vec<Triangle> {
    let triangles = |[[_, left, right], [_, next_left, next_right]]: [&[Vector; 3]; 2]| {
        [[left, right, next_right], [left, next_right, next_left]].map(|t| t.map(Vector::clone))
    };
    route.pairs().into_iter().flat_map(triangles).collect()
}
