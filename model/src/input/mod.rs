//! The record of a cycle, which values it may hold, and the same in exact numbers.

pub mod cycle;
pub mod domain;
pub mod parameters;
pub mod profile;
pub mod scene;
