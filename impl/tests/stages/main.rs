//! The stages and their input, through `cycle::check` alone.
#![allow(
    clippy::cast_possible_truncation,
    clippy::cast_precision_loss,
    reason = "small numbers of tests"
)]

mod cells;
mod close;
mod extremes;
mod history;
mod input;
mod motions;
mod profiles;
mod scene;
mod seen_to_come;
mod slide;
mod words;
mod work;
