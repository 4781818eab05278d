//! Generators of cycles, of which at least half lie within 1e-5 of a decision.
//!
//! Every generator is a plain function of a tape of choices (`draw`), so that proptest, a fuzzer
//! and a hand-made case can use it.
#![expect(clippy::cast_precision_loss, reason = "counts are small and generators may round")]

pub mod attack;
pub mod base;
pub mod composition;
pub mod detections;
pub mod draw;
pub mod end;
pub mod fail_safe;
pub mod grid;
pub mod history;
pub mod input;
pub mod map_validation;
pub mod monitor;
pub mod moving;
pub mod obstacle;
pub mod requester;
pub mod roads;
pub mod schedule;
pub mod seen;
pub mod sizes;
pub mod steps;
pub mod track_validation;
pub mod tracks;
pub mod whole;
