//! The requester and the quality of service (`spec/2-offloading.md`).

pub mod quality_of_service;
pub mod requester;
