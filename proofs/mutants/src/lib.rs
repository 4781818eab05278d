//! The mutants: changes of the sources that claims must not survive (`proofs/mutants.toml`), and
//! where they apply.

#[cfg(feature = "find")]
pub mod place;

use std::collections::BTreeMap;

use serde::Deserialize;

/// What judges a claim.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Engine {
    /// Theorems over the reals.
    Z3,
    /// Rounding errors.
    Gappa,
    /// Ranges of doubles.
    Bitwuzla,
    /// Every reachable state of the offloading protocol.
    Exploration,
    /// Laws over complete finite domains.
    Laws,
    /// Harnesses run natively.
    Harnesses,
    /// Harnesses compiled, judged by CBMC.
    Cbmc,
    /// Harnesses compiled, judged by z3.
    Symbolic,
    /// Instructions that an optimisation saves; the claim is the call that is counted.
    Gains,
}

/// A change of the sources, and the claims that fail with it.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Mutant {
    /// What is changed, in a plain sentence that no other mutant has.
    pub change: String,
    /// Names of the claims.
    pub refutes: BTreeMap<Engine, Vec<String>>,
    /// Where.
    pub at: Vec<Place>,
}

/// One replacement in one item.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Place {
    /// Crate and the end of the item's path in it: `mufasa::distances::s_b`.
    pub item: String,
    /// Text that occurs in the item once; white space and the comma before a closing bracket do not count.
    pub from: String,
    /// What takes its place.
    pub to: String,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct List {
    mutant: Vec<Mutant>,
}

/// All mutants. Errors: the list is no such TOML.
pub fn all() -> Result<Vec<Mutant>, toml::de::Error> {
    let list: List = toml::from_str(include_str!("../../mutants.toml"))?;
    Ok(list.mutant)
}

/// The changes that refute this claim.
pub fn changes<'a>(mutants: &'a [Mutant], engine: Engine, claim: &str) -> Vec<&'a Mutant> {
    let refutes = |mutant: &&Mutant| {
        mutant.refutes.get(&engine).is_some_and(|claims| claims.iter().any(|one| one == claim))
    };
    mutants.iter().filter(refutes).collect()
}
