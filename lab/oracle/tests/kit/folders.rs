//! A place for what a test writes.

use std::fs;
use std::path::{Path, PathBuf};

/// A folder of its own for a test of this file, empty.
pub fn folder(test: &str) -> PathBuf {
    let tests = Path::new(env!("CARGO_TARGET_TMPDIR")).join(env!("CARGO_CRATE_NAME"));
    let folder = tests.join(test);
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).expect("the folder can be written");
    folder
}
