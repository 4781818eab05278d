//! The link between a vehicle and a station that computes for it.

pub mod clock;
pub mod message;
pub mod play;
pub mod run;
pub mod station;
pub mod traffic;
pub mod transport;
pub mod vehicle;
