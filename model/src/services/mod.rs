//! Services, compositions and configurations (`spec/1-services.md`).

pub mod composition;
pub mod configuration;
pub mod orchestrator;
pub mod service;
