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

pub mod composition;
pub mod configuration;
pub mod cycle;
pub mod parameters;
pub mod qos;
pub mod requester;
pub mod route_index;
pub mod schedule;
pub mod scratch;
pub mod service;
pub mod verdict;

mod assignment;
mod band;
mod bitmap;
mod cells;
mod collision;
mod detections;
mod disk;
mod distance;
mod exact;
mod examined;
mod gate;
mod grid;
mod input;
mod map_validation;
mod pairing;
mod pairs;
mod plane;
mod range;
mod rectangle;
mod rounding;
mod route;
mod screen;
mod sweep;
mod track_validation;
mod tracks;
mod trajectory_rules;

#[cfg(test)]
extern crate std;

#[cfg(test)]
mod random;
