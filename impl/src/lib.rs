//! MUFASA's five validation stages as specified in `spec/`: no heap, no panic, no clock; plain
//! IEEE 754 arithmetic with proven error bounds, so that rounding never accepts what the exact
//! model rejects (`spec/4-arithmetic.md#conformance-of-an-implementation`).
#![no_std]
// Tests may panic: that is how they fail. Their sizes and draws are small.
#![cfg_attr(
    test,
    allow(
        clippy::cast_possible_truncation,
        clippy::cast_possible_wrap,
        clippy::cast_precision_loss,
        clippy::cast_sign_loss
    )
)]
#![cfg_attr(
    not(test),
    deny(
        clippy::unwrap_used,
        clippy::expect_used,
        clippy::indexing_slicing,
        clippy::panic,
        clippy::arithmetic_side_effects
    )
)]

pub mod input;
pub mod offloading;
pub mod report;
pub mod services;
pub mod stages;

mod hardened;
mod numbers;

#[cfg(test)]
extern crate std;

#[cfg(test)]
mod random;
