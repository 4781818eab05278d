//! H-07: the trajectory starts now and here, as the CAV is, runs ahead of it nowhere, stays in the corridor and heads
//! along the route.

use crate::hardened::h14_fail_safe::widening::passing_distance;
use crate::input::scene::{Point, Scene};
use crate::numbers::polyline::{Beside, Segment};
use crate::numbers::real::Real;
use crate::report::{Rule, Witness};
use crate::stages::ii_trajectory_to_map::OnMap;

/// The trajectory does not start now and here, runs ahead of the CAV, leaves the corridor, or heads against the route.
pub fn failure(scene: &Scene, map: &OnMap) -> Option<Witness> {
    let start = &map.trajectory[0];
    let at_start = |witness: Witness| witness.at_point(0);
    (time_failure(scene, start).map(at_start))
        .or_else(|| position_failure(scene, map.trajectory))
        .or_else(|| start_heading_failure(scene, start).map(at_start))
        .or_else(|| start_offset_failure(scene, map.trajectory).map(at_start))
        .or_else(|| corridor_failure(scene, map))
        .or_else(|| direction_failure(scene, map))
}

/// Every point is inside the corridor, however near the reference path.
fn corridor_failure(scene: &Scene, map: &OnMap) -> Option<Witness> {
    let (i, place) = map.places.iter().enumerate().find(|(i, _)| !map.is_inside(scene, *i))?;
    let witness = Witness::new(Rule::Corridor, &place.distance, &Real::zero());
    Some(Witness { segment: Some(place.nearest), ..witness.at_point(i) })
}

/// Every point heads along the route.
fn direction_failure(scene: &Scene, map: &OnMap) -> Option<Witness> {
    map.trajectory.iter().zip(&map.places).enumerate().find_map(|(i, (point, place))| {
        let witness = heading_failure(scene, point, &map.path, place)?.at_point(i);
        Some(Witness { segment: Some(place.nearest), ..witness })
    })
}

/// heading . g >= 0 for at least one nearest segment g of the reference path; strictly for each of them, and at least
/// 10^-14 (abs(g_x) + abs(g_y)).
fn heading_failure(
    scene: &Scene,
    point: &Point,
    path: &[Segment],
    place: &Beside,
) -> Option<Witness> {
    let (zero, reach) = (Real::zero(), scene.reads.nearly(&place.distance));
    // A closing segment of length 0 has no direction and is not asked.
    let along: Vec<[Real; 2]> = (path.iter().zip(&place.distances))
        .map(|([a, b], distance)| (b - a, distance))
        .filter(|(segment, distance)| **distance <= reach && segment.squared() > zero)
        .map(|(g, _)| {
            let least = Real::from_double(1e-14) * (g.x.abs() + g.y.abs());
            [point.pose.direction.dot(&g), scene.reads.m_at_least(least)]
        })
        .collect();
    let passes = scene.reads.some(&along, |[along, least]| along >= least);
    Witness::unless(passes, Rule::Direction, &along[0][0], &zero)
}

/// The trajectory starts now.
fn time_failure(scene: &Scene, start: &Point) -> Option<Witness> {
    let age_ns = -after_now_ns(scene, start);
    let max_age = i128::from(scene.parameters.max_age_ns);
    let (age, limit) = (Real::seconds(age_ns.abs()), Real::seconds(max_age));
    Witness::unless(age_ns.abs() <= max_age, Rule::StartTime, &age, &limit)
}

/// The first point that is farther from p than start_tolerance and what the CAV can drive by its time.
fn position_failure(scene: &Scene, trajectory: &[Point]) -> Option<Witness> {
    trajectory.iter().enumerate().find_map(|(i, point)| {
        let distance = point.pose.origin.distance(&scene.ego.position);
        let limit = &scene.parameters.start_tolerance + driven(scene, point);
        let passes = scene.reads.at_most(&distance, &limit);
        Some(Witness::unless(passes, Rule::Position, &distance, &limit)?.at_point(i))
    })
}

/// What the CAV can drive by the time t of a point: v_now abs(t) for t < 0, else v_now t + a_max t^2 / 2, m.
fn driven(scene: &Scene, point: &Point) -> Real {
    let t = Real::seconds(after_now_ns(scene, point));
    let steady = &scene.ego.v_now * t.abs();
    if t < Real::zero() {
        return steady;
    }
    steady + &scene.parameters.a_max * t.square() / Real::from_integer(2)
}

/// t, the time of a point after now: negative for a point before now.
fn after_now_ns(scene: &Scene, point: &Point) -> i128 {
    i128::from(point.t_ns) - i128::from(scene.now_ns)
}

/// The first heading and the CAV's have a positive dot product and abs(heading x heading) <= 0.17.
fn start_heading_failure(scene: &Scene, start: &Point) -> Option<Witness> {
    let (first, own) = (&start.pose.direction, &scene.ego.heading);
    let (along, zero) = (first.dot(own), Real::zero());
    let (turned, limit) = (first.cross(own).abs(), Real::from_double(0.17));
    let rule = Rule::StartHeading;
    Witness::unless(scene.reads.greater(&along, &zero), rule, &along, &zero)
        .or_else(|| Witness::unless(scene.reads.at_most(&turned, &limit), rule, &turned, &limit))
}

/// The distance at which the trajectory passes p is at most lateral_tolerance.
fn start_offset_failure(scene: &Scene, trajectory: &[Point]) -> Option<Witness> {
    let (passing, limit) =
        (passing_distance(scene, trajectory), &scene.parameters.lateral_tolerance);
    let passes = scene.reads.at_most(&passing, limit);
    Witness::unless(passes, Rule::StartOffset, &passing, limit)
}
