//! The link between a vehicle and a station that computes for it.

pub mod message;
