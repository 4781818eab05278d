//! Stage ii: trajectory to map (`spec/3-stages.md#stage-ii-trajectory-to-map`), with H-07; the
//! rules H-11 and H-12 are in `trajectory_rules`.

use crate::cycle::{Cycle, Profile, Trajectory, TrajectoryPoint};
use crate::input::elapsed_ns;
use crate::plane::segment_distance;
use crate::plane::{Vector, distance};
use crate::rounding::Real;
use crate::route::{apart, certainly_near, in_corridor, path_distance, segments};
use crate::trajectory_rules::{arc_rules, step_rules};
use crate::verdict::{Rule, Witness};

/// Why stage ii fails, if it does.
pub(crate) fn map_validation(cycle: &Cycle<'_>, trajectory: &Trajectory<'_>) -> Option<Witness> {
    let points = trajectory.points;
    let found = theta_map(cycle, points);
    if cycle.profile == Profile::Paper {
        return found;
    }
    found
        .or_else(|| start(cycle, points))
        .or_else(|| corridor(cycle, points))
        .or_else(|| direction(cycle, points))
        .or_else(|| step_rules(cycle, points))
        .or_else(|| arc_rules(cycle, points))
}

/// A point outside the corridor that is not certainly within `theta_map` of the reference path.
fn theta_map(cycle: &Cycle<'_>, points: &[TrajectoryPoint]) -> Option<Witness> {
    let limit = cycle.parameters.theta_map;
    points.iter().enumerate().find_map(|(index, point)| {
        let q = [point.x, point.y];
        if in_corridor(&cycle.route, q) || certainly_near(&cycle.route, q, limit) {
            return None;
        }
        let (away, segment) = path_distance(&cycle.route, q, 0);
        let witness = Witness::of(Rule::ThetaMap, [away.value(), limit]).at_point(index);
        Some(Witness { segment: Some(segment), ..witness })
    })
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
fn corridor(cycle: &Cycle<'_>, points: &[TrajectoryPoint]) -> Option<Witness> {
    points.iter().enumerate().find_map(|(index, point)| {
        let q = [point.x, point.y];
        if in_corridor(&cycle.route, q) {
            return None;
        }
        let (away, segment) = path_distance(&cycle.route, q, 0);
        let witness = Witness::of(Rule::Corridor, [away.value(), 0.0]).at_point(index);
        Some(Witness { segment: Some(segment), ..witness })
    })
}

/// H-07: a point at which the heading is not certainly along every segment that may be nearest.
fn direction(cycle: &Cycle<'_>, points: &[TrajectoryPoint]) -> Option<Witness> {
    let mut hint = 0;
    points.iter().enumerate().find_map(|(index, point)| {
        let q = [point.x, point.y];
        let heading = Vector::new(point.cos, point.sin);
        let (least, nearest) = path_distance(&cycle.route, q, hint);
        hint = nearest;
        segments(&cycle.route).find_map(|segment| {
            if apart(segment, q) > least.magnitude() {
                return None;
            }
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
