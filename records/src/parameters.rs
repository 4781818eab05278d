//! The `parameters` of records: defaults overridden by name (`spec/5-interfaces.md#cycle`).

use mufasa_model::input::parameters::Parameters;
use mufasa_model::report::InvalidInput;

use crate::walk::Value;

/// Reads the parameters of a cycle, whose domains the model checks. Those of the offloading
/// protocol may stand there too: they are checked, and mean nothing for a cycle.
pub fn of_cycle(value: Value<'_, '_>) -> Result<Parameters, InvalidInput> {
    let default = Parameters::default();
    let Some(value) = value.present() else {
        return Ok(default);
    };
    let [
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
        protocol @ ..,
    ] = value.object([
        "theta_tr",
        "theta_map",
        "theta_obj",
        "a_b",
        "safety_time",
        "max_age_ns",
        "n",
        "theta_track_max",
        "miss_budget",
        "tau",
        "a_max",
        "start_tolerance",
        "v_max",
        "step_max_ns",
        "theta_velocity",
        "work_limit",
        "delta",
        "t_wait_ns",
        "request_timeout_ns",
        "l_max_ns",
        "dt_max_ns",
    ])?;
    for parameter in protocol {
        nanos(parameter, 0)?;
    }
    Ok(Parameters {
        theta_tr: float(theta_tr, default.theta_tr)?,
        theta_map: float(theta_map, default.theta_map)?,
        theta_obj: float(theta_obj, default.theta_obj)?,
        a_b: float(a_b, default.a_b)?,
        safety_time: float(safety_time, default.safety_time)?,
        max_age_ns: integer(max_age_ns, default.max_age_ns)?,
        n: integer(n, default.n)?,
        theta_track_max: float(theta_track_max, default.theta_track_max)?,
        miss_budget: integer(miss_budget, default.miss_budget)?,
        tau: float(tau, default.tau)?,
        a_max: float(a_max, default.a_max)?,
        start_tolerance: float(start_tolerance, default.start_tolerance)?,
        v_max: float(v_max, default.v_max)?,
        step_max_ns: integer(step_max_ns, default.step_max_ns)?,
        theta_velocity: float(theta_velocity, default.theta_velocity)?,
        work_limit: integer(work_limit, default.work_limit)?,
        delta: float(delta, default.delta)?,
    })
}

/// A time in the domain of the offloading protocol, 0 to 2^63 - 1 ns; `default` when absent.
pub fn nanos(value: Value<'_, '_>, default: i64) -> Result<i64, InvalidInput> {
    let nanos = integer(value, default)?;
    if nanos < 0 {
        return Err(value.problem(format_args!("must be from 0 to 2^63 - 1 ns, not {nanos}")));
    }
    Ok(nanos)
}

fn float(value: Value<'_, '_>, default: f64) -> Result<f64, InvalidInput> {
    value.present().map_or(Ok(default), |value| value.float())
}

fn integer(value: Value<'_, '_>, default: i64) -> Result<i64, InvalidInput> {
    value.present().map_or(Ok(default), |value| value.integer())
}
