//! Holes: doubles that stand for any number, so that a record of doubles can be symbolic.
//!
//! A hole is a NaN that carries the place of its name in a list of the thread; no formula reads
//! a NaN as a number.

use std::cell::RefCell;

/// Bits of a quiet NaN; names are numbered in the bits below.
const QUIET: u64 = 0x7ff8_0000_0000_0000;

thread_local! {
    static NAMES: RefCell<Vec<String>> = const { RefCell::new(Vec::new()) };
}

/// The hole of this name.
///
/// # Panics
/// If there are more than 2^50 of them.
pub fn open_number(name: &str) -> f64 {
    NAMES.with_borrow_mut(|names| {
        let place = names.iter().position(|other| other == name).unwrap_or_else(|| {
            names.push(name.to_owned());
            names.len() - 1
        });
        let place = u64::try_from(place + 1).expect("few holes");
        f64::from_bits(QUIET | place)
    })
}

/// The name of a hole; none of any other double.
pub fn name_of(value: f64) -> Option<String> {
    let place = usize::try_from(value.to_bits() ^ QUIET).ok()?.checked_sub(1)?;
    NAMES.with_borrow(|names| names.get(place).cloned()).filter(|_| value.is_nan())
}
