//! The program `mufasa`: answers the records of `spec/5-interfaces.md`, and checks drives with
//! the model and the implementation side by side.

pub mod check;
pub mod cli;
pub mod compose;
pub mod demo;
pub mod drive;
pub mod explore;
pub mod json;
pub mod oracle;
pub mod parameters_file;
pub mod svg;
pub mod table;
pub mod vectors;
