//! MUFASA's five validation stages as specified in `spec/`: no heap, no clock, and no
//! panics, which lints forbid and tests look for; of few parts it is proved (`proofs/HARNESSES.md`).
//!
//! Numbers are IEEE 754 doubles with bounds on their errors, so that rounding does not accept what
//! the exact model rejects (`spec/4-arithmetic.md#conformance-of-an-implementation`). The bounds
//! are argued where they stand and tested against exact arithmetic; they are not proved by machine.
//!
//! | `spec/` | here |
//! |---|---|
//! | `3-stages.md#schedule` | [`stages`] |
//! | stage i to stage v | `stages::{i_track_validation, .., v_grid_map}` |
//! | `3-stages.md#distances`, LLCC | `stages::{distances, horizon, llcc}` |
//! | `3-stages.md#invalid-input` | `input::domain` |
//! | H-01 to H-12 | `hardened`, a file for each rule or group of rules |
//! | `5-interfaces.md#cycle` | [`input::cycle`], [`report`] |
//! | `2-offloading.md` | [`offloading::requester`], [`offloading::quality_of_service`] |
//! | `1-services.md#configuration` | [`services::configuration`] |
//! | `4-arithmetic.md` | `numbers` |
//!
//! Fast paths are submodules of their stage: what they cannot decide is left to the numbers with
//! bounds.
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
#[cfg(feature = "parts")]
#[doc(hidden)]
pub mod parts;
pub mod report;
pub mod services;
pub mod stages;

mod hardened;
mod numbers;

#[cfg(test)]
extern crate std;

#[cfg(test)]
mod random;
