//! The monitor (`spec/monitor.md#monitor`): as its model on any sequence of events and cycles,
//! and each mistake that those leave to the caller is an error or does not compile (what does not compile
//! stands in the documentation of `impl/src/monitor`).

#![allow(clippy::large_types_passed_by_value, reason = "settings, once for each monitor")]

mod advice;
mod brake_by;
mod game;
mod habits;
mod in_time;
mod kit;
mod limits;
mod misuse;
mod model;
mod own_plan;
mod reached;
mod stack;
mod starved;
mod unusual;
