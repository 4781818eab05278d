//! The record of a cycle, its domain, and what the caller lends.

pub mod cycle;
pub mod detection_index;
pub mod indexes;
pub mod parameters;
pub mod profile;
pub mod route_index;
pub mod scratch;

pub(crate) mod domain;
