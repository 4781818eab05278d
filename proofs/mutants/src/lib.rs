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
    /// Every reachable state of the offloading protocol.
    Exploration,
    /// Harnesses run natively.
    Harnesses,
    /// Harnesses compiled, judged by CBMC.
    Cbmc,
    /// Vectors and properties of the monitor; a claim is a requirement of `spec/monitor.md`.
    Monitor,
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

impl Mutant {
    /// FNV-1a of what is changed, 64 bits in hex, as `fingerprint` in `scripts/copies.py`.
    pub fn fingerprint(&self) -> String {
        let parts = self.at.iter().flat_map(|place| [&place.item, &place.from, &place.to]);
        let bytes = parts.flat_map(|part| {
            let len = u64::try_from(part.len()).unwrap_or(u64::MAX).to_le_bytes();
            len.into_iter().chain(part.bytes())
        });
        let step = |hash: u64, byte| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
        format!("{:016x}", bytes.fold(0xcbf2_9ce4_8422_2325, step))
    }
}

/// What `scripts/mutants cbmc` saw of a claim under a change.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Seen {
    /// The change.
    pub change: String,
    /// The claim.
    pub claim: String,
    /// What CBMC said, or `not run`.
    pub found: String,
    /// `Mutant::fingerprint` of what was run.
    pub mutant: String,
    /// Time of the processor, s.
    pub seconds: Option<f64>,
    /// What `scripts/prove-wasm --hash` said of the sources before the change.
    pub sources: Option<String>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Record {
    seen: Vec<Seen>,
}

/// The record of the last runs under CBMC. Errors: it is no such TOML.
pub fn seen() -> Result<Vec<Seen>, toml::de::Error> {
    let record: Record = toml::from_str(include_str!("../../mutants-cbmc.toml"))?;
    Ok(record.seen)
}

/// All mutants. Errors: the list is no such TOML.
pub fn all() -> Result<Vec<Mutant>, toml::de::Error> {
    let list: List = toml::from_str(include_str!("../../mutants.toml"))?;
    Ok(list.mutant)
}

/// The changes that refute this claim with one of these engines.
pub fn changes<'a>(mutants: &'a [Mutant], engines: &[Engine], claim: &str) -> Vec<&'a Mutant> {
    let refutes = |mutant: &&Mutant| {
        let claims = engines.iter().filter_map(|engine| mutant.refutes.get(engine));
        claims.flatten().any(|one| one == claim)
    };
    mutants.iter().filter(refutes).collect()
}
