//! Stage ii: trajectory to map (`spec/3-stages.md#stage-ii-trajectory-to-map`), with H-07; the
//! rules H-11 and H-12 are in `trajectory_rules`.

pub(crate) mod route;

use crate::hardened::trajectory_rules::{arc_rules, step_rules};
use crate::input::cycle::{Cycle, Profile, Trajectory, TrajectoryPoint};
use crate::input::domain::elapsed_ns;
use crate::input::route_index::RouteIndex;
use crate::numbers::plane::segment_distance;
use crate::numbers::plane::{Vector, distance};
use crate::numbers::rounding::Real;
use crate::report::{Rule, Witness};
use crate::stages::ii_trajectory_to_map::route::Way;

/// Why stage ii fails, if it does.
pub(crate) fn map_validation<'a>(
    cycle: &Cycle<'a>,
    trajectory: &Trajectory<'_>,
    index: Option<&RouteIndex<'a>>,
) -> Option<Witness> {
    let points = trajectory.points;
    let way = Way::new(&cycle.route, index);
    let (found, all_inside) = theta_map(cycle, way, points);
    if cycle.profile == Profile::Paper {
        return found;
    }
    found
        .or_else(|| start(cycle, points))
        .or_else(|| if all_inside { None } else { corridor(way, points) })
        .or_else(|| direction(way, points))
        .or_else(|| step_rules(cycle, points))
        .or_else(|| arc_rules(cycle, points))
}

/// A point outside the corridor that is not certainly within `theta_map` of the reference path;
/// and whether no point is outside the corridor.
fn theta_map(
    cycle: &Cycle<'_>,
    way: Way<'_, '_>,
    points: &[TrajectoryPoint],
) -> (Option<Witness>, bool) {
    let limit = cycle.parameters.theta_map;
    let (mut hint, mut all_inside) = (0, true);
    let found = points.iter().enumerate().find_map(|(index, point)| {
        let q = [point.x, point.y];
        if way.in_corridor(q, &mut hint) {
            return None;
        }
        all_inside = false;
        if way.certainly_near(q, limit) {
            return None;
        }
        Some(away(way, q, hint, Rule::ThetaMap, limit).at_point(index))
    });
    (found, all_inside)
}

/// The witness that a place is too far from the reference path.
fn away(way: Way<'_, '_>, q: [f64; 2], hint: usize, rule: Rule, limit: f64) -> Witness {
    let (away, segment) = way.path_distance(q, hint);
    Witness { segment: Some(segment), ..Witness::of(rule, [away.value(), limit]) }
}

/// H-07: time and place of the first point.
fn start(cycle: &Cycle<'_>, points: &[TrajectoryPoint]) -> Option<Witness> {
    let first = points.first()?;
    let age_ns = elapsed_ns(first.t_ns, cycle.now_ns);
    let max_age_ns = cycle.parameters.max_age_ns;
    if age_ns > max_age_ns || age_ns < max_age_ns.saturating_neg() {
        let compared =
            [age_ns.saturating_abs(), max_age_ns].map(|time_ns| Real::seconds(time_ns).value());
        return Some(Witness::of(Rule::StartTime, compared).at_point(0));
    }
    let moved = Real::new(cycle.ego.speed) * Real::seconds(age_ns.max(0));
    let limit = Real::new(cycle.parameters.start_tolerance) + moved;
    let off = distance([cycle.ego.x, cycle.ego.y], [first.x, first.y]);
    let witness = Witness::of(Rule::StartPosition, [off.value(), limit.value()]).at_point(0);
    (!off.certainly_at_most(limit)).then_some(witness)
}

/// H-07: a point outside the corridor.
fn corridor(way: Way<'_, '_>, points: &[TrajectoryPoint]) -> Option<Witness> {
    let mut hint = 0;
    points.iter().enumerate().find_map(|(index, point)| {
        let q = [point.x, point.y];
        let inside = way.in_corridor(q, &mut hint);
        (!inside).then(|| away(way, q, hint, Rule::Corridor, 0.0).at_point(index))
    })
}

/// H-07: a point at which the heading is not certainly along every segment that may be nearest.
fn direction(way: Way<'_, '_>, points: &[TrajectoryPoint]) -> Option<Witness> {
    let mut hint = 0;
    if let Some(first) = points.first() {
        // Segments beside a point in the corridor are near it.
        way.in_corridor([first.x, first.y], &mut hint);
    }
    points.iter().enumerate().find_map(|(index, point)| {
        let q = [point.x, point.y];
        hint = way.nearer(q, hint);
        if certainly_along(way, point, hint) {
            return None;
        }
        let heading = Vector::new(point.cos, point.sin);
        let (least, nearest) = way.path_distance(q, hint);
        hint = nearest;
        way.segments(q, least.magnitude()).find_map(|segment| {
            let away = segment_distance(q, segment.from, segment.to);
            let along = heading.dot(Vector::between(segment.from, segment.to));
            if !away.possibly_at_most(least) || Real::ZERO.certainly_at_most(along) {
                return None;
            }
            let witness = Witness::of(Rule::Direction, [along.value(), 0.0]).at_point(index);
            Some(Witness { segment: Some(segment.index), ..witness })
        })
    })
}

/// Whether the heading is certainly along every segment that is at most as far as the one of the
/// hint, of which the nearest is one. A dot product errs by less than 2^-50 of the sum of its
/// summands' sizes.
fn certainly_along(way: Way<'_, '_>, point: &TrajectoryPoint, hint: usize) -> bool {
    let q = [point.x, point.y];
    let reach = way.at_most(q, hint);
    way.segments(q, reach).all(|segment| {
        let ([ax, ay], [bx, by]) = (segment.from, segment.to);
        let (x, y) = (point.cos * (bx - ax), point.sin * (by - ay));
        x + y > (x.abs() + y.abs()) * 1e-15 + 1e-300
    })
}
