//! Stage ii: trajectory to map (`spec/3-stages.md#stage-ii-trajectory-to-map`).

pub(crate) mod indexed_route;

use crate::input::cycle::{Cycle, TrajectoryPoint};
use crate::report::{Rule, Witness};
use crate::stages::ii_trajectory_to_map::indexed_route::IndexedRoute;

/// Why stage ii fails, if it does: a point outside the corridor that is not certainly within `theta_map`
/// of the reference path; and, where it does not, whether no point is outside the corridor.
#[inline]
pub(crate) fn trajectory_to_map(
    cycle: &Cycle<'_>,
    route: IndexedRoute<'_, '_>,
    points: &[TrajectoryPoint],
) -> (Option<Witness>, bool) {
    let limit = cycle.parameters.theta_map;
    let (mut hint, mut all_inside) = (0, true);
    let found = points.iter().enumerate().find_map(|(index, point)| {
        let q = [point.x, point.y];
        if route.in_corridor(q, &mut hint) {
            return None;
        }
        all_inside = false;
        // S2-03
        if route.certainly_near(q, limit) {
            return None;
        }
        Some(route.too_far(q, hint, Rule::ThetaMap, limit).at_point(index))
    });
    (found, all_inside)
}
