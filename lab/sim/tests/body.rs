//! The ego's body: circles, stops, limits, commands that are no numbers.
#![allow(clippy::float_cmp, reason = "what is held to a limit is that limit")]

use mufasa_sim::map::streets;
use mufasa_sim::pose::{Point, Pose};
use mufasa_sim::scenario::Scenario;
use mufasa_sim::vehicle::{Body, Command};
use mufasa_sim::world::World;

#[test]
fn a_steady_wheel_drives_the_circle_of_the_formula() {
    let body = Body { steering_rate: 1e3, ..Body::default() };
    for steering in [0.3, -0.1, 0.02] {
        let mut motion = body.at(Pose::new(Point::new(3.0, -2.0), 0.7), 8.0);
        let start = motion.rear;
        // The rear axle drives on a circle of radius wheelbase / tan(steering) to its left.
        let radius = body.wheelbase / libm::tan(steering);
        let middle = start.ahead(0.0, radius);
        for step in 1..=1000 {
            motion = body.step(&motion, Command { acceleration: 0.0, steering }, 0.01);
            assert!(
                (motion.rear.at.distance(middle) - radius.abs()).abs() < 1e-9,
                "{steering} {step}"
            );
            let angle = 8.0 * 0.01 * f64::from(step) / radius;
            let there = start.turned(libm::cos(angle), libm::sin(angle));
            assert!(
                (motion.rear.cos - there.cos).abs() + (motion.rear.sin - there.sin).abs() < 1e-9
            );
        }
    }
}

#[test]
fn full_braking_stops_on_the_way_of_the_formula_and_stays() {
    let body = Body::default();
    let mut motion = body.at(Pose::new(Point::default(), 0.0), 13.0);
    let start = motion.rear.at;
    for _ in 0..500 {
        motion = body.step(&motion, Command { acceleration: -1e9, steering: 0.0 }, 0.01);
    }
    assert_eq!(motion.speed, 0.0);
    assert!((motion.rear.at.distance(start) - 13.0 * 13.0 / 16.0).abs() < 1e-9);
}

#[test]
fn a_command_that_is_no_number_brakes_and_holds_the_wheel() {
    let body = Body::default();
    let mut motion = body.at(Pose::new(Point::default(), 0.0), 10.0);
    motion.steering = 0.2;
    let nan = Command { acceleration: f64::NAN, steering: f64::NAN };
    let after = body.step(&motion, nan, 0.01);
    assert_eq!((after.acceleration, after.steering), (-8.0, 0.2));
    let wild = body.step(
        &motion,
        Command { acceleration: f64::INFINITY, steering: f64::NEG_INFINITY },
        0.01,
    );
    assert_eq!((wild.acceleration, wild.steering), (3.0, 0.2 - 0.6 * 0.01));
    // A world takes anything, too, and everything in it stays finite.
    let town = streets::town();
    let mut world = World::new(&town, &Scenario::draw(&town, 0, 10, 1), 1);
    for command in [nan, Command { acceleration: f64::INFINITY, steering: f64::INFINITY }] {
        for _ in 0..300 {
            world.step(command);
        }
        let ego = world.snapshot().ego;
        assert!(ego.rear.at.x.is_finite() && ego.speed.is_finite() && ego.s.is_finite());
    }
}
