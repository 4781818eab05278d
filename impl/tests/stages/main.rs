//! The stages and their input, through `stages::check` alone.
#![allow(
    clippy::cast_possible_truncation,
    clippy::cast_precision_loss,
    reason = "small numbers of tests"
)]

mod cells;
mod disputed;
mod explained;
mod history;
mod input;
mod lag;
mod moving;
mod scene;
mod slide;
mod step_turn;
mod steps;
mod thresholds;
mod waiting;
