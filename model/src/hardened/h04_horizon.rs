//! H-04: stages iii, iv and v look as far as the CAV needs to stop.

use crate::input::scene::{Point, Scene};
use crate::numbers::real::Real;
use crate::numbers::vector::Frame;
use crate::services::configuration::Configuration;
use crate::stages::distances::s_b;

/// s_stop = e + v tau + a_max tau^2 / 2 + (v + a_max tau)^2 / (2 a_b), m.
pub fn s_stop(e: &Real, v_now: &Real, tau: &Real, a_max: &Real, a_b: &Real) -> Real {
    let reaction = v_now * tau + a_max * tau.square() / Real::from_integer(2);
    e + reaction + s_b(&(v_now + a_max * tau), a_b)
}

/// s_stop with e = abs(p - first point): the CAV is not farther along the trajectory than that, m.
pub fn s_stop_along(scene: &Scene, trajectory: &[Point]) -> Real {
    let e = scene.ego.position.distance(&trajectory[0].pose.origin);
    let p = &scene.parameters;
    s_stop(&e, &scene.ego.v_now, &p.tau, &p.a_max, &p.a_b)
}

/// The way from the first point to each point, m: the sum of max(u . heading, 0) over the steps u up
/// to it, the heading being that of the step's first point.
pub fn ways(trajectory: &[Point]) -> Vec<Real> {
    let mut ways = vec![Real::zero()];
    for step in trajectory.windows(2) {
        let u = &step[1].pose.origin - &step[0].pose.origin;
        let along = u.dot(&step[0].pose.direction).max(Real::zero());
        ways.push(ways[ways.len() - 1].clone() + along);
    }
    ways
}

/// The points with way <= max(s, s_stop), the next one, and the places beyond the end of a remote
/// trajectory.
pub fn points_to_s_stop(scene: &Scene, trajectory: &[Point], s: &Real) -> Vec<Point> {
    let s_stop = s_stop_along(scene, trajectory);
    let horizon = s.max(&s_stop);
    let within = |way: &&Real| scene.reads.may_be_at_most(way, horizon);
    let count = ways(trajectory).iter().filter(within).count().max(1) + 1;
    let mut points = trajectory[..count.min(trajectory.len())].to_vec();
    if matches!(scene.configuration, Configuration::AllRemote | Configuration::PlanRemote) {
        points.extend(points_beyond(scene, trajectory, &s_stop));
    }
    points
}

/// Where the trajectory ends before s_stop, its last point moved on, so that the CAV's centre is at
/// each multiple of 1/4 m from the pose, up to the first that is not below s_stop.
fn points_beyond(scene: &Scene, trajectory: &[Point], s_stop: &Real) -> Vec<Point> {
    let last = &trajectory[trajectory.len() - 1];
    let way = &ways(trajectory)[trajectory.len() - 1];
    let offset = &scene.ego.center_offset;
    let end = offset + (s_stop - way);
    let mut quarters = (offset * Real::from_integer(4)).floor();
    let mut reached = offset.clone();
    let mut points = Vec::new();
    while scene.reads.may_be_less(&reached, &end) {
        quarters += 1;
        reached = Real::from_integer(quarters.into()) / Real::from_integer(4);
        let origin = last.pose.point(&(&reached - offset), &Real::zero());
        let pose = Frame { origin, direction: last.pose.direction.clone() };
        points.push(Point { t_ns: last.t_ns, pose });
    }
    points
}
