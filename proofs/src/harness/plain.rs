//! The distances in plain doubles (`spec/3-stages.md#distances`).

use mufasa::input::parameters::Parameters;
use mufasa::parts::{s_b, s_cav, s_follow, s_valid};

use super::any::within;
#[cfg(not(kani))]
use crate::kani;

/// The longest distances of `spec/4-arithmetic.md#domain`: 150^2 / (2 * 0.1) m and 60 * 150 m.
const LONGEST_BRAKING: f64 = 112_500.0;
const LONGEST_CAV: f64 = 9_000.0;

/// x
///
/// Domain: all
#[cfg_attr(kani, kani::proof)]
pub fn verify_s_b_is_bounded() {
    let s_b = s_b(&parameters(), speed());
    assert!(0.0 <= s_b && s_b <= LONGEST_BRAKING);
    kani::cover!(s_b > 0.0, "moving");
    kani::cover!(s_b <= 0.0, "standing");
}

/// x
///
/// Domain: all
#[cfg_attr(kani, kani::proof)]
pub fn verify_s_cav_is_bounded() {
    let s_cav = s_cav(&parameters(), speed());
    assert!(0.0 <= s_cav && s_cav <= LONGEST_CAV);
    kani::cover!(s_cav > 0.0, "moving");
}

/// x
///
/// Domain: all
#[cfg_attr(kani, kani::proof)]
pub fn verify_s_follow_is_at_least_s_cav() {
    let (parameters, v_now, v_lead) = (parameters(), speed(), speed());
    let (s_follow, s_cav) = (s_follow(&parameters, v_now, v_lead), s_cav(&parameters, v_now));
    assert!(s_follow >= s_cav);
    kani::cover!(s_follow > s_cav, "longer than s_CAV");
}

/// x
///
/// Domain: all
#[cfg_attr(kani, kani::proof)]
pub fn verify_s_follow_is_bounded() {
    let s_follow = s_follow(&parameters(), speed(), speed());
    assert!(0.0 <= s_follow && s_follow <= LONGEST_BRAKING + LONGEST_CAV);
    kani::cover!(s_follow > 0.0, "moving");
}

/// x
///
/// Domain: all
#[cfg_attr(kani, kani::proof)]
pub fn verify_s_follow_behind_an_equally_fast_lead() {
    let (parameters, v_now) = (parameters(), speed());
    let (s_follow, s_cav) = (s_follow(&parameters, v_now, v_now), s_cav(&parameters, v_now));
    assert!(s_follow <= s_cav && s_follow >= s_cav);
    kani::cover!(s_follow > 0.0, "moving");
}

/// x
///
/// Domain: all
#[cfg_attr(kani, kani::proof)]
pub fn verify_s_follow_behind_a_faster_lead() {
    let (parameters, v_now, v_lead) = (parameters(), speed(), speed());
    kani::assume(v_lead >= v_now);
    let (s_follow, s_cav) = (s_follow(&parameters, v_now, v_lead), s_cav(&parameters, v_now));
    assert!(s_follow <= s_cav);
    kani::cover!(s_follow > 0.0, "moving");
}

/// x
///
/// Domain: all
#[cfg_attr(kani, kani::proof)]
pub fn verify_s_valid_has_two_cases() {
    let (parameters, v_now, v_lead) = (parameters(), speed(), speed());
    let lead = if kani::any() { Some(v_lead) } else { None };
    let s_valid = s_valid(&parameters, v_now, lead);
    let expected = match lead {
        Some(v_lead) => s_follow(&parameters, v_now, v_lead),
        None => s_b(&parameters, v_now),
    };
    assert!(s_valid.to_bits() == expected.to_bits());
    kani::cover!(s_valid > 0.0 && lead.is_some(), "behind");
    kani::cover!(s_valid > 0.0 && lead.is_none(), "alone");
}

fn speed() -> f64 {
    within(0.0, 150.0)
}

fn parameters() -> Parameters {
    Parameters { a_b: within(0.1, 100.0), safety_time: within(0.0, 60.0), ..Parameters::default() }
}
