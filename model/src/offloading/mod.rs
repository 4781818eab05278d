//! Requester, provider and quality of service (`spec/2-offloading.md`).

pub mod provider;
pub mod quality_of_service;
pub mod requester;
