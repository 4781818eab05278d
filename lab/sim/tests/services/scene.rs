//! A road and vehicles for tests.

use mufasa::input::cycle::Ego;
use mufasa_sim::path::Path;
use mufasa_sim::pose::{Point, Pose, Rectangle};
use mufasa_sim::services::detectors::seen::Seen;

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
