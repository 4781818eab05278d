//! Distances that a cycle looks ahead (`spec/3-stages.md#distances`), with error bounds.

use crate::cycle::Lead;
use crate::parameters::Parameters;
use crate::rounding::Real;

/// `s_CAV` = `safety_time` * `v_now`, m.
pub(crate) fn s_cav(parameters: &Parameters, v_now: f64) -> Real {
    Real::new(parameters.safety_time) * Real::new(v_now)
}

/// `s_b(v)` = v^2 / (2 `a_b`), m.
pub(crate) fn s_b(parameters: &Parameters, v: Real) -> Real {
    v.squared().over(Real::new(2.0 * parameters.a_b))
}

/// `s_follow` = max(`s_b(v_now)` - `s_b(v_lead)`, 0) + `s_CAV`, m.
pub(crate) fn s_follow(parameters: &Parameters, v_now: f64, v_lead: f64) -> Real {
    let longer = s_b(parameters, Real::new(v_now)) - s_b(parameters, Real::new(v_lead));
    longer.max(Real::ZERO) + s_cav(parameters, v_now)
}

/// `s_valid`: `s_follow` if there is a leading vehicle, else `s_b(v_now)`, m.
pub(crate) fn s_valid(parameters: &Parameters, v_now: f64, lead: Option<&Lead>) -> Real {
    match lead {
        Some(lead) => s_follow(parameters, v_now, lead.speed),
        None => s_b(parameters, Real::new(v_now)),
    }
}

/// H-04: `s_stop` = v tau + `a_max` tau^2/2 + (v + `a_max` tau)^2/(2 `a_b`), m.
pub(crate) fn s_stop(parameters: &Parameters, v_now: f64) -> Real {
    let (v, tau, a_max) =
        (Real::new(v_now), Real::new(parameters.tau), Real::new(parameters.a_max));
    let reaction = v * tau + a_max * tau.squared() * Real::new(0.5);
    reaction + s_b(parameters, v + a_max * tau)
}
