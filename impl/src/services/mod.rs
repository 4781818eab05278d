//! Which services run where (`spec/1-services.md`).

pub mod configuration;
