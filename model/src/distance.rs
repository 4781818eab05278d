//! The distances that the stages look ahead (`spec/3-stages.md#distances`).

use crate::cycle::Profile;
use crate::real::Real;
use crate::scene::{Point, Scene};

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

/// H-04: s_stop = v tau + a_max tau^2 / 2 + (v + a_max tau)^2 / (2 a_b), m.
pub fn s_stop(v_now: &Real, tau: &Real, a_max: &Real, a_b: &Real) -> Real {
    v_now * tau + a_max * tau.square() / Real::from_integer(2) + s_b(&(v_now + a_max * tau), a_b)
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

/// The first points of the current trajectory, as many as a stage with the horizon `s` looks at:
/// those within `s`; hardened (H-04): those within max(s, s_stop) and the next one.
pub fn points_within<'a>(scene: &Scene, trajectory: &'a [Point], s: &Real) -> &'a [Point] {
    let within = |s: &Real| {
        let limit = s + &scene.m;
        let count = arc_lengths(trajectory).iter().filter(|length| **length <= limit).count();
        count.max(1)
    };
    match scene.profile {
        Profile::Paper => &trajectory[..within(s)],
        Profile::Hardened => {
            let p = &scene.parameters;
            let s_stop = s_stop(&scene.ego.v_now, &p.tau, &p.a_max, &p.a_b);
            let count = within(&s.max(&s_stop).clone()) + 1;
            &trajectory[..count.min(trajectory.len())]
        }
    }
}
