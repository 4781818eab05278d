//! MUFASA as an executable specification: exact, plain, read beside the paper.

pub mod hardened;
pub mod input;
pub mod numbers;
pub mod offloading;
pub mod report;
pub mod services;
pub mod stages;
