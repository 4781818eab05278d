//! Stage ii: paper Sec. IV-C, "Trajectory to Map Validation"
//! (`spec/3-stages.md#stage-ii-trajectory-to-map`):
//!
//! distance to the reference path <= theta_map, or inside the path boundaries

use crate::input::scene::{Point, Route, Scene};
use crate::numbers::polygon::{Triangle, is_in_strip, is_in_union};
use crate::numbers::polyline::{Beside, Segment, beside};
use crate::numbers::real::Real;
use crate::numbers::vector::Vector;
use crate::report::{Rule, Witness};

/// Compares the points of the whole trajectory with the route; `None` passes.
pub fn trajectory_to_map(scene: &Scene, trajectory: &[Point]) -> Option<Witness> {
    OnMap::new(scene, trajectory).failure(scene)
}

/// The points of a trajectory on the map.
#[derive(Debug)]
pub struct OnMap<'a> {
    /// The points.
    pub trajectory: &'a [Point],
    /// The reference path.
    pub path: Vec<Segment>,
    /// Each point beside the path.
    pub places: Vec<Beside>,
    corridor: Vec<Triangle>,
}

impl<'a> OnMap<'a> {
    /// Those of a trajectory on the route of the scene.
    pub fn new(scene: &Scene, trajectory: &'a [Point]) -> Self {
        let (path, corridor) = (scene.route.reference_path(), corridor(&scene.route));
        let place = |point: &Point| beside(&point.pose.origin, &path);
        let places = trajectory.iter().map(place).collect();
        Self { trajectory, path, places, corridor }
    }

    /// The first point that is farther than theta_map - m from the path and outside the corridor; strictly m is at least
    /// 10^-5 m.
    pub fn failure(&self, scene: &Scene) -> Option<Witness> {
        let theta_map = &scene.parameters.theta_map;
        let most = theta_map - scene.reads.m_at_least(Real::from_double(1e-5));
        self.places.iter().enumerate().find_map(|(i, place)| {
            let passes = place.distance <= most || self.is_inside(scene, i);
            let witness = Witness::unless(passes, Rule::ThetaMap, &place.distance, theta_map)?;
            Some(Witness { segment: Some(place.nearest), ..witness.at_point(i) })
        })
    }

    /// The i-th point is inside the corridor.
    pub fn is_inside(&self, scene: &Scene, i: usize) -> bool {
        is_in_union(&scene.reads, &self.corridor, &self.trajectory[i].pose.origin)
    }

    /// A place of H-14 is inside the corridor.
    pub fn holds_place(&self, scene: &Scene, place: &Vector) -> bool {
        is_in_strip(&scene.reads, &self.corridor, scene.route.closed, place)
    }
}

/// The union of (left_i, right_i, right_i+1) and (left_i, right_i+1, left_i+1).
fn corridor(route: &Route) -> Vec<Triangle> {
    let triangles = |[[_, left, right], [_, next_left, next_right]]: [&[Vector; 3]; 2]| {
        [[left, right, next_right], [left, next_right, next_left]].map(|t| t.map(Vector::clone))
    };
    route.pairs().into_iter().flat_map(triangles).collect()
}
