//! The program `mufasa`: answers the records of `spec/5-interfaces.md`, and checks drives with
//! the model and the implementation side by side.

pub mod drive;
