//! Temporary files: lines that are needed again, kept outside of memory.

use std::env;
use std::io;

/// What is said where lines cannot be kept.
pub(crate) fn unkept(error: &io::Error) -> String {
    format!("its lines cannot be kept in {} while they are needed: {error}; {}", folder(), OTHER)
}

/// What is said where lines that were kept are gone.
pub(crate) fn lost(error: &io::Error) -> String {
    format!("its lines, kept in {}, cannot be read again: {error}; {}", folder(), OTHER)
}

const OTHER: &str = "name another folder by TMPDIR";

fn folder() -> String {
    env::temp_dir().display().to_string()
}
