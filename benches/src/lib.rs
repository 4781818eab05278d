//! Workloads of three sizes, and the plain programs that the implementation is timed against.

pub mod alternative;
pub mod workload;
