//! The published workloads, and the libraries that the implementation is timed against.

pub mod contestant;
pub mod monitored;
#[cfg(feature = "peers")]
pub mod peer;
#[cfg(feature = "peers")]
pub mod race;
pub mod steps;
#[cfg(feature = "peers")]
pub mod table;
pub mod workload;
pub mod worst;
