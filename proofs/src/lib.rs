//! Laws of the implementation, and the proof harnesses that show them within stated bounds.
//!
//! This crate needs the implementation alone and builds with Rust 1.85, so that Kani and CBMC can
//! read it (`proofs/HARNESSES.md`).
#![cfg_attr(not(kani), no_std)]

#[cfg(all(not(kani), not(target_family = "wasm")))]
extern crate std;

#[cfg(not(any(kani, target_family = "wasm")))]
mod caught;
// Kani brings its own crate of that name; the build for CBMC takes the harnesses by their paths.
#[cfg(any(kani, not(target_family = "wasm")))]
pub mod harness;
#[cfg(not(any(kani, target_family = "wasm")))]
pub mod kani;
pub mod law;

/// Whether an overflow of this build panics, as the harnesses want it, or wraps.
pub const OVERFLOW_PANICS: bool = cfg!(debug_assertions);
