//! The program, in the folder of a test.

use std::path::Path;
use std::process::{Command, Output};

/// Runs `mufasa` there.
pub fn run(folder: &Path, arguments: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_mufasa"));
    command.args(arguments).current_dir(folder).output().expect("the program starts")
}
