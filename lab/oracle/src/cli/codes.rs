//! Exit codes that commands share.

use std::io;

use mufasa_drives::check::complain;

/// Bad input or arguments.
pub const BAD_INPUT: u8 = 2;
/// Model and text, or model and implementation, disagree.
pub const DISAGREE: u8 = 3;
/// As a shell says that a program was ended by a closed pipe.
pub const CLOSED_PIPE: u8 = 141;

/// Says why nothing was done; the exit code.
pub fn refused(message: &str) -> u8 {
    complain(&mut io::stderr(), message);
    BAD_INPUT
}
