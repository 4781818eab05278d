//! The built program, and what it is made of; in one binary, for each would link everything.

mod cli;
#[path = "../../../drives/tests/common/mod.rs"]
mod common;
mod compose;
mod demo;
mod explore;
mod findings;
mod integrate;
mod interrupted;
mod kit;
#[path = "../../../sim/tests/common/maps.rs"]
mod maps;
mod memory;
mod mistakes;
mod prove;
mod report;
mod schemas;
mod shards;
mod speed;
mod ulm;
mod verify;
