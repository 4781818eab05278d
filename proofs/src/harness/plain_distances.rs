//! The distances in plain doubles (`spec/3-stages.md#distances`). That the bounds of `impl` on its
//! double-doubles hold is for other tests. Three harnesses form a quotient twice: LLVM makes one of these, Kani does not, and
//! is not given them.

use mufasa::input::cycle::{Cycle, Ego};
use mufasa::input::parameters::Parameters;
use mufasa::input::profile::Profile;
use mufasa::parts::{follow, s_b, s_cav, s_follow, s_valid, stop};

use super::any::{below, same_number, within};
use super::scene::{EGO, NOW_NS, alone};
#[cfg(not(kani))]
use crate::kani;

/// The longest distances of `spec/4-arithmetic.md#domain`: 150^2 / (2 * 0.1) m and 60 * 150 m.
const LONGEST_BRAKING: f64 = 112_500.0;
const LONGEST_CAV: f64 = 9_000.0;
/// 150 + 100 * 60 m/s after tau, and its square / (2 * 0.1) m.
const FASTEST: f64 = 6_150.0;
const LONGEST_STOPPING: f64 = 189_112_500.0;

/// `s_b(v)` in plain doubles is a number from 0 to 112.5 km, and at most 189.2 Mm at the speeds after `tau` (H-14).
///
/// Domain: all speeds and `a_b` of `spec/4-arithmetic.md#domain`, and speeds up to 6150 m/s. Not covered: its value.
#[cfg_attr(kani, kani::proof)]
#[cfg_attr(kani, kani::solver(kissat))]
pub fn verify_s_b_is_bounded() {
    let v = within(0.0, FASTEST);
    let s_b = s_b(&parameters(), v);
    assert!((0.0..=LONGEST_STOPPING).contains(&s_b));
    assert!(v > 150.0 || s_b <= LONGEST_BRAKING);
    kani::cover!(s_b > LONGEST_BRAKING, "after tau");
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

/// `s_follow` in plain doubles, of any two braking distances and `s_CAV`, is the positive part of the difference of the
/// first two and the third, bit by bit: from `s_CAV` to 121.5 km, and `s_CAV` where the two are equal [DIST-01].
///
/// Domain: braking distances from 0 to 112.5 km, `s_CAV` from 0 to 9 km. Not covered: what these are.
#[cfg_attr(kani, kani::proof)]
#[cfg_attr(kani, kani::solver(kissat))]
pub fn verify_s_follow_adds_to_s_cav() {
    let [now, lead] = [(); 2].map(|()| within(0.0, LONGEST_BRAKING));
    let s_cav = within(0.0, LONGEST_CAV);
    let found = follow([now, lead], s_cav);
    let gap = if now > lead { now - lead } else { 0.0 };
    assert!(found.to_bits() == (gap + s_cav).to_bits());
    assert!(s_cav <= found && found <= LONGEST_BRAKING + LONGEST_CAV);
    assert!(!same_number(now, lead) || same_number(found, s_cav));
    kani::cover!(found > s_cav && s_cav > 0.0, "both parts");
    kani::cover!(same_number(now, lead) && found > 0.0, "as fast");
    kani::cover!(now < lead && found > 0.0, "a faster lead");
}

/// `s_follow` in plain doubles is that of `s_b(v_now)`, `s_b(v_lead)` and `s_CAV`, bit by bit [DIST-01].
///
/// Domain: all speeds, `a_b` and `safety_time` of `spec/4-arithmetic.md#domain`. Not covered: how far it is from that of
/// real numbers.
pub fn verify_s_follow_is_the_sum() {
    let (parameters, v_now, v_lead) = (parameters(), speed(), speed());
    let ways = [v_now, v_lead].map(|v| s_b(&parameters, v));
    let [s_cav, s_follow] = [s_cav(&parameters, v_now), s_follow(&parameters, v_now, v_lead)];
    assert!(s_follow.to_bits() == follow(ways, s_cav).to_bits());
    kani::cover!(ways[0] > ways[1] && s_cav > 0.0, "both parts");
    kani::cover!(v_now < v_lead && s_follow > 0.0, "a faster lead");
}

/// `s_follow` in plain doubles is exactly `max(v_now^2 - v_lead^2, 0) / (2 a_b) + safety_time v_now` where doubles are
/// exact [DIST-01].
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

/// `s_valid` in plain doubles is `s_follow` behind a lead and `s_b(v_now)` without one [DIST-01].
///
/// Domain: all speeds, `a_b` and `safety_time` of `spec/4-arithmetic.md#domain`. Not covered:
/// nothing.
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

/// The speed after `tau` is at most 6150 m/s in plain doubles, and the way until then at most 189 km (H-14).
///
/// Domain: all speeds, `tau` and `a_max` of `spec/4-arithmetic.md#domain`. Not covered: their values.
#[cfg_attr(kani, kani::proof)]
#[cfg_attr(kani, kani::solver(kissat))]
pub fn verify_the_way_until_tau_is_bounded() {
    let [v_tau, s_tau, _] = stop(&any_cycle());
    assert!((0.0..=FASTEST).contains(&v_tau) && (0.0..=189_000.0).contains(&s_tau));
    kani::cover!(v_tau > 150.0 && s_tau > 9_000.0, "speeding up");
    kani::cover!(s_tau <= 0.0, "no reaction");
}

/// `s_stop` in plain doubles is the sum of the way until `tau` and of `s_b` of the speed then, bit by bit; so at most
/// 1.9e8 m [H-14.10].
///
/// Domain: all speeds, `a_b`, `tau` and `a_max` of `spec/4-arithmetic.md#domain`. Not covered: how far the sum is from that
/// of real numbers.
pub fn verify_s_stop_is_the_sum() {
    let cycle = any_cycle();
    let [v_tau, s_tau, s_stop] = stop(&cycle);
    assert!(s_stop.to_bits() == (s_tau + s_b(&cycle.parameters, v_tau)).to_bits());
    kani::cover!(s_stop > s_tau && s_tau > 0.0, "both parts");
    kani::cover!(s_stop <= 0.0, "standing without a reaction");
}

/// Any speed, and the parameters of `s_stop`.
fn any_cycle() -> Cycle<'static> {
    let parameters =
        Parameters { tau: within(0.0, 60.0), a_max: within(0.1, 100.0), ..parameters() };
    alone(Profile::HARDENED, parameters, Ego { speed: speed(), ..EGO }, NOW_NS)
}

fn speed() -> f64 {
    within(0.0, 150.0)
}

fn parameters() -> Parameters {
    Parameters { a_b: within(0.1, 100.0), safety_time: within(0.0, 60.0), ..Parameters::default() }
}
