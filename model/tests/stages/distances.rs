//! `spec/3-stages.md#distances`

use mufasa_model::hardened::h04_horizon::s_stop;
use mufasa_model::input::cycle::Profile;
use mufasa_model::numbers::real::Real;
use mufasa_model::report::Stage;
use mufasa_model::services::configuration::Configuration::PlanRemote;
use mufasa_model::stages::distances::{s_b, s_cav, s_follow, s_valid};

use crate::base::*;

fn r(value: f64) -> Real {
    Real::from_double(value)
}

/// spec/3-stages.md#distances.1: the formulas on speeds >= 0, against values worked out by hand.
#[test]
fn distances_are_the_formulas() {
    assert_eq!(s_b(&r(16.0), &r(8.0)), r(16.0));
    assert_eq!(s_cav(&r(1.5), &r(16.0)), r(24.0));
    // max(16 - 4, 0) + 24, and max(4 - 16, 0) + 12.
    assert_eq!(s_follow(&r(16.0), &r(8.0), &r(8.0), &r(1.5)), r(36.0));
    assert_eq!(s_follow(&r(8.0), &r(16.0), &r(8.0), &r(1.5)), r(12.0));
    assert_eq!(s_valid(&r(16.0), Some(&r(8.0)), &r(8.0), &r(1.5)), r(36.0));
    assert_eq!(s_valid(&r(16.0), None, &r(8.0), &r(1.5)), r(16.0));
    // H-04: 2 + 16/4 + 4/32 + (16 + 1)^2 / 16
    assert_eq!(
        s_stop(&r(2.0), &r(16.0), &r(0.25), &r(4.0), &r(8.0)),
        r(2.0 + 4.0 + 0.125 + 18.0625)
    );
}

/// Published numbers of others: 100 km/h braked with 6 m/s^2 takes 64.3 m.
#[test]
fn s_b_is_the_known_braking_distance() {
    let v = Real::from_integer(100) / r(3.6);
    assert!((s_b(&v, &r(6.0)) - r(64.3)).abs() < r(0.01));
}

/// spec/3-stages.md#distances.2: a point at arc length exactly s is within, the first always.
#[test]
fn a_point_at_arc_length_s_is_within() {
    // s_CAV = 1.5 * 10 = 15 m: the car touches the CAV first at the point x.
    let touched_first_at = |x: f64| {
        let mut cycle = base(Profile::Paper, PlanRemote);
        cycle.parameters.safety_time = 1.5;
        cycle.tracks = tracks(vec![track(1, x + 4.0, 0.0)]);
        cycle
    };
    assert!(!passes(&touched_first_at(15.0), Stage::Iii));
    assert!(passes(&touched_first_at(16.0), Stage::Iii));
    // Nothing within but the first point.
    let mut cycle = touched_first_at(0.0);
    cycle.ego.speed = 0.0;
    assert!(!passes(&cycle, Stage::Iii));
    let mut cycle = touched_first_at(1.0);
    cycle.ego.speed = 0.0;
    assert!(passes(&cycle, Stage::Iii));
}

/// spec/3-stages.md#distances.2: the length is that of the polyline, not the distance.
#[test]
fn arc_length_is_that_of_the_polyline() {
    let mut cycle = base(Profile::Paper, PlanRemote);
    cycle.parameters.safety_time = 0.5;
    // 3-4-5 zigzag: each step is 1.25 m long and moves on by 1 m; 5 m end at the point x = 4.
    let points = &mut cycle.trajectory.as_mut().expect("there is one").points;
    for (i, point) in points.iter_mut().enumerate() {
        point.y = if i % 2 == 0 { 0.0 } else { 0.75 };
    }
    cycle.tracks = tracks(vec![track(1, 8.0, 0.0)]);
    assert_eq!(witness(&cycle, Stage::Iii).point, Some(4));
    cycle.tracks = tracks(vec![track(1, 8.5, 0.0)]);
    assert!(passes(&cycle, Stage::Iii));
}
