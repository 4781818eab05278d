//! The line protocol and the records of `spec/5-interfaces.md`.

mod common;
mod examples;
mod fields;
mod protocol;
mod round_trip;
mod schema;
mod verdicts;
