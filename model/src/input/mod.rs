//! The record of a cycle, its domain, and the same in exact numbers.

pub mod cycle;
pub mod domain;
pub mod parameters;
pub mod scene;
