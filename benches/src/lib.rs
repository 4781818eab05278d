//! The published workloads, periods of the requester, and the libraries that the implementation is timed against.

pub mod contestant;
pub mod monitored;
pub mod peer;
pub mod periods;
pub mod race;
pub mod table;
pub mod workload;
