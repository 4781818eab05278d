//! Claims, and what is found of them.

use std::time::Duration;

use crate::drive;
use crate::numbers::real::formula::Formula;

/// A theorem over the reals.
#[derive(Debug)]
pub struct Theorem {
    /// Its name, a sentence.
    pub id: &'static str,
    /// What is claimed, in the symbols of `spec/`.
    pub statement: &'static str,
    /// Of which numbers, and what is not covered.
    pub domain: &'static str,
    /// The claim, executed on every path.
    pub claim: fn() -> Formula,
    /// A statement near it that is false, which must be refuted: the claim is not one of nothing.
    pub wrong: Wrong,
}

/// A false variant of a theorem, under its assumptions or nearly so. Under exactly its assumptions
/// stand the mutants.
#[derive(Debug)]
pub struct Wrong {
    /// What it says.
    pub statement: &'static str,
    /// Its claim.
    pub claim: fn() -> Formula,
}

/// What a solver decides of a claim.
#[derive(Clone, Debug, PartialEq)]
pub enum Decision {
    /// True of all numbers of its domain.
    Proved,
    /// False of these.
    Refuted(Vec<(String, f64)>),
    /// The solver does not know, or took too long.
    Unknown,
}

/// A proof or its failure.
#[derive(Clone, Debug)]
pub struct Proof {
    /// How it ended.
    pub decision: Decision,
    /// Paths executed.
    pub paths: usize,
}

/// A claim judged.
#[derive(Clone, Debug)]
pub struct Judgement {
    /// Of the claim.
    pub claim: Decision,
    /// Of its wrong variant, which must be refuted.
    pub control: Decision,
    /// Paths of the claim executed.
    pub paths: usize,
    /// Time taken.
    pub time: Duration,
}

impl Judgement {
    /// Of the claim; not known when the wrong variant is not refuted, because then the claim may
    /// be one of nothing.
    pub fn decision(&self) -> &Decision {
        match (&self.claim, &self.control) {
            (Decision::Proved, Decision::Proved | Decision::Unknown) => &Decision::Unknown,
            (decision, _) => decision,
        }
    }
    /// The counterexample of the wrong variant as a table, where it is a drive.
    pub fn drive(&self) -> Option<String> {
        let Decision::Refuted(values) = &self.control else { return None };
        drive::table(values)
    }
}
