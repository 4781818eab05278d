//! Arbitrary values of the types that a harness needs. Finite choices are bytes below a bound, so
//! that an engine that enumerates can.

#[cfg(not(kani))]
use crate::kani;
use mufasa::input::profile::Profile;
use mufasa::services::configuration::Groups;

#[cfg(not(kani))]
pub use crate::kani::{below, near, near_integer};

/// A byte below `limit`.
#[cfg(kani)]
pub fn below(limit: u8) -> u8 {
    let value: u8 = kani::any();
    kani::assume(value < limit);
    value
}

/// Any double. The range is a hint for engines that sample.
#[cfg(kani)]
pub fn near(_least: f64, _most: f64) -> f64 {
    kani::any()
}

/// Any integer. The range is a hint for engines that sample.
#[cfg(kani)]
pub fn near_integer(_least: i64, _most: i64) -> i64 {
    kani::any()
}

/// Any double of the closed range.
pub fn within(least: f64, most: f64) -> f64 {
    let value = near(least, most);
    kani::assume(least <= value && value <= most);
    value
}

/// Any integer of the closed range.
pub fn integer_within(least: i64, most: i64) -> i64 {
    let value = near_integer(least, most);
    kani::assume(least <= value && value <= most);
    value
}

/// A time, with the limits of 64 bits as likely as a value near 0.
pub fn time_ns() -> i64 {
    near_integer(-20, 20)
}

/// A duration >= 0.
pub fn duration_ns() -> i64 {
    let value = near_integer(0, 20);
    kani::assume(value >= 0);
    value
}

/// `None`, or the value. The value is always drawn: draws behind a choice would be branches for a
/// prover, and a branch costs it more than a value.
pub fn option<T>(value: impl FnOnce() -> T) -> Option<T> {
    let (present, value): (bool, T) = (kani::any(), value());
    present.then_some(value)
}

/// One of the two profiles.
pub fn profile() -> Profile {
    if kani::any() { Profile::PAPER } else { Profile::HARDENED }
}

/// Any set of groups.
pub fn groups() -> Groups {
    Groups { mot: kani::any(), plan: kani::any() }
}

/// Whether both are the same number; no NaN is, and 0 is -0.
#[allow(clippy::float_cmp, reason = "this is what is asked")]
pub fn same_number(one: f64, other: f64) -> bool {
    one == other
}
