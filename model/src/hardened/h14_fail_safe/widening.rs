//! The widening: by how much the CAV is examined wider, where the trajectory passes beside p or is beyond its reach
//! (`spec/hardened/H-14.md#requirements-the-cav`).

use crate::hardened::h14_fail_safe::excess::{
    aside, is_aside, is_aside_or_turned, no_nodes, of_place, of_point,
};
use crate::hardened::h14_fail_safe::path::{ahead, first_ahead, places};
use crate::input::scene::{Point, Scene};
use crate::numbers::real::Real;

/// The greatest of the distance at which the trajectory passes p and of each excess of a point that is no node and of a
/// place other than p, m. It is at least 0, so what is on the line along h is not asked.
pub fn wider_by(scene: &Scene, trajectory: &[Point]) -> Real {
    let of_points =
        no_nodes(scene, trajectory).filter(|x| is_aside(scene, x)).map(|x| of_point(scene, x));
    let of_places = places(scene, trajectory)
        .skip(1)
        .filter(|place| is_aside_or_turned(scene, &place.pose))
        .map(|place| of_place(scene, &place.pose));
    of_points.chain(of_places).fold(passing_distance(scene, trajectory), Real::max)
}

/// The distance at which the trajectory passes p, m, from z and the point y before it: abs(a_y f_z - a_z f_y) / (f_z - f_y)
/// where f_y <= 0; 0 where f_y > 0 or one of them is not there.
pub fn passing_distance(scene: &Scene, trajectory: &[Point]) -> Real {
    let Some(first_node) = first_ahead(scene, trajectory) else { return Real::zero() };
    let (passed, nodes) = trajectory.split_at(first_node);
    let Some(Point { pose: y, .. }) = passed.last() else { return Real::zero() };
    let [f_y, f_z] = [y, &nodes[0].pose].map(|it| ahead(scene, &it.origin));
    if f_y > Real::zero() {
        return Real::zero();
    }
    let [a_y, a_z] = [y, &nodes[0].pose].map(|it| aside(scene, &it.origin));
    (a_y * &f_z - a_z * &f_y).abs() / (f_z - f_y)
}
