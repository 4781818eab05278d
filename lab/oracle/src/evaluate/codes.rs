//! Exit codes, and what is said with them.

use std::io::{self, Write};
use std::path::PathBuf;

use mufasa_drives::check::complain;

/// The hardened profile let something happen.
pub(super) const FAILED: u8 = 1;
/// Bad input, or a file that cannot be written.
pub(super) const BAD_INPUT: u8 = 2;
/// A search was ended before its end.
pub(super) use mufasa_conform::INTERRUPTED;
/// Model and implementation disagree.
pub(super) const DISAGREES: u8 = 3;

/// Says why nothing was done; the exit code.
pub(super) fn refused(message: &str, err: &mut impl Write) -> u8 {
    complain(err, message);
    BAD_INPUT
}

/// Names files that were written.
pub(super) fn say(files: &[PathBuf], out: &mut impl Write) -> io::Result<()> {
    files.iter().try_for_each(|file| writeln!(out, "{}", file.display()))
}
