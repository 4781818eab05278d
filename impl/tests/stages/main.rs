//! The stages and their input, through `stages::check` alone.

mod input;
mod scene;
mod thresholds;
