//! Plans: what they stop before, what they keep from, and how well they follow the path.

use core::f64::consts::FRAC_PI_2;

use mufasa::input::cycle::Track;
use mufasa_sim::pose::{Point, Pose};

use super::drive::{Drive, LIMIT};
use super::scene::{pose_of, straight};

fn track(id: i64, pose: Pose, speed: f64) -> Track {
    let Pose { at, cos, sin } = pose;
    let (vx, vy) = (speed * cos, speed * sin);
    Track { id, x: at.x, y: at.y, cos, sin, vx, vy, length: 4.5, width: 1.8 }
}

fn at(x: f64, y: f64) -> Pose {
    Pose::new(Point::new(x, y), 0.0)
}

/// Free distance from the front of the ego to the rear of a car, along x.
fn gap(drive: &Drive<'_>, car: &Track) -> f64 {
    car.x - 2.25 - (drive.motion.rear.at.x + 3.8)
}

#[test]
fn it_stops_behind_what_stands_wherever_physics_allows() {
    let path = straight();
    let mut tried = 0;
    for speed in [0.0, 1.0, 3.0, 6.0, 9.0, 12.0, LIMIT] {
        for distance in [2.0, 4.0, 6.0, 9.0, 13.0, 18.0, 25.0, 40.0, 60.0, 85.0] {
            // Full braking, the cycle in which the plan is made, and half a metre.
            if distance < speed * speed / 16.0 + 0.05 * speed + 0.5 {
                continue;
            }
            tried += 1;
            let mut drive = Drive::new(&path, at(10.0, 0.0), speed);
            let car = track(1, at(10.0 + 3.8 + distance + 2.25, 0.0), 0.0);
            for _ in 0..600 {
                let points = drive.plan(&[car]);
                drive.follow(&points);
                assert!(gap(&drive, &car) > 0.05, "hit from {speed} m/s, {distance} m");
            }
            assert!(drive.motion.speed < 0.1, "{speed} {distance}: {}", drive.motion.speed);
            // It has come near, and stands still at a distance.
            let rest = gap(&drive, &car);
            assert!(rest < 4.5, "{speed} {distance}: {rest}");
        }
    }
    assert!(tried > 45, "{tried}");
}

#[test]
fn it_keeps_s_follow_behind_a_lead_that_drives_and_stops() {
    let path = straight();
    for lead_speed in [0.0, 2.0, 5.0, 8.0, 11.0, 13.0] {
        let mut drive = Drive::new(&path, at(10.0, 0.0), LIMIT);
        let mut car = track(1, at(100.0, 0.0), lead_speed);
        let (mut least, mut now) = (f64::INFINITY, lead_speed);
        for cycle in 0..700 {
            // After ten seconds it brakes to a halt.
            if cycle > 200 {
                now = (now - 2.0 * 0.05_f64).max(0.0);
            }
            car = track(1, at(car.x + now * 0.05, 0.0), now);
            let points = drive.plan(&[car]);
            drive.follow(&points);
            let speed = drive.motion.speed;
            let s_follow = ((speed * speed - now * now) / 16.0).max(0.0) + 1.8 * speed;
            least = least.min(gap(&drive, &car) - s_follow);
        }
        assert!(least > 0.5, "behind {lead_speed} m/s: {least}");
        assert!(drive.motion.speed < 0.5);
    }
}

#[test]
fn it_gives_way_to_who_crosses_and_goes_on_behind_it() {
    let path = straight();
    let (mut stood_back, mut tried) = (0, 0);
    for speed in [4.0, 8.0, LIMIT] {
        for delay in 0..16 {
            tried += 1;
            let mut drive = Drive::new(&path, at(10.0, 0.0), speed);
            let start = 80.0;
            let crossing = |t: f64| {
                let y = -8.0 * (0.5 * f64::from(delay) + 2.0) + 8.0 * t;
                track(1, Pose::new(Point::new(start, y), FRAC_PI_2), 8.0)
            };
            let mut slowest = LIMIT;
            for cycle in 0..400 {
                let other = crossing(0.05 * f64::from(cycle));
                let points = drive.plan(&[other]);
                drive.follow(&points);
                let (ahead, left) = pose_of(&drive.ego()).local(Point::new(other.x, other.y));
                let apart = (ahead - 1.4).abs() > 2.4 + 0.9 || left.abs() > 0.95 + 2.25;
                assert!(apart, "{speed} m/s, delay {delay}: hit");
                slowest = slowest.min(drive.motion.speed);
            }
            assert!(drive.motion.rear.at.x > 120.0, "{speed} {delay}: it went on");
            stood_back += i32::from(slowest < 0.8 * speed);
        }
    }
    assert!(stood_back > 3 && stood_back < tried, "{stood_back} of {tried}");
}
