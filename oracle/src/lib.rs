//! The program `mufasa`: answers the records of `spec/5-interfaces.md`, and checks drives with
//! the model and the implementation side by side.

pub mod check;
pub mod cli;
pub mod compose;
pub mod conform;
pub mod demo;
pub mod drive;
pub mod explore;
pub mod implementation;
pub mod json;
pub mod oracle;
pub mod parameters_file;
pub mod prove;
pub mod svg;
pub mod table;
pub mod vectors;
