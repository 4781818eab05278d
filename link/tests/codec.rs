//! The messages of the link as bytes (`spec/6-link.md`).

#[path = "codec/common.rs"]
mod common;
#[path = "codec/golden.rs"]
mod golden;
#[path = "codec/hostile.rs"]
mod hostile;
#[path = "codec/limits.rs"]
mod limits;
#[path = "codec/round_trip.rs"]
mod round_trip;
