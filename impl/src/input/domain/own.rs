//! The CAV's own numbers: parameters, pose, speed and size (`spec/4-arithmetic.md#domain`).

use super::{ANY, Check, HORIZON_NS, POSITION, Place, SIZE, SPEED};
use crate::input::cycle::Ego;
use crate::input::parameters::Parameters;

pub(super) fn check_parameters(parameters: &Parameters) -> Check {
    let Parameters {
        theta_tr,
        theta_map,
        theta_obj,
        a_b,
        safety_time,
        max_age_ns,
        n,
        theta_track_max,
        miss_budget,
        tau,
        a_max,
        start_tolerance,
        v_max,
        step_max_ns,
        theta_velocity,
        work_limit,
        delta,
    } = *parameters;
    let at = Place { index: None };
    let threshold = [1e-3, 1e3];
    let above_zero = [f64::from_bits(1), 1e3];
    at.number("parameters.theta_tr", theta_tr, threshold)?;
    at.number("parameters.theta_map", theta_map, threshold)?;
    at.number("parameters.theta_obj", theta_obj, threshold)?;
    at.number("parameters.a_b", a_b, [0.1, 100.0])?;
    at.number("parameters.safety_time", safety_time, [0.0, 60.0])?;
    at.integer("parameters.max_age_ns", max_age_ns, [0, HORIZON_NS])?;
    at.integer("parameters.n", n, [1, 64])?;
    at.number("parameters.theta_track_max", theta_track_max, threshold)?;
    at.integer("parameters.miss_budget", miss_budget, [0, 64])?;
    at.number("parameters.tau", tau, [0.0, 60.0])?;
    at.number("parameters.a_max", a_max, [0.1, 100.0])?;
    at.number("parameters.start_tolerance", start_tolerance, threshold)?;
    at.number("parameters.v_max", v_max, above_zero)?;
    at.integer("parameters.step_max_ns", step_max_ns, [0, HORIZON_NS])?;
    at.number("parameters.theta_velocity", theta_velocity, above_zero)?;
    at.integer("parameters.work_limit", work_limit, [0, i64::MAX])?;
    at.number("parameters.delta", delta, [1e-8, 1e-2])
}

pub(super) fn check_ego(ego: &Ego) -> Check {
    let at = Place { index: None };
    at.number("ego.x", ego.x, POSITION)?;
    at.number("ego.y", ego.y, POSITION)?;
    at.number("ego.cos", ego.cos, ANY)?;
    at.number("ego.sin", ego.sin, ANY)?;
    at.direction("ego.cos", ego.cos, ego.sin)?;
    at.number("ego.speed", ego.speed, SPEED)?;
    at.number("ego.length", ego.length, SIZE)?;
    at.number("ego.width", ego.width, SIZE)?;
    at.number("ego.center_offset", ego.center_offset, [-100.0, 100.0])
}
