//! C interface of MUFASA's implementation: the monitor, and beneath it `mufasa::cycle::check`.
//!
//! All memory is the caller's: nothing is allocated, and nothing is kept between two calls except
//! the monitor, in the memory that it was given. Numbers that stand for a choice (profile,
//! configuration, group, type of an event) are checked, so any bit pattern may come in. Pointers
//! are checked for null and alignment; that they point to what they say, the caller warrants.
//!
//! No panic crosses the border: lints forbid what panics, and an `extern "C"` function that did would
//! end the process instead of unwinding into C.
//!
//! Without the feature `std` (on by default) it is built on `core` alone, for targets without an operating
//! system; a panic would then end in the `abort` that the program has.
#![cfg_attr(not(feature = "std"), no_std)]
// INPUT-08
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
pub mod event;
pub mod monitor;
pub mod parameters;
pub mod report;
pub mod requester;
pub mod status;
pub mod text;
pub mod time;
pub mod version;

mod convert;
mod memory;

/// None is known; a library without `std` must say what becomes of one.
#[cfg(not(feature = "std"))]
#[panic_handler]
fn ends(_: &core::panic::PanicInfo<'_>) -> ! {
    unsafe extern "C" {
        fn abort() -> !;
    }
    // SAFETY: `abort` of the C library takes nothing and does not return.
    unsafe { abort() }
}
