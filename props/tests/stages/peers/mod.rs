//! Other people's results: assignments of scipy, dilations of scipy.ndimage, numbers from the
//! tests of ad-rss-lib. Without the data each test says loudly that it did not run.

mod assignment;
mod kinematics;
mod morphology;

use std::fs;
use std::io::{self, Write};
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
            let line = format!(
                "NOT RUN: {}: {}: {error}; set MUFASA_DATA\n",
                std::thread::current().name().unwrap_or("a test"),
                path.display()
            );
            // The macros' output is captured, and nobody would see it.
            io::stderr().write_all(line.as_bytes()).expect("standard error can be written");
            None
        }
    }
}

#[test]
fn a_test_without_data_says_so_aloud() {
    let program = std::env::current_exe().expect("the path of this program");
    let output = std::process::Command::new(program)
        .arg("braking_distances_are_those_of_ad_rss_lib")
        .env("MUFASA_DATA", "/no such folder")
        .output()
        .expect("this program starts");
    let text = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success() && text.contains(": /no such folder"), "{text}");
}
