//! Stage ii: trajectory to map (`spec/3-stages.md#stage-ii-trajectory-to-map`).

pub(crate) mod indexed_route;

use crate::hardened::h07_start::{corridor_failure, direction_failure, start_failure};
use crate::hardened::h11_steps::step_failure;
use crate::hardened::h14_fail_safe::reach::reach_failure;
use crate::input::cycle::{Cycle, Trajectory, TrajectoryPoint};
use crate::input::profile::HardenedRule;
use crate::input::route_index::RouteIndex;
use crate::report::{Rule, Witness};
use crate::stages::ii_trajectory_to_map::indexed_route::IndexedRoute;

/// Why stage ii fails, if it does.
pub(crate) fn trajectory_to_map<'a>(
    cycle: &Cycle<'a>,
    trajectory: &Trajectory<'_>,
    index: Option<&RouteIndex<'a>>,
) -> Option<Witness> {
    let points = trajectory.points;
    let route = IndexedRoute::new(&cycle.route, index);
    let (found, all_inside) = theta_map(cycle, route, points);
    let [h07, h11, h14] = [HardenedRule::H07, HardenedRule::H11, HardenedRule::H14]
        .map(|rule| cycle.profile.has(rule));
    found
        .or_else(|| if h07 { start_failure(cycle, points) } else { None })
        .or_else(|| if h07 && !all_inside { corridor_failure(route, points) } else { None })
        .or_else(|| if h07 { direction_failure(route, points) } else { None })
        .or_else(|| if h11 { step_failure(cycle, points) } else { None })
        .or_else(|| if h14 { reach_failure(cycle, points) } else { None })
}

/// A point outside the corridor that is not certainly within `theta_map` of the reference path;
/// and whether no point is outside the corridor.
fn theta_map(
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
        if route.certainly_near(q, limit) {
            return None;
        }
        Some(route.too_far(q, hint, Rule::ThetaMap, limit).at_point(index))
    });
    (found, all_inside)
}
