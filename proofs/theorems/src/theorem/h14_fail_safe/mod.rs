//! H-14, the fail-safe rule (`spec/7-fail-safe.md`), a file for each of the model's.

pub mod motions;
pub mod times;
