//! The messages of the link as bytes (`spec/6-link.md`).

mod common;
mod golden;
mod hostile;
mod limits;
mod round_trip;
