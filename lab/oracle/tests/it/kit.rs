//! The program, and a place for what a test writes.

use std::fs;
use std::panic::Location;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// A folder of its own for a test of the calling file, empty.
#[track_caller]
pub fn folder(test: &str) -> PathBuf {
    let file = Path::new(Location::caller().file()).file_stem().expect("a name");
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(file).join(test);
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).expect("the folder can be written");
    folder
}

/// Runs `mufasa` there.
pub fn run(folder: &Path, arguments: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_mufasa"));
    command.args(arguments).current_dir(folder).output().expect("the program starts")
}
