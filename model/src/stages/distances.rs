//! The distances that the stages look ahead: paper Eq. (3) s_CAV, (4) s_b, (5) s_follow,
//! (6) s_valid (`spec/3-stages.md#distances`).

use crate::numbers::real::Real;

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
