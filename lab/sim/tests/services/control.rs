//! Control on trajectories that are given.

use core::f64::consts::PI;

use mufasa::input::cycle::TrajectoryPoint;
use mufasa_sim::pose::{Point, Pose};
use mufasa_sim::services::control::{Controller, Settings};
use mufasa_sim::vehicle::{Body, Motion};

use super::scene::ego_at;

const STEP_NS: i64 = 10_000_000;

fn start(pose: Pose, speed: f64) -> (Body, Controller, Motion) {
    let body = Body::default();
    let motion = Motion { rear: pose, speed, acceleration: 0.0, steering: 0.0 };
    (body, Controller::new(body, Settings::default()), motion)
}

/// Points on a circle to the left of radius 20 m at a constant speed, from the origin eastwards.
fn circle(speed: f64, count: i64) -> Vec<TrajectoryPoint> {
    let point = |index: i64| {
        let (sin, cos) = libm::sincos(speed * 0.1 * index as f64 / 20.0);
        TrajectoryPoint {
            t_ns: index * 100_000_000,
            x: 20.0 * sin,
            y: 20.0 * (1.0 - cos),
            cos,
            sin,
        }
    };
    (0..count).map(point).collect()
}

#[test]
fn it_tracks_a_circle_in_place_and_time() {
    let points = circle(6.0, 300);
    let (body, mut controller, mut motion) = start(Pose::new(Point::new(0.0, 0.5), 0.05), 5.0);
    for step in 0..2900 {
        let t_ns = step * STEP_NS;
        let command = controller.command(&ego_at(motion.rear, motion.speed), &points, t_ns);
        motion = body.step(&motion, command, 0.01);
        if step > 400 {
            let radius = motion.rear.at.distance(Point::new(0.0, 20.0));
            assert!((radius - 20.0).abs() < 0.1, "{step}: {radius}");
            let point = &points[usize::try_from((step + 1) / 10).expect("small")];
            let off = motion.rear.at.distance(Point::new(point.x, point.y));
            assert!(off < 0.9, "{step}: {off} m from where it is to be");
        }
    }
    assert!((motion.speed - 6.0).abs() < 0.1);
}

#[test]
fn it_stops_where_the_trajectory_stops() {
    let (body, mut controller, mut motion) = start(Pose::new(Point::default(), 0.0), 8.0);
    // 8 m/s down to 0 with 2 m/s2: 16 m in 4 s, and then it stays.
    let way = |t: f64| 8.0 * t.min(4.0) - t.min(4.0) * t.min(4.0);
    let point = |index: i64| {
        let x = way(0.1 * index as f64);
        TrajectoryPoint { t_ns: index * 100_000_000, x, y: 0.0, cos: 1.0, sin: 0.0 }
    };
    let points: Vec<_> = (0..80).map(point).collect();
    for step in 0..700 {
        let ego = ego_at(motion.rear, motion.speed);
        let command = controller.command(&ego, &points, step * STEP_NS);
        assert!(command.acceleration > -3.0);
        motion = body.step(&motion, command, 0.01);
    }
    assert!(motion.speed == 0.0 && (motion.rear.at.x - 16.0).abs() < 0.4, "{motion:?}");
}

#[test]
fn without_a_usable_trajectory_it_brakes_fully_along_the_last_one() {
    let points = circle(10.0, 40);
    let late = points.last().map(|point| point.t_ns + 1);
    for (then, t_ns) in [(&points[..0], 10 * STEP_NS), (&points[..], late.expect("points"))] {
        let (body, mut controller, mut motion) = start(Pose::new(Point::default(), 0.0), 10.0);
        for step in 0..10 {
            let ego = ego_at(motion.rear, motion.speed);
            let command = controller.command(&ego, &points, step * STEP_NS);
            motion = body.step(&motion, command, 0.01);
        }
        for _ in 0..130 {
            let ego = ego_at(motion.rear, motion.speed);
            let command = controller.command(&ego, then, t_ns);
            assert_eq!(command.acceleration, -8.0);
            motion = body.step(&motion, command, 0.01);
        }
        assert_eq!(motion.speed, 0.0);
        let radius = motion.rear.at.distance(Point::new(0.0, 20.0));
        assert!((radius - 20.0).abs() < 0.2 && motion.rear.angle() > 0.25, "{radius} {motion:?}");
    }
    // One that has never had a trajectory brakes straight on.
    let (_, mut controller, motion) = start(Pose::new(Point::default(), 0.0), 10.0);
    let command = controller.command(&ego_at(motion.rear, 10.0), &[], 0);
    assert_eq!((command.acceleration, command.steering), (-8.0, 0.0));
}

#[test]
fn commands_are_numbers_within_limits_whatever_the_points_are() {
    let (body, mut controller, motion) = start(Pose::new(Point::default(), PI), 10.0);
    let point = |t_ns, x, y| TrajectoryPoint { t_ns, x, y, cos: 1.0, sin: 0.0 };
    let lists = [
        vec![point(5, 0.0, 0.0)],
        vec![point(0, 0.0, 0.0), point(0, 5.0, 0.0), point(9, 5.0, 0.0)],
        vec![point(9, 1.0, 0.0), point(5, 0.0, 0.0), point(9, -1.0, 0.0)],
        vec![point(i64::MIN, 0.0, 0.0), point(i64::MAX, 1e7, 1e7)],
        vec![point(0, -1e7, 3.0), point(100, 1e7, 3.0)],
    ];
    for points in lists {
        let command = controller.command(&ego_at(motion.rear, 10.0), &points, 2);
        assert!((-8.0..=3.0).contains(&command.acceleration), "{points:?}: {command:?}");
        assert!(command.steering.abs() <= body.steering_max, "{points:?}: {command:?}");
    }
}
