//! The distances in plain doubles (`spec/3-stages.md#distances`). That the bounds of `impl` on its
//! double-doubles hold is for other tests.

use mufasa::input::cycle::Ego;
use mufasa::input::parameters::Parameters;
use mufasa::input::profile::Profile;
use mufasa::parts::{s_b, s_cav, s_follow, s_stop, s_valid};

use super::any::{below, same_number, within};
use super::scene::{EGO, NOW_NS, alone};
#[cfg(not(kani))]
use crate::kani;

/// The longest distances of `spec/4-arithmetic.md#domain`: 150^2 / (2 * 0.1) m and 60 * 150 m.
const LONGEST_BRAKING: f64 = 112_500.0;
const LONGEST_CAV: f64 = 9_000.0;

/// `s_b(v)` in plain doubles is a number from 0 to 112.5 km.
///
/// Domain: all speeds and `a_b` of `spec/4-arithmetic.md#domain`. Not covered: its value.
#[cfg_attr(kani, kani::proof)]
#[cfg_attr(kani, kani::solver(kissat))]
pub fn verify_s_b_is_bounded() {
    let s_b = s_b(&parameters(), speed());
    assert!((0.0..=LONGEST_BRAKING).contains(&s_b));
    kani::cover!(s_b > 0.0, "braking");
    kani::cover!(s_b <= 0.0, "no way to brake");
}

/// `s_CAV` in plain doubles is a number from 0 to 9 km.
///
/// Domain: all speeds and `safety_time` of `spec/4-arithmetic.md#domain`. Not covered: its value.
#[cfg_attr(kani, kani::proof)]
#[cfg_attr(kani, kani::solver(kissat))]
pub fn verify_s_cav_is_bounded() {
    let s_cav = s_cav(&parameters(), speed());
    assert!((0.0..=LONGEST_CAV).contains(&s_cav));
    kani::cover!(s_cav > 0.0, "some way");
}

/// `s_follow` in plain doubles is never below `s_CAV`, and no NaN.
///
/// Domain: all speeds, `a_b` and `safety_time` of `spec/4-arithmetic.md#domain`. Not covered: its
/// value.
#[cfg_attr(kani, kani::proof)]
#[cfg_attr(kani, kani::solver(kissat))]
pub fn verify_s_follow_is_at_least_s_cav() {
    let (parameters, v_now, v_lead) = (parameters(), speed(), speed());
    let (s_follow, s_cav) = (s_follow(&parameters, v_now, v_lead), s_cav(&parameters, v_now));
    assert!(s_follow >= s_cav);
    kani::cover!(s_follow > s_cav, "longer than s_CAV");
    kani::cover!(s_follow <= s_cav && s_cav > 0.0, "s_CAV alone");
}

/// `s_follow` in plain doubles is the sum of the positive part of `s_b(v_now) - s_b(v_lead)` and of `s_CAV`, bit by
/// bit.
///
/// Domain: all speeds, `a_b` and `safety_time` of `spec/4-arithmetic.md#domain`. Not covered: how far the sum is from that
/// of real numbers, which Gappa bounds.
#[cfg_attr(kani, kani::proof)]
#[cfg_attr(kani, kani::solver(kissat))]
pub fn verify_s_follow_is_the_sum() {
    let (parameters, v_now, v_lead) = (parameters(), speed(), speed());
    let [now, lead] = [v_now, v_lead].map(|v| s_b(&parameters, v));
    let difference = now - lead;
    let gap = if difference > 0.0 { difference } else { 0.0 };
    let s_follow = s_follow(&parameters, v_now, v_lead);
    assert!(s_follow.to_bits() == (gap + s_cav(&parameters, v_now)).to_bits());
    kani::cover!(gap > 0.0 && s_follow > gap, "both parts");
    kani::cover!(now < lead && s_follow > 0.0, "a faster lead");
}

/// `s_follow` in plain doubles is exactly `max(v_now^2 - v_lead^2, 0) / (2 a_b) + safety_time v_now` where doubles are
/// exact.
///
/// Domain: whole speeds of `spec/4-arithmetic.md#domain` in m/s, `a_b` of 1/2, 1, 4 and 8 m/s^2, `safety_time` of 0, 1, 7 and 60 s.
/// Not covered: other numbers, of which `verify_s_follow_is_the_sum` says what is computed.
#[cfg_attr(kani, kani::proof)]
#[cfg_attr(kani, kani::solver(kissat))]
pub fn verify_s_follow_is_exact_where_doubles_are() {
    let [n, m, t] = [below(151), below(151), below(4)];
    let power = below(4);
    let twice_a_b = [1.0, 2.0, 8.0, 16.0][usize::from(power)];
    let t = [0_u8, 1, 7, 60][usize::from(t)];
    let parameters =
        Parameters { a_b: twice_a_b / 2.0, safety_time: f64::from(t), ..Parameters::default() };
    let found = s_follow(&parameters, f64::from(n), f64::from(m)) * twice_a_b;
    let [n, m, t] = [n, m, t].map(u32::from);
    let expected = (n * n).saturating_sub(m * m) + t * n * [1, 2, 8, 16][usize::from(power)];
    assert!(same_number(found, f64::from(expected)));
    kani::cover!(n > m && t > 0, "both parts");
    kani::cover!(n < m && t > 0 && n > 0, "a faster lead");
}

/// `s_follow` in plain doubles is a number from 0 to 121.5 km.
///
/// Domain: all speeds, `a_b` and `safety_time` of `spec/4-arithmetic.md#domain`. Not covered: its
/// value.
#[cfg_attr(kani, kani::proof)]
#[cfg_attr(kani, kani::solver(kissat))]
pub fn verify_s_follow_is_bounded() {
    let s_follow = s_follow(&parameters(), speed(), speed());
    assert!((0.0..=LONGEST_BRAKING + LONGEST_CAV).contains(&s_follow));
    kani::cover!(s_follow > LONGEST_CAV, "behind a slower lead");
}

/// `s_follow` in plain doubles is `s_CAV` behind a lead as fast as the CAV.
///
/// Domain: all speeds, `a_b` and `safety_time` of `spec/4-arithmetic.md#domain`. Not covered: faster
/// leads, which need that products of doubles grow: no solver ended, and a theorem says it of reals.
#[cfg_attr(kani, kani::proof)]
#[cfg_attr(kani, kani::solver(kissat))]
pub fn verify_s_follow_is_s_cav_at_equal_speeds() {
    let (parameters, v_now) = (parameters(), speed());
    let (s_follow, s_cav) = (s_follow(&parameters, v_now, v_now), s_cav(&parameters, v_now));
    assert!(same_number(s_follow, s_cav));
    kani::cover!(s_follow > 0.0, "moving");
}

/// `s_valid` in plain doubles is `s_follow` behind a lead and `s_b(v_now)` without one.
///
/// Domain: all speeds, `a_b` and `safety_time` of `spec/4-arithmetic.md#domain`. Not covered:
/// nothing.
#[cfg_attr(kani, kani::proof)]
#[cfg_attr(kani, kani::solver(kissat))]
pub fn verify_s_valid_has_two_cases() {
    let (parameters, v_now, v_lead) = (parameters(), speed(), speed());
    let lead = if kani::any() { Some(v_lead) } else { None };
    let s_valid = s_valid(&parameters, v_now, lead);
    let expected = match lead {
        Some(v_lead) => s_follow(&parameters, v_now, v_lead),
        None => s_b(&parameters, v_now),
    };
    assert!(s_valid.to_bits() == expected.to_bits());
    kani::cover!(s_valid > 0.0 && lead.is_some(), "behind a lead");
    kani::cover!(s_valid > 0.0 && lead.is_none(), "without a lead");
}

/// `s_stop` in plain doubles is a number from 0 to 2e8 m.
///
/// Domain: all speeds, `a_b`, `tau` and `a_max` of `spec/4-arithmetic.md#domain`. Not covered: its value.
#[cfg_attr(kani, kani::proof)]
#[cfg_attr(kani, kani::solver(kissat))]
pub fn verify_s_stop_is_bounded() {
    let parameters =
        Parameters { tau: within(0.0, 60.0), a_max: within(0.1, 100.0), ..parameters() };
    let cycle = alone(Profile::HARDENED, parameters, Ego { speed: speed(), ..EGO }, NOW_NS);
    let way = s_stop(&cycle);
    assert!((0.0..=2e8).contains(&way));
    kani::cover!(way > 0.0, "some way");
    kani::cover!(way <= 0.0, "standing without a reaction");
}

fn speed() -> f64 {
    within(0.0, 150.0)
}

fn parameters() -> Parameters {
    Parameters { a_b: within(0.1, 100.0), safety_time: within(0.0, 60.0), ..Parameters::default() }
}
