//! Other people's results: assignments of scipy, dilations of scipy.ndimage, numbers from the
//! tests of ad-rss-lib. Without the data each test says loudly that it did not run.

mod assignment;
mod kinematics;
mod morphology;

use std::fs;
use std::path::{Path, PathBuf};

/// The folder of the data: `MUFASA_DATA`, or `../shared/data` beside the workspace.
fn folder() -> PathBuf {
    match std::env::var_os("MUFASA_DATA") {
        Some(folder) => PathBuf::from(folder),
        None => Path::new(env!("CARGO_MANIFEST_DIR")).join("../../shared/data"),
    }
}

/// The text of a file of the peers, or `None` after a loud line.
fn read(name: &str) -> Option<String> {
    let path = folder().join("peers").join(name);
    match fs::read_to_string(&path) {
        Ok(text) => Some(text),
        Err(error) => {
            println!("NOT RUN: {}: {error}; set MUFASA_DATA", path.display());
            None
        }
    }
}
