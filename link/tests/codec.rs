//! The messages of the link as bytes.

#[path = "codec/common.rs"]
mod common;
#[path = "codec/round_trip.rs"]
mod round_trip;
