//! `proofs/expected.toml`: what is expected of each harness.

use std::collections::BTreeSet;

use serde::Deserialize;

/// What is expected of one harness.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Expected {
    /// Its path below `mufasa_proofs::harness`.
    pub id: String,
    /// Part of the Kani workflow that runs it, if one does.
    pub shard: Option<i64>,
    /// `kani::unwind`, if there is one.
    pub unwind: Option<i64>,
    /// `kani::solver`, if there is one.
    pub solver: Option<String>,
    /// What it says, as in its doc.
    pub statement: String,
    /// Of which values, as in its doc.
    pub domain: String,
    /// What is outside of that, as in its doc.
    pub not_covered: String,
    /// Parts of the implementation that answer anything in the compiled harness.
    #[serde(default)]
    pub arbitrary: Vec<String>,
    /// An unwinding of CBMC's own, if there is one.
    pub cbmc_unwind: Option<i64>,
    /// Names of its covers; each has to be reached.
    pub covers: BTreeSet<String>,
    /// What the stand-in does: `every` value of the domain, or `some`.
    pub stand_in: String,
    /// What `scripts/prove-wasm` does with it: `quick`, `slow` or `no`.
    pub cbmc: String,
    /// What was seen where CBMC does not prove it.
    pub cbmc_reason: Option<String>,
}

#[derive(Deserialize)]
struct List {
    harness: Vec<Expected>,
}

/// All harnesses, in the order of the file.
pub fn expected() -> Vec<Expected> {
    let list: List = toml::from_str(include_str!("../../expected.toml")).expect("a list");
    list.harness
}
