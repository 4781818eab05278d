//! C interface of MUFASA's implementation: `mufasa::stages::check` and `mufasa::offloading::requester`.
//!
//! All memory is the caller's: nothing is allocated, and nothing is kept between two calls but the
//! requester in the memory that it was given. Numbers that stand for a choice (profile,
//! configuration, group, type of an event) are checked, so any bit pattern may come in. Pointers
//! are checked for null and alignment; that they point to what they say, the caller warrants.
//!
//! No panic crosses the border: lints forbid what panics, and an `extern "C"` function that did would
//! end the process instead of unwinding into C.
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

pub mod check;
pub mod cycle;
pub mod detection_index;
pub mod event;
pub mod parameters;
pub mod report;
pub mod requester;
pub mod status;

mod convert;
mod memory;
