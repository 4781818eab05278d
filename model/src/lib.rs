//! MUFASA as an executable specification: exact, plain, read beside the paper.

pub mod configuration;
pub mod cycle;
pub mod parameters;
pub mod schedule;
pub mod verdict;
