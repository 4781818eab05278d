//! `spec/3-stages.md#low-level-collision-check-llcc`, `spec/3-stages.md#stage-iii-trajectory-with-tracks`

use mufasa_model::input::cycle::{Cycle, Profile, Track};
use mufasa_model::report::Stage;
use mufasa_model::services::configuration::Configuration::PlanRemote;

use crate::base::*;

fn with(track: Track) -> Cycle {
    let mut cycle = base(Profile::Paper, PlanRemote);
    cycle.tracks = tracks(vec![track]);
    cycle
}

/// Stage iii on the first point alone: speed 0, so s_CAV is 0.
fn standing_with(track: Track) -> Cycle {
    let mut cycle = with(track);
    cycle.ego.speed = 0.0;
    cycle
}

/// spec/3-stages.md#low-level-collision-check-llcc.1, I-03: examined when the centres are closer
/// than theta_obj; a truck whose centre is 5 m away is not looked at (F-03).
#[test]
fn examined_when_closer_than_theta_obj() {
    let truck = |x: f64| Track { length: 12.0, ..track(1, x, 0.0) };
    assert!(!passes(&standing_with(truck(5.0f64.next_down())), Stage::Iii));
    assert!(passes(&standing_with(truck(5.0)), Stage::Iii));
}

/// spec/3-stages.md#low-level-collision-check-llcc.1: the centre of the CAV's rectangle, not the
/// pose, is compared and compared with.
#[test]
fn the_rectangle_is_shifted_by_center_offset() {
    let mut cycle = standing_with(track(1, 6.5, 0.0));
    assert!(passes(&cycle, Stage::Iii));
    cycle.ego.center_offset = 2.5;
    assert_eq!(witness(&cycle, Stage::Iii).compared[0].to_bits(), 4.0f64.to_bits());
    let point = &mut cycle.trajectory.as_mut().expect("there is one").points[0];
    (point.cos, point.sin) = (-1.0, 0.0);
    assert!(passes(&cycle, Stage::Iii));
}

/// spec/3-stages.md#low-level-collision-check-llcc.2, I-03: touching rectangles collide.
#[test]
fn touching_is_a_collision() {
    assert!(!passes(&standing_with(track(1, 4.0, 0.0)), Stage::Iii));
    assert!(passes(&standing_with(track(1, 4.0f64.next_up(), 0.0)), Stage::Iii));
    assert!(!passes(&standing_with(track(1, 4.0, 2.0)), Stage::Iii), "corner to corner");
    assert!(passes(&standing_with(track(1, 4.0, 2.0f64.next_up())), Stage::Iii));
}

/// spec/3-stages.md#low-level-collision-check-llcc.2: rotated rectangles; bounding circles and
/// axis-parallel boxes would say otherwise.
#[test]
fn rotated_rectangles_are_compared_exactly() {
    // Direction (0.6, 0.8): half length 2 along it, half width 1 across. Its corner nearest to the
    // CAV's corner (2, 1) lies at centre - 2 (0.6, 0.8) + (0.8, -0.6) = centre - (0.4, 2.2).
    let rotated = |x: f64, y: f64| Track { cos: 0.6, sin: 0.8, ..track(1, x, y) };
    assert!(!passes(&standing_with(rotated(2.0, 3.0)), Stage::Iii));
    assert!(passes(&standing_with(rotated(2.0, 3.3)), Stage::Iii));
    assert!(passes(&standing_with(rotated(3.9, 2.2)), Stage::Iii), "their boxes overlap");
}

/// spec/3-stages.md#stage-iii-trajectory-with-tracks.1: predicted by v (t_point - stamp).
#[test]
fn tracks_are_predicted_with_constant_velocity() {
    // Crosses the path at x = 10 at the time of point 10, one second from now.
    let crossing = Track { vy: 10.0, ..track(1, 10.0, -10.0) };
    let found = witness(&with(crossing.clone()), Stage::Iii);
    assert_eq!((found.point, found.track), (Some(8), Some(1)));
    // Two seconds earlier it is long gone.
    let mut gone = with(crossing);
    gone.tracks.as_mut().expect("there are").stamp_ns = NOW - 100_000_000;
    gone.tracks.as_mut().expect("there are").items[0].y = 10.5;
    assert!(passes(&gone, Stage::Iii));
}

/// spec/3-stages.md#stage-iii-trajectory-with-tracks.1: a point before the stamp predicts backwards.
#[test]
fn prediction_goes_backwards_in_time_too() {
    let mut cycle = standing_with(Track { vx: 50.0, ..track(1, 8.0, 0.0) });
    let points = &mut cycle.trajectory.as_mut().expect("there is one").points;
    points[0].t_ns = NOW - 80_000_000;
    assert!(!passes(&cycle, Stage::Iii), "80 ms before its stamp it was at 4 m");
    cycle.tracks.as_mut().expect("there are").items[0].vx = 49.0;
    assert!(passes(&cycle, Stage::Iii));
}

/// spec/3-stages.md#stage-iii-trajectory-with-tracks.2: only points within s_CAV count.
#[test]
fn points_beyond_s_cav_do_not_count() {
    assert!(!passes(&with(track(1, 22.0, 0.0)), Stage::Iii), "touched at 18 m = s_CAV");
    assert!(passes(&with(track(1, 23.0, 0.0)), Stage::Iii));
}
