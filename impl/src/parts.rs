//! Parts of the stages as functions of their own, for the proofs of `proofs/` alone: with the feature
//! `parts`, and no part of the interface.

use crate::input::parameters::Parameters;
use crate::stages::distances;

/// `s_b(v)` in plain doubles, m. Source: `spec/3-stages.md#distances`.
pub fn s_b(parameters: &Parameters, v: f64) -> f64 {
    distances::s_b(parameters, v)
}

/// `s_CAV` in plain doubles, m. Source: `spec/3-stages.md#distances`.
pub fn s_cav(parameters: &Parameters, v_now: f64) -> f64 {
    distances::s_cav(parameters, v_now)
}

/// `s_follow` in plain doubles, m. Source: `spec/3-stages.md#distances`.
pub fn s_follow(parameters: &Parameters, v_now: f64, v_lead: f64) -> f64 {
    distances::s_follow(parameters, v_now, v_lead)
}

/// `s_valid` in plain doubles, m. Source: `spec/3-stages.md#distances`.
pub fn s_valid(parameters: &Parameters, v_now: f64, v_lead: Option<f64>) -> f64 {
    distances::s_valid(parameters, v_now, v_lead)
}
