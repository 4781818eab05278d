//! `spec/3-stages.md#stage-ii-trajectory-to-map`

use mufasa_model::input::cycle::{CrossSection, Cycle, Profile, Route};
use mufasa_model::report::{Rule, Stage};
use mufasa_model::services::configuration::Configuration::{MotRemote, PlanRemote};

use crate::base::*;

fn with_point(index: usize, x: f64, y: f64) -> Cycle {
    let mut cycle = base(Profile::Paper, PlanRemote);
    cycle.parameters.theta_map = 0.25;
    let point = &mut cycle.trajectory.as_mut().expect("there is one").points[index];
    (point.x, point.y) = (x, y);
    cycle
}

fn narrow(mut cycle: Cycle) -> Cycle {
    for cross_section in &mut cycle.route.cross_sections {
        (cross_section.left[1], cross_section.right[1]) = (0.125, -0.125);
    }
    cycle
}

/// spec/3-stages.md#stage-ii-trajectory-to-map.3, I-03: farther than theta_map and outside; the
/// distance theta_map itself passes, the border of the corridor is inside.
#[test]
fn far_and_outside_fails() {
    assert!(passes(&with_point(20, 20.0, 3.0), Stage::Ii));
    assert!(!passes(&with_point(20, 20.0, 3.0f64.next_up()), Stage::Ii));
    assert!(passes(&narrow(with_point(20, 20.0, 0.25)), Stage::Ii));
    assert!(!passes(&narrow(with_point(20, 20.0, 0.25f64.next_up())), Stage::Ii));
    // The whole trajectory, the last point included.
    let found = witness(&with_point(50, 50.0, 4.0), Stage::Ii);
    assert_eq!((found.rule, found.point), (Rule::ThetaMap, Some(50)));
    assert_eq!(found.compared.map(f64::to_bits), [4.0, 0.25].map(f64::to_bits));
}

/// spec/3-stages.md#stage-ii-trajectory-to-map.1: distance to the polyline, at its ends to its
/// end points.
#[test]
fn distance_is_that_to_the_polyline() {
    let end = |x: f64, y: f64| {
        let mut cycle = narrow(with_point(50, x, y));
        cycle.route.cross_sections[1].x = 40.0;
        cycle.route.cross_sections[1].left[0] = 40.0;
        cycle.route.cross_sections[1].right[0] = 40.0;
        cycle.parameters.theta_map = 5.0;
        let points = &mut cycle.trajectory.as_mut().expect("there is one").points;
        points.drain(41..50);
        cycle
    };
    assert!(passes(&end(43.0, 4.0), Stage::Ii));
    assert!(!passes(&end(43.0f64.next_up(), 4.0), Stage::Ii));
}

/// spec/3-stages.md#stage-ii-trajectory-to-map.1, spec/3-stages.md#stage-ii-trajectory-to-map.2: a
/// closed route has a segment and a piece of corridor from the last cross section to the first.
#[test]
fn a_closed_route_has_a_closing_segment() {
    let cross_section =
        |x: f64, y: f64, l: [f64; 2], r: [f64; 2]| CrossSection { x, y, left: l, right: r };
    let cross_sections = vec![
        cross_section(100.0, 0.0, [100.0, 1.0], [100.0, -1.0]),
        cross_section(100.0, 100.0, [99.0, 99.0], [101.0, 101.0]),
        cross_section(-100.0, 100.0, [-99.0, 99.0], [-101.0, 101.0]),
        cross_section(-100.0, 0.0, [-100.0, 1.0], [-100.0, -1.0]),
    ];
    let mut cycle = base(Profile::Paper, PlanRemote);
    cycle.route = Route { closed: true, cross_sections };
    assert!(passes(&cycle, Stage::Ii));
    cycle.route.closed = false;
    assert!(!passes(&cycle, Stage::Ii));
}

/// spec/3-stages.md#stage-ii-trajectory-to-map.2: the diagonal goes from left_i to right_i+1.
#[test]
fn corridor_is_the_union_of_the_two_triangles() {
    // A quad that is not convex: right_1 is drawn in to the left. With the other diagonal the
    // point (70, -1) would be inside.
    let with = |x: f64, y: f64| {
        let mut cycle = with_point(20, x, y);
        cycle.route.cross_sections = vec![
            CrossSection { x: 0.0, y: 0.0, left: [0.0, 8.0], right: [0.0, -8.0] },
            CrossSection { x: 100.0, y: 0.0, left: [100.0, 8.0], right: [10.0, 2.0] },
        ];
        cycle
    };
    // Triangle (0,8) (0,-8) (10,2) and triangle (0,8) (10,2) (100,8).
    assert!(passes(&with(5.0, 1.0), Stage::Ii));
    assert!(!passes(&with(50.0, -0.5), Stage::Ii));
    assert!(passes(&with(40.0, 6.0), Stage::Ii));
    // On the edge that both share, and on a corner.
    assert!(passes(&with(5.0, 5.0), Stage::Ii));
    assert!(passes(&with(10.0, 2.0), Stage::Ii));
    assert!(!passes(&with(10.5, 2.0), Stage::Ii));
}

/// Stage ii runs in every remote configuration alike.
#[test]
fn map_is_compared_with_a_local_trajectory_too() {
    let mut cycle = base(Profile::Paper, MotRemote);
    cycle.trajectory.as_mut().expect("there is one").points[7].y = -3.5;
    assert_eq!(witness(&cycle, Stage::Ii).point, Some(7));
}
