//! The distances that the stages look ahead (`spec/3-stages.md#distances`).

use crate::input::profile::Profile;
use crate::input::scene::{Point, Scene};
use crate::numbers::real::Real;
use crate::numbers::vector::Frame;
use crate::services::configuration::Configuration;

/// s_CAV = safety_time v_now, m.
pub fn s_cav(safety_time: &Real, v_now: &Real) -> Real {
    safety_time * v_now
}

/// s_b = v^2 / (2 a_b), m.
pub fn s_b(v: &Real, a_b: &Real) -> Real {
    v.square() / (Real::from_integer(2) * a_b)
}

/// s_follow = max(s_b(v_now) - s_b(v_lead), 0) + s_CAV, m.
pub fn s_follow(v_now: &Real, v_lead: &Real, a_b: &Real, safety_time: &Real) -> Real {
    (s_b(v_now, a_b) - s_b(v_lead, a_b)).max(Real::zero()) + s_cav(safety_time, v_now)
}

/// s_valid = s_follow behind a leading vehicle, else s_b(v_now), m.
pub fn s_valid(v_now: &Real, v_lead: Option<&Real>, a_b: &Real, safety_time: &Real) -> Real {
    match v_lead {
        Some(v_lead) => s_follow(v_now, v_lead, a_b, safety_time),
        None => s_b(v_now, a_b),
    }
}

/// H-04: s_stop = e + v tau + a_max tau^2 / 2 + (v + a_max tau)^2 / (2 a_b), m.
pub fn s_stop(e: &Real, v_now: &Real, tau: &Real, a_max: &Real, a_b: &Real) -> Real {
    let reaction = v_now * tau + a_max * tau.square() / Real::from_integer(2);
    e + reaction + s_b(&(v_now + a_max * tau), a_b)
}

/// H-04: e = abs(p - first point): the CAV is not farther along the trajectory than that, m.
pub fn from_start(scene: &Scene, trajectory: &[Point]) -> Real {
    (&scene.ego.position - &trajectory[0].pose.origin).length()
}

/// s_stop of the scene, m.
pub fn scene_s_stop(scene: &Scene, trajectory: &[Point]) -> Real {
    let p = &scene.parameters;
    s_stop(&from_start(scene, trajectory), &scene.ego.v_now, &p.tau, &p.a_max, &p.a_b)
}

/// Length of the trajectory polyline from its first point to each point, m.
pub fn arc_lengths(trajectory: &[Point]) -> Vec<Real> {
    let mut lengths = vec![Real::zero()];
    for step in trajectory.windows(2) {
        let length = (&step[1].pose.origin - &step[0].pose.origin).length();
        lengths.push(lengths[lengths.len() - 1].clone() + length);
    }
    lengths
}

/// H-04: the way from the first point to each point, m: steps count as far as they lead along the
/// heading of their first point.
pub fn ways(trajectory: &[Point]) -> Vec<Real> {
    let mut ways = vec![Real::zero()];
    for step in trajectory.windows(2) {
        let u = &step[1].pose.origin - &step[0].pose.origin;
        let along = u.dot(&step[0].pose.direction).max(Real::zero());
        ways.push(ways[ways.len() - 1].clone() + along);
    }
    ways
}

/// The points that a stage with the horizon `s` examines: those within `s`; hardened (H-04): those
/// within max(s, s_stop), the next one, and the places beyond the end of a remote trajectory.
pub fn points_examined(scene: &Scene, trajectory: &[Point], s: &Real) -> Vec<Point> {
    let within = |lengths: Vec<Real>, s: &Real| {
        let limit = s + &scene.m;
        lengths.iter().filter(|length| **length <= limit).count().max(1)
    };
    match scene.profile {
        Profile::Paper => trajectory[..within(arc_lengths(trajectory), s)].to_vec(),
        Profile::Hardened => {
            let s_stop = scene_s_stop(scene, trajectory);
            let count = within(ways(trajectory), &s.max(&s_stop).clone()) + 1;
            let mut points = trajectory[..count.min(trajectory.len())].to_vec();
            if matches!(scene.configuration, Configuration::AllRemote | Configuration::PlanRemote) {
                points.extend(points_beyond(scene, trajectory, &s_stop));
            }
            points
        }
    }
}

/// H-04: where the trajectory ends before s_stop, its last point moved on, so that the CAV's centre
/// is at each multiple of 1/4 m from the pose, up to the first that is not below s_stop.
pub fn points_beyond(scene: &Scene, trajectory: &[Point], s_stop: &Real) -> Vec<Point> {
    let last = &trajectory[trajectory.len() - 1];
    let way = &ways(trajectory)[trajectory.len() - 1];
    let offset = &scene.ego.center_offset;
    let needed = offset + (s_stop + &scene.m - way);
    let mut quarters = (offset * Real::from_integer(4)).floor();
    let mut reached = offset.clone();
    let mut points = Vec::new();
    while reached < needed {
        quarters += 1;
        reached = Real::from_integer(quarters.into()) / Real::from_integer(4);
        let origin = last.pose.point(&(&reached - offset), &Real::zero());
        let pose = Frame { origin, direction: last.pose.direction.clone() };
        points.push(Point { t_ns: last.t_ns, pose });
    }
    points
}
