//! The widening: by how much the trajectory is farther aside than the CAV can be, where it passes p and at the nodes
//! up to a length of s_b(v) (`spec/hardened/H-14.md#requirements-the-cav`).

use crate::hardened::h14_fail_safe::path::{ahead, first_ahead, nodes_behind_p};
use crate::hardened::h14_fail_safe::times::Driving;
use crate::input::scene::{Point, Scene};
use crate::numbers::real::Real;
use crate::numbers::vector::Vector;

/// The greatest of the distance at which the trajectory passes p and, for z and each node x after z whose length is
/// below s_b(v), of abs(a_x) - f^2 / (2 R), m.
pub fn wider_by(scene: &Scene, trajectory: &[Point]) -> Real {
    let nodes = nodes_behind_p(scene, trajectory);
    let s_b = Driving::of(scene).s_b();
    let is_asked = |(i, (_, length)): &(usize, &(Vector, Real))| {
        *i == 0 || scene.reads.may_be_less(length, &s_b)
    };
    // What is on the line through p along h is no farther aside than any circle leads.
    let is_aside = |(_, (x, _)): &(usize, &(Vector, Real))| aside(scene, x) != Real::zero();
    let asked = nodes.iter().enumerate().filter(is_aside).filter(is_asked);
    asked
        .map(|(_, (x, _))| beyond_the_circle(scene, x))
        .fold(passing_distance(scene, trajectory), Real::max)
}

/// The distance at which the trajectory passes p, m, from z and the point y before it: abs(a_y f_z - a_z f_y) / (f_z - f_y),
/// or abs(a_y) where f_y > 0; without z abs(a_x) of the first point; 0 where z is the first point.
pub fn passing_distance(scene: &Scene, trajectory: &[Point]) -> Real {
    let Some(first_node) = first_ahead(scene, trajectory) else {
        return aside(scene, &trajectory[0].pose.origin).abs();
    };
    let (passed, nodes) = trajectory.split_at(first_node);
    let Some(Point { pose: y, .. }) = passed.last() else { return Real::zero() };
    let [f_y, a_y] = [ahead(scene, &y.origin), aside(scene, &y.origin)];
    if f_y > Real::zero() {
        return a_y.abs();
    }
    let z = &nodes[0].pose;
    let [f_z, a_z] = [ahead(scene, &z.origin), aside(scene, &z.origin)];
    (a_y * &f_z - a_z * &f_y).abs() / (f_z - f_y)
}

/// abs(a_x) - f^2 / (2 R) with f = max(f_x, 0), m: by how much a point is farther aside than a circle of the radius R
/// leads.
fn beyond_the_circle(scene: &Scene, x: &Vector) -> Real {
    let f = ahead(scene, x).max(Real::zero());
    aside(scene, x).abs() - f.square() / (Real::from_integer(2) * radius(scene, &f))
}

/// R = max(3 m, u^2 / (11.5 m/s^2)), m, with u = max(v - a_b f/v, v/2), and 3 m where v is 0: the CAV, braking with a_b,
/// can drive no smaller circle up to f.
fn radius(scene: &Scene, f: &Real) -> Real {
    let Driving { v, a_b, .. } = Driving::of(scene);
    let least = Real::from_integer(3);
    if *v == Real::zero() {
        return least;
    }
    let u = (v - a_b * f / v).max(v / Real::from_integer(2));
    least.max(u.square() / Real::from_double(11.5))
}

/// a_x = (x - p) x h, m: how far a point is aside of the line through p along h, to the right.
fn aside(scene: &Scene, x: &Vector) -> Real {
    (x - &scene.ego.position).cross(&scene.ego.heading)
}
