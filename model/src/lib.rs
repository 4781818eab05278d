//! MUFASA as an executable specification: exact, plain, read beside the paper.

pub mod composition;
pub mod configuration;
pub mod cycle;
pub mod orchestrator;
pub mod parameters;
pub mod provider;
pub mod qos;
pub mod requester;
pub mod schedule;
pub mod service;
pub mod verdict;
