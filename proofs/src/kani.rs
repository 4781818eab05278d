//! A stand-in for the crate `kani`, so that every harness runs where Kani is not installed.
//!
//! This is testing, not proof. The few functions that the harnesses use draw from a tape: where
//! every draw has few values, all tapes are run, which is a proof by exhaustion of that domain;
//! where numbers of 64 bits are drawn, many tapes are, which proves nothing. Kani and CBMC take
//! the same harnesses and leave these values symbolic.

mod judge;
mod run;
mod tape;
mod values;

pub use self::judge::{BUDGET, Evidence, LEAST_HELD, judge_harness};
pub use self::run::{Budget, Run, run_harness};
pub use self::values::{Arbitrary, any, below, near, near_integer};

use std::boxed::Box;

use self::run::Rejected;
use self::tape::with_tape;

/// Ends this run without a verdict unless the condition holds.
pub fn assume(condition: bool) {
    if !condition {
        // Nothing is printed of it: it is no panic but the end of a case.
        std::panic::resume_unwind(Box::new(Rejected));
    }
}

/// Notes that the harness came to this cover, and whether its condition held.
pub fn cover(condition: bool, name: &'static str) {
    with_tape(|tape| tape.cover(condition, name));
}

/// `kani::cover!(condition, name)`: some case has to satisfy the condition here.
macro_rules! cover_macro {
    ($condition:expr, $name:literal) => {
        kani::cover($condition, $name)
    };
}

pub(crate) use cover_macro as cover;
