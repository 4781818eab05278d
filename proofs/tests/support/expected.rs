//! `proofs/expected.toml`: what is expected of each harness.

use std::collections::BTreeSet;
use std::path::Path;

use toml::{Table, Value};

/// What is expected of one harness.
#[derive(Clone, Debug, PartialEq, Eq)]
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
    pub arbitrary: bool,
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

/// All harnesses, in the order of the file.
pub fn expected() -> Vec<Expected> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("expected.toml");
    let text = std::fs::read_to_string(&path).expect("expected.toml is there");
    let table: Table = text.parse().expect("expected.toml is TOML");
    let list = table["harness"].as_array().expect("a list of harnesses");
    list.iter().map(|entry| one(entry.as_table().expect("a table"))).collect()
}

fn one(entry: &Table) -> Expected {
    let text = |key: &str| entry.get(key).and_then(Value::as_str).map(str::to_owned);
    let required = |key: &str| text(key).unwrap_or_else(|| panic!("{key} is missing: {entry:?}"));
    let covers = entry["covers"].as_array().expect("a list of covers");
    Expected {
        id: required("id"),
        shard: entry.get("shard").and_then(Value::as_integer),
        unwind: entry.get("unwind").and_then(Value::as_integer),
        solver: text("solver"),
        statement: required("statement"),
        domain: required("domain"),
        not_covered: required("not_covered"),
        arbitrary: entry.contains_key("arbitrary"),
        cbmc_unwind: entry.get("cbmc_unwind").and_then(Value::as_integer),
        covers: covers.iter().map(|name| name.as_str().expect("a name").to_owned()).collect(),
        stand_in: required("stand_in"),
        cbmc: required("cbmc"),
        cbmc_reason: text("cbmc_reason"),
    }
}
