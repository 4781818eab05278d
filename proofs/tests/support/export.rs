//! Judges what `cargo kani --export-json` wrote against `expected.toml`. Kani's exit code and its
//! summary are not enough: a harness that was not selected, an unsatisfied cover or a run that ended
//! early does not show in them.

use std::collections::{BTreeMap, BTreeSet};

use serde_json::Value;

use super::expected::Expected;

/// The release that the workflow installs.
pub const KANI: &str = "0.68.0";

/// Everything that is wrong with these exports taken together; nothing if every expected harness
/// succeeded once, every cover was satisfied, and nothing else was run.
pub fn problems(expected: &[Expected], exports: &[Value]) -> Vec<String> {
    let mut found = Vec::new();
    let mut results: BTreeMap<String, Vec<&Value>> = BTreeMap::new();
    for (at, export) in exports.iter().enumerate() {
        let version = text(&export["metadata"]["kani_version"]);
        if version != KANI {
            found.push(format!("export {at}: written by Kani {version:?}, not {KANI}"));
        }
        let Some(list) = export["verification_results"]["results"].as_array() else {
            found.push(format!("export {at}: no results"));
            continue;
        };
        for result in list {
            results.entry(name(text(&result["harness_id"]))).or_default().push(result);
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

fn judge(expected: &Expected, result: &Value) -> Vec<String> {
    let id = &expected.id;
    let status = text(&result["status"]);
    let checks = result["checks"].as_array().map(Vec::as_slice).unwrap_or_default();
    let mut found = Vec::new();
    if status != "Success" {
        found.push(format!("{id}: {status:?} after {} ms", result["duration_ms"]));
    }
    if checks.is_empty() {
        found.push(format!("{id}: no checks: it ran out of time or memory, or did not start"));
        return found;
    }
    let is_cover = |check: &&Value| text(&check["category"]) == "cover";
    let satisfied: BTreeSet<String> = checks
        .iter()
        .filter(is_cover)
        .filter(|check| text(&check["status"]) == "Satisfied")
        .map(|check| text(&check["description"]).to_owned())
        .collect();
    for missed in expected.covers.difference(&satisfied) {
        found.push(format!("{id}: cover not satisfied: {missed}"));
    }
    for other in satisfied.difference(&expected.covers) {
        found.push(format!("{id}: cover not in expected.toml: {other}"));
    }
    let failed = checks
        .iter()
        .filter(|check| !is_cover(check))
        .filter(|check| !["Success", "Unreachable"].contains(&text(&check["status"])));
    found.extend(
        failed.map(|check| {
            format!("{id}: {}: {}", text(&check["status"]), text(&check["description"]))
        }),
    );
    found
}

fn text(value: &Value) -> &str {
    value.as_str().unwrap_or_default()
}
