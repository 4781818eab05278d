//! Exit codes.

/// The hardened profile let something happen.
pub(super) const FAILED: u8 = 1;
/// Bad input, or a file that cannot be written.
pub(super) const BAD_INPUT: u8 = 2;
/// A search was ended before its end.
pub(super) use mufasa_conform::INTERRUPTED;
/// Model and implementation disagree.
pub(super) const DISAGREES: u8 = 3;
