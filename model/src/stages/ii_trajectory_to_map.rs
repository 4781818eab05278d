//! Stage ii: trajectory to map (`spec/3-stages.md#stage-ii-trajectory-to-map`, H-07).

use crate::hardened::trajectory_rules::{end_failure, start_failure, step_failure};
use crate::input::profile::Profile;
use crate::input::scene::{Corridor, Point, Scene};
use crate::numbers::polygon::{Triangle, contains_point, square, union_contains, union_meets};
use crate::numbers::real::Real;
use crate::numbers::vector::Vector;
use crate::report::{Reading, Rule, Witness};

/// Compares the whole trajectory with the route; `None` passes.
pub fn map_validation(scene: &Scene, trajectory: &[Point]) -> Option<Witness> {
    let corridor = corridor(&scene.route);
    let places: Vec<Place> = trajectory.iter().map(|point| Place::of(scene, point)).collect();
    let inside = |place: &Place| is_inside(scene, &corridor, place.position);
    let at = |rule: Rule, failure: &dyn Fn(&Place) -> Option<(Real, Real)>| {
        places.iter().enumerate().find_map(|(i, place)| {
            failure(place).map(|(left, right)| Witness {
                point: Some(i),
                segment: Some(place.nearest),
                ..Witness::new(rule, &left, &right)
            })
        })
    };
    let theta_map = &scene.parameters.theta_map;
    let too_far = at(Rule::ThetaMap, &|place| {
        let fails = place.distance > theta_map - &scene.m && !inside(place);
        fails.then(|| (place.distance.clone(), theta_map.clone()))
    });
    if scene.profile == Profile::Paper || too_far.is_some() {
        return too_far;
    }
    start_failure(scene, trajectory)
        .or_else(|| {
            at(Rule::Corridor, &|place| {
                (!inside(place)).then(|| (place.distance.clone(), Real::zero()))
            })
        })
        .or_else(|| at(Rule::Direction, &|place| place.heading_failure(scene)))
        .or_else(|| step_failure(scene, trajectory))
        .or_else(|| end_failure(scene, trajectory))
}

/// A segment of the reference polyline; a closed route has one from its last to its first cross section.
fn segments(route: &Corridor) -> Vec<[&[Vector; 3]; 2]> {
    let cross_sections = &route.cross_sections;
    let mut segments: Vec<_> = cross_sections.windows(2).map(|pair| [&pair[0], &pair[1]]).collect();
    if route.closed {
        segments.push([&cross_sections[cross_sections.len() - 1], &cross_sections[0]]);
    }
    segments
}

/// The union of (left_i, right_i, right_i+1) and (left_i, right_i+1, left_i+1).
fn corridor(route: &Corridor) -> Vec<Triangle> {
    let quads = segments(route).into_iter();
    quads
        .flat_map(|[[_, left, right], [_, next_left, next_right]]| {
            [
                [left.clone(), right.clone(), next_right.clone()],
                [left.clone(), next_right.clone(), next_left.clone()],
            ]
        })
        .collect()
}

/// Where a trajectory point lies on the route.
struct Place<'a> {
    position: &'a Vector,
    /// Distance to the reference path.
    distance: Real,
    /// The first segment at that distance.
    nearest: usize,
    /// heading . segment for every segment that H-07 asks.
    along: Vec<Real>,
}

/// In the corridor; strictly or laxly in those readings.
fn is_inside(scene: &Scene, corridor: &[Triangle], position: &Vector) -> bool {
    let square = || square(position, &scene.parameters.delta);
    match scene.reading {
        Reading::Exact => corridor.iter().any(|triangle| contains_point(triangle, position)),
        Reading::Strict => union_contains(corridor, &square()),
        Reading::Lax => union_meets(corridor, &square()),
    }
}

impl<'a> Place<'a> {
    fn of(scene: &Scene, point: &'a Point) -> Self {
        let position = &point.pose.origin;
        let segments: Vec<_> = segments(&scene.route)
            .into_iter()
            .map(|[a, b]| (distance_to_segment(position, &a[0], &b[0]), &b[0] - &a[0]))
            .collect();
        let distances = segments.iter().map(|(distance, _)| distance).enumerate();
        let (nearest, distance) = distances
            .min_by(|(_, a), (_, b)| a.cmp(b))
            .map(|(nearest, distance)| (nearest, distance.clone()))
            .expect("a route has at least two stations");
        let reach = match scene.reading {
            Reading::Exact => distance.clone(),
            Reading::Strict | Reading::Lax => &distance + &scene.parameters.delta,
        };
        // A closing segment of length 0 has no direction and is not asked.
        let along = (segments.iter())
            .filter(|(distance, segment)| *distance <= reach && segment.squared() > Real::zero())
            .map(|(_, segment)| point.pose.direction.dot(segment))
            .collect();
        Self { position, distance, nearest, along }
    }

    /// H-07: heading . segment >= 0 for at least one nearest segment.
    fn heading_failure(&self, scene: &Scene) -> Option<(Real, Real)> {
        let forward = |along: &Real| *along >= scene.m;
        let passes = match scene.reading {
            Reading::Exact | Reading::Lax => self.along.iter().any(forward),
            Reading::Strict => self.along.iter().all(forward),
        };
        (!passes).then(|| (self.along[0].clone(), Real::zero()))
    }
}

/// Distance of a point to the closed segment from a to b.
fn distance_to_segment(point: &Vector, a: &Vector, b: &Vector) -> Real {
    let (segment, offset) = (b - a, point - a);
    let along = segment.dot(&offset);
    let squared = segment.squared();
    if along <= Real::zero() {
        offset.length()
    } else if along >= squared {
        (point - b).length()
    } else {
        (segment.cross(&offset).square() / squared).sqrt()
    }
}
