//! How a command ends, and what is said of it.

use std::fmt::Display;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use mufasa_drives::check;

/// Something is not as it should be: the hardened profile let something happen, or a check failed.
pub(crate) const FAILED: u8 = 1;
/// Bad input or arguments, or a file that cannot be written.
pub(crate) const BAD_INPUT: u8 = 2;
/// Model and text, or model and implementation, disagree.
pub(crate) const DISAGREES: u8 = 3;
/// A command was ended before its end.
pub(crate) use mufasa_conform::INTERRUPTED;
/// Something was not run that has to be.
pub(crate) const LEFT_OUT: u8 = 4;

/// Why a command does nothing more.
#[derive(Debug)]
pub enum Stopped {
    /// Standard input or output fails.
    Stream(io::Error),
    /// Bad input, or a file that cannot be written: what is said of it.
    Refused(String),
}

impl From<io::Error> for Stopped {
    fn from(error: io::Error) -> Self {
        Self::Stream(error)
    }
}

impl From<String> for Stopped {
    fn from(message: String) -> Self {
        Self::Refused(message)
    }
}

/// The exit code.
pub(crate) type Ended = Result<u8, Stopped>;

/// An error in words.
pub(crate) fn said(error: impl Display) -> String {
    error.to_string()
}

/// The words for a file that cannot be written, or read.
pub(crate) fn cannot<E: Display>(file: &Path, be: &str) -> impl FnOnce(E) -> String {
    let file = file.display().to_string();
    move |error| format!("{file}: cannot be {be}: {error}")
}

/// Says on standard error what is wrong.
pub(crate) fn complain(message: &str) {
    check::complain(&mut io::stderr(), message);
}

/// Names files that were written.
pub(crate) fn say(files: &[PathBuf], out: &mut impl Write) -> io::Result<()> {
    files.iter().try_for_each(|file| writeln!(out, "{}", file.display()))
}
