//! H-14, the fail-safe rule (`spec/hardened/H-14.md`), a file for each of the model's.

pub mod meeting;
pub mod motions;
pub mod path;
pub mod times;
