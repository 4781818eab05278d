//! The theorems: statement, claim, and a wrong variant that must be refuted. `proofs/mutants.toml` has
//! changes of the source under which each must fail.

pub mod base;
pub mod closure;
pub mod distances;
pub mod h04_gap;
pub mod h11_steps;
pub mod h14_fail_safe;
pub mod i_track_validation;
pub mod lemma;
pub mod rectangle;
pub mod rounding;
pub mod v_grid_map;

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

/// All theorems, in the order of `spec/`.
pub fn all() -> impl Iterator<Item = &'static Theorem> {
    [
        distances::THEOREMS,
        lemma::THEOREMS,
        rectangle::THEOREMS,
        h11_steps::THEOREMS,
        h14_fail_safe::path::THEOREMS,
        h14_fail_safe::times::THEOREMS,
        h14_fail_safe::motions::THEOREMS,
        h14_fail_safe::meeting::THEOREMS,
        h04_gap::THEOREMS,
        v_grid_map::THEOREMS,
        i_track_validation::THEOREMS,
        closure::THEOREMS,
        rounding::THEOREMS,
    ]
    .into_iter()
    .flatten()
}
