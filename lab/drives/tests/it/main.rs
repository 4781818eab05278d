//! Drives read, attacked, checked and drawn; in one binary, for each would link everything.

mod check;
#[path = "../common/mod.rs"]
mod common;
mod pictures;
mod readers;
mod words;
