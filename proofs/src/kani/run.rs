//! Runs a harness over its tapes.

use std::collections::BTreeMap;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};

use super::tape::with_tape;

/// How many runs a harness gets.
#[derive(Clone, Copy, Debug)]
pub struct Budget {
    /// Finite domains with at most this many tapes are run completely.
    pub every: u64,
    /// Else this many random tapes are run.
    pub random: u64,
    /// Seed of the random tapes.
    pub seed: u64,
}

/// What was run.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Run {
    /// All tapes of a finite domain were run.
    pub exhaustive: bool,
    /// Runs begun.
    pub tried: u64,
    /// Runs in which every assumption held.
    pub held: u64,
    /// Covers that were come to, and in how many runs each was satisfied.
    pub covers: BTreeMap<&'static str, u64>,
}

/// What `assume` ends a run with.
pub(super) struct Rejected;

/// Runs the harness on every tape if its domain is finite and fits the budget, else on random
/// tapes. A failed assertion goes on as a panic, after the values that led to it were printed.
pub fn run_harness(harness: fn(), budget: Budget) -> Run {
    let all = run_tapes(harness, true, budget);
    if all.exhaustive { all } else { run_tapes(harness, false, budget) }
}

/// `every`: all tapes in turn, until they are through, too many, or found not to be finite.
fn run_tapes(harness: fn(), every: bool, budget: Budget) -> Run {
    let most = if every { budget.every } else { budget.random };
    let mut run = Run { exhaustive: false, tried: 0, held: 0, covers: BTreeMap::new() };
    with_tape(|tape| tape.start(every, budget.seed));
    loop {
        let result = catch_unwind(AssertUnwindSafe(harness));
        run.tried += 1;
        match result {
            Ok(()) => run.held += 1,
            Err(payload) if payload.is::<Rejected>() => {}
            Err(payload) => {
                std::eprintln!("with {}", with_tape(|tape| tape.describe()));
                resume_unwind(payload);
            }
        }
        let (unbounded, more) = with_tape(|tape| (tape.unbounded, tape.advance()));
        run.exhaustive = every && !unbounded && !more;
        if !more || run.tried == most || (every && unbounded) {
            run.covers = with_tape(|tape| core::mem::take(&mut tape.covers));
            return run;
        }
    }
}
