//! Judges what `cargo kani --export-json` wrote against `expected.toml`. Kani's exit code and its
//! summary are not enough: a harness that was not selected, an unsatisfied cover or a run that ended
//! early does not show in them.

use std::collections::{BTreeMap, BTreeSet};

use serde::Deserialize;
use serde_json::Value;

use super::expected::Expected;

/// The release that the workflow installs.
pub const KANI: &str = "0.68.0";

#[derive(Deserialize)]
struct Export {
    metadata: Metadata,
    verification_results: Verification,
}

#[derive(Deserialize)]
struct Metadata {
    kani_version: String,
}

#[derive(Deserialize)]
struct Verification {
    results: Vec<Found>,
}

#[derive(Deserialize)]
struct Found {
    harness_id: String,
    status: String,
    duration_ms: f64,
    checks: Vec<Check>,
}

#[derive(Deserialize)]
struct Check {
    category: String,
    status: String,
    description: String,
}

/// Everything that is wrong with these exports taken together; nothing if every expected harness
/// succeeded once, every cover was satisfied, and nothing else was run.
pub fn problems(expected: &[Expected], exports: &[Value]) -> Vec<String> {
    let mut found = Vec::new();
    let mut results: BTreeMap<String, Vec<Found>> = BTreeMap::new();
    for (at, export) in exports.iter().enumerate() {
        match Export::deserialize(export) {
            Ok(export) => {
                let version = export.metadata.kani_version;
                if version != KANI {
                    found.push(format!("export {at}: written by Kani {version:?}, not {KANI}"));
                }
                for result in export.verification_results.results {
                    results.entry(name(&result.harness_id)).or_default().push(result);
                }
            }
            Err(error) => found.push(format!("export {at}: {error}")),
        }
    }
    for one in expected {
        match results.remove(&name(&one.id)).as_deref() {
            None => found.push(format!("{}: missing", one.id)),
            Some([result]) => found.extend(judge(one, result)),
            Some(more) => found.push(format!("{}: run {} times", one.id, more.len())),
        }
    }
    found.extend(results.keys().map(|name| format!("{name}: not in expected.toml")));
    found
}

/// Module and function, whatever stands before them.
fn name(path: &str) -> String {
    let mut parts: Vec<&str> = path.rsplit("::").take(2).collect();
    parts.reverse();
    parts.join("::")
}

fn judge(Expected { id, covers, .. }: &Expected, result: &Found) -> Vec<String> {
    let Found { status, duration_ms, checks, .. } = result;
    let mut found = Vec::new();
    if status != "Success" {
        found.push(format!("{id}: {status:?} after {duration_ms} ms"));
    }
    if checks.is_empty() {
        found.push(format!("{id}: no checks: it ran out of time or memory, or did not start"));
        return found;
    }
    let (all, others): (Vec<_>, Vec<_>) = checks.iter().partition(|it| it.category == "cover");
    let satisfied = all.iter().filter(|check| check.status == "Satisfied");
    let satisfied: BTreeSet<_> = satisfied.map(|check| check.description.clone()).collect();
    let missed = covers.difference(&satisfied);
    found.extend(missed.map(|cover| format!("{id}: cover not satisfied: {cover}")));
    let unknown = satisfied.difference(covers);
    found.extend(unknown.map(|cover| format!("{id}: cover not in expected.toml: {cover}")));
    let failed = others.iter().filter(|it| !["Success", "Unreachable"].contains(&&*it.status));
    found.extend(failed.map(|check| format!("{id}: {}: {}", check.status, check.description)));
    found
}
