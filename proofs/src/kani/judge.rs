//! What a run of a harness on the stand-in shows.

use std::collections::BTreeSet;
use std::string::String;
use std::vec::Vec;

use super::run::{Budget, Run, run_harness};
use crate::caught::catch;

/// What every harness gets. The largest finite domain, that of the compositions, has 607,360 values.
pub const BUDGET: Budget = Budget { every: 1_000_000, random: 150_000, seed: 20_250_617 };
/// Runs in which every assumption has to hold, where runs are random.
pub const LEAST_HELD: u64 = 1_000;

/// What a harness was shown to be.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Evidence {
    /// True of every value of a finite domain.
    Every(Run),
    /// True of the random and boundary values that were run: testing, no proof.
    Some(Run),
    /// Nothing was shown: a cover is never reached, or too few runs met the assumptions.
    Vacuous(String),
    /// False, with the message of the assertion.
    Refuted(String),
}

/// Runs the harness, which has to reach exactly these covers.
pub fn judge_harness(harness: fn(), covers: &BTreeSet<&str>) -> Evidence {
    let found = match catch(|| run_harness(harness, BUDGET)) {
        Ok(found) => found,
        Err(message) => return Evidence::Refuted(message),
    };
    let come_to: BTreeSet<&str> = found.covers.keys().copied().collect();
    let other: Vec<_> = come_to.symmetric_difference(covers).collect();
    let missed: Vec<_> = found.covers.iter().filter(|&(_, &runs)| runs == 0).collect();
    if !other.is_empty() {
        return Evidence::Vacuous(std::format!("covers differ from those expected: {other:?}"));
    }
    if !missed.is_empty() {
        return Evidence::Vacuous(std::format!("covers never reached: {missed:?}"));
    }
    if found.exhaustive {
        return Evidence::Every(found);
    }
    if found.held < LEAST_HELD {
        return Evidence::Vacuous(std::format!("only {} runs met the assumptions", found.held));
    }
    Evidence::Some(found)
}
