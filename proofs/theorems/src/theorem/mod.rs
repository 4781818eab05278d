//! The theorems: statement, claim, and a wrong variant that must be refuted. `proofs/mutants.toml` has
//! changes of the source under which each must fail.

pub mod base;
pub mod distances;
pub mod h04_gap;
pub mod h11_steps;
pub mod h14_fail_safe;
pub mod i_track_validation;
pub mod lemma;
pub mod rectangle;
pub mod stop;
pub mod v_grid_map;

use crate::claim::Theorem;
use crate::witness::searches::SEARCHES;

/// All theorems, in the order of `spec/`.
pub fn all() -> impl Iterator<Item = &'static Theorem> {
    let closures = SEARCHES.iter().map(|search| &search.closure);
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
        stop::motion::THEOREMS,
        stop::standing::THEOREMS,
        stop::lead::THEOREMS,
        v_grid_map::THEOREMS,
        i_track_validation::THEOREMS,
    ]
    .into_iter()
    .flatten()
    .chain(closures)
}
