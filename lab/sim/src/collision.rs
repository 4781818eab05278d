//! Rectangles against rectangles, by parry.

use parry2d_f64::math::{Pose as Isometry, Rot2, Vector};
use parry2d_f64::query;
use parry2d_f64::shape::Cuboid;

use crate::pose::{Pose, Rectangle};

/// Distance between two rectangles, m; 0 when they touch or overlap.
pub fn distance(a: &Rectangle, b: &Rectangle) -> f64 {
    let ((p, q), (c, d)) = ((place(a), place(b)), (shape(a), shape(b)));
    match query::distance(&p, &c, &q, &d) {
        Ok(found) => found.distance,
        Err(error) => unreachable!("cuboids are supported: {error}"),
    }
}

/// Whether two rectangles share a point.
pub fn overlap(a: &Rectangle, b: &Rectangle) -> bool {
    let reach = (a.length + a.width + b.length + b.width) / 2.0;
    if a.pose.at.distance(b.pose.at) > reach {
        return false;
    }
    let ((p, q), (c, d)) = ((place(a), place(b)), (shape(a), shape(b)));
    match query::intersection_test(&p, &c, &q, &d) {
        Ok(found) => found.intersecting,
        Err(error) => unreachable!("cuboids are supported: {error}"),
    }
}

fn shape(rectangle: &Rectangle) -> Cuboid {
    Cuboid::new(Vector::new(rectangle.length / 2.0, rectangle.width / 2.0))
}

fn place(rectangle: &Rectangle) -> Isometry {
    let Pose { at, cos, sin } = rectangle.pose;
    Isometry::from_parts(Vector::new(at.x, at.y), Rot2::from_cos_sin_unchecked(cos, sin))
}
