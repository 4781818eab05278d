//! The excess: by how much the trajectory is farther aside than the CAV can be, or swings its front or its rear farther
//! aside (`spec/hardened/H-14.md#requirements-reach`).

use crate::hardened::h14_fail_safe::path::{ahead, first_ahead};
use crate::hardened::h14_fail_safe::times::Driving;
use crate::input::scene::{Point, Scene};
use crate::numbers::real::Real;
use crate::numbers::vector::{Frame, Vector};

/// That of a point x: abs(a_x) - f^2 / (2 R), m.
pub fn of_point(scene: &Scene, x: &Vector) -> Real {
    beyond_the_circle(scene, x, &f_and_turn(scene, x))
}

/// That of a place: the greater of that of its point and (abs(center_offset) + L/2) (abs(h x h_k) - f/R), m.
pub fn of_place(scene: &Scene, place: &Frame) -> Real {
    let (ego, Frame { origin: x, direction: h_k }) = (&scene.ego, place);
    let [f, turn] = f_and_turn(scene, x);
    let farthest = ego.center_offset.abs() + &ego.length / two();
    let swing = farthest * (ego.heading.cross(h_k).abs() - &turn);
    swing.max(beyond_the_circle(scene, x, &[f, turn]))
}

/// A point is not on the line through p along h. The excess of one that is, is at most 0.
pub fn is_aside(scene: &Scene, x: &Vector) -> bool {
    aside(scene, x) != Real::zero()
}

/// A place is not on the line through p along h with a heading along it. The excess of one that is, is at most 0.
pub fn is_aside_or_turned(scene: &Scene, place: &Frame) -> bool {
    is_aside(scene, &place.origin) || scene.ego.heading.cross(&place.direction) != Real::zero()
}

/// The points of the trajectory that are no nodes.
pub fn no_nodes<'a>(scene: &Scene, trajectory: &'a [Point]) -> impl Iterator<Item = &'a Vector> {
    let first_node = first_ahead(scene, trajectory).unwrap_or(trajectory.len());
    trajectory[..first_node].iter().map(|point| &point.pose.origin)
}

/// a_x = (x - p) x h, m: how far a point is aside of the line through p along h, to the right.
pub fn aside(scene: &Scene, x: &Vector) -> Real {
    (x - &scene.ego.position).cross(&scene.ego.heading)
}

/// f = abs(f_x), m, and f/R, by which the circle has turned there.
fn f_and_turn(scene: &Scene, x: &Vector) -> [Real; 2] {
    let f = ahead(scene, x).abs();
    let turn = &f / radius(scene, &f);
    [f, turn]
}

/// abs(a_x) - f^2 / (2 R), m: by how much a point is farther aside than the circle leads.
fn beyond_the_circle(scene: &Scene, x: &Vector, [f, turn]: &[Real; 2]) -> Real {
    aside(scene, x).abs() - f * turn / two()
}

/// R = max(3 m, u^2 / (11.5 m/s^2)), m, with u = max(v - a_b f/v, v/2), and 3 m where v is 0: the CAV, braking with a_b,
/// can drive no smaller circle up to f.
fn radius(scene: &Scene, f: &Real) -> Real {
    let Driving { v, a_b, .. } = Driving::of(scene);
    let least = Real::from_integer(3);
    if *v == Real::zero() {
        return least;
    }
    let u = (v - a_b * f / v).max(v / two());
    least.max(u.square() / Real::from_double(11.5))
}

fn two() -> Real {
    Real::from_integer(2)
}
