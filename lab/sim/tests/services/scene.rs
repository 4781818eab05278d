//! Roads, vehicles and observers for tests.

use core::f64::consts::TAU;

use mufasa::input::cycle::Ego;
use mufasa_sim::path::Path;
use mufasa_sim::pose::{Point, Pose, Rectangle};
use mufasa_sim::services::detectors::scan::Sweep;
use mufasa_sim::services::detectors::scene::Seen;
use mufasa_sim::services::detectors::{Detector, Errors, Mount, Observer};

/// A straight road of 80 m, a bend to the left with a radius, through an angle, and 200 m straight on.
pub fn bend(radius: f64, angle: f64) -> Path {
    let straight = (0..80).map(|x| Point::new(f64::from(x), 0.0));
    let steps = (radius * angle).ceil() as u32;
    let on_bend = |step: u32| {
        let (sin, cos) = libm::sincos(angle * f64::from(step) / f64::from(steps));
        Point::new(80.0 + radius * sin, radius * (1.0 - cos))
    };
    let (sin, cos) = libm::sincos(angle);
    let end = on_bend(steps);
    let rest = (1..=200).map(|step| {
        let way = f64::from(step);
        Point::new(end.x + way * cos, end.y + way * sin)
    });
    Path::new(straight.chain((0..=steps).map(on_bend)).chain(rest).collect()).expect("a path")
}

pub fn straight() -> Path {
    Path::new((0..400).map(|x| Point::new(f64::from(x), 0.0)).collect()).expect("a path")
}

pub fn ego_at(pose: Pose, speed: f64) -> Ego {
    let Pose { at, cos, sin } = pose;
    Ego { x: at.x, y: at.y, cos, sin, speed, length: 4.8, width: 1.9, center_offset: 1.4 }
}

pub fn pose_of(ego: &Ego) -> Pose {
    Pose { at: Point::new(ego.x, ego.y), cos: ego.cos, sin: ego.sin }
}

/// A car of 4.5 m by 1.8 m.
pub fn car(id: u32, pose: Pose, speed: f64) -> Seen {
    let velocity = Point::new(speed * pose.cos, speed * pose.sin);
    Seen { id, rectangle: Rectangle { pose, length: 4.5, width: 1.8 }, velocity }
}

/// Lidar, front radar: what a vehicle has.
pub fn vehicle(seed: u64, errors: Errors) -> Observer {
    let lidar = Detector { mount: Mount::Vehicle(1.4), sweep: Sweep::new(60.0, TAU, 720), errors };
    let radar = Detector { mount: Mount::Vehicle(3.8), sweep: Sweep::new(90.0, 0.7, 140), errors };
    Observer { seed: [seed, 1], detectors: vec![lidar, radar], merge_radius: 1.0 }
}
