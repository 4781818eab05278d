//! The program `mufasa`: its command line, and what it writes.

pub mod cli;
pub mod compose;
pub mod demo;
pub mod document;
mod ended;
#[cfg(feature = "link")]
pub mod evaluate;
pub mod explore;
pub mod integrate;
mod limits;
#[cfg(feature = "link")]
mod link;
pub mod parameters_file;
pub mod prove;
mod rows;
pub mod schemas;
mod spelling;
pub mod verify;
