//! The stages and their input, through `schedule::check` alone.

mod input;
mod scene;
mod thresholds;
