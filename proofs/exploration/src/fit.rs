//! The worlds are small, and so are all numbers in them.

use std::fmt::Debug;

/// The number in another type; the bounds of the worlds are such that it fits.
pub(super) fn fitted<T: Copy + Debug, U: TryFrom<T>>(number: T) -> U {
    U::try_from(number).unwrap_or_else(|_| panic!("{number:?} is beyond what a world can hold"))
}
