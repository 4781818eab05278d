//! The monitor (`spec/monitor.md#monitor`): as the plain calls on any sequence of events and cycles,
//! and each mistake that those leave to the caller is an error or does not compile (what does not compile
//! stands in the documentation of `impl/src/monitor`).

#![allow(clippy::large_types_passed_by_value, reason = "settings, once for each monitor")]

mod again;
mod blind;
mod brake_by;
mod dropped;
mod early;
mod equal;
mod game;
mod habits;
mod held;
mod kit;
mod limits;
mod misuse;
mod own_plan;
mod plain;
mod restart;
mod scene;
mod seen;
mod stack;
mod starved;
