//! The judge of Kani's export: accepts an export in which all is well, and sees each thing that can
//! be wrong with one.

use serde_json::{Value, json};

#[path = "support/expected.rs"]
mod expected;
#[path = "support/export.rs"]
mod export;

use expected::Expected;
use export::{KANI, problems};

/// As Kani 0.68 writes it with `-Z unstable-options --export-json`: fields that are not read are
/// left out.
fn export(expected: &[Expected]) -> Value {
    let result = |one: &Expected| {
        let check = |status: &str, category: &str, description: &str| {
            json!({
                "id": 1, "function": "harness", "status": status, "description": description,
                "category": category, "location": { "file": "f", "line": "1", "column": "1" },
            })
        };
        let mut checks = vec![
            check("Success", "assertion", "assertion failed: a"),
            check("Unreachable", "unwind", "unwinding assertion loop 0"),
        ];
        checks.extend(one.covers.iter().map(|cover| check("Satisfied", "cover", cover)));
        json!({
            "harness_id": format!("harness::{}", one.id), "status": "Success",
            "duration_ms": 1200, "checks": checks,
        })
    };
    json!({
        "metadata": { "version": "1.0", "kani_version": KANI },
        "verification_results": {
            "summary": { "total_harnesses": expected.len(), "status": "completed" },
            "results": expected.iter().map(result).collect::<Vec<_>>(),
        },
    })
}

#[test]
fn shards_in_which_all_is_well_are_accepted() {
    let expected: Vec<_> =
        expected::expected().into_iter().filter(|one| one.shard.is_some()).collect();
    let shards: Vec<Value> = (1..=2)
        .map(|shard| {
            let of_shard = expected.iter().filter(|one| one.shard == Some(shard));
            let part: Vec<_> = of_shard.cloned().collect();
            export(&part)
        })
        .collect();
    assert_eq!(problems(&expected, &shards), [""; 0]);
}

/// Changes the results of a good export and says what has to be found.
fn spoiled(change: impl FnOnce(&mut Vec<Value>)) -> String {
    let expected = expected::expected();
    let mut export = export(&expected);
    change(export["verification_results"]["results"].as_array_mut().expect("a list"));
    problems(&expected, &[export]).join("; ")
}

#[test]
fn each_thing_that_is_wrong_is_found() {
    let first = expected::expected().remove(0);
    assert_eq!(spoiled(|results| drop(results.remove(0))), format!("{}: missing", first.id));
    assert_eq!(
        spoiled(|results| results.push(results[0].clone())),
        format!("{}: run 2 times", first.id)
    );
    assert_eq!(
        spoiled(|results| {
            let mut other = results[0].clone();
            other["harness_id"] = json!("harness::quality_of_service::verify_another");
            results.push(other);
        }),
        "quality_of_service::verify_another: not in expected.toml"
    );
    assert!(spoiled(|results| results[0]["status"] = json!("Failure")).contains("\"Failure\""));
    let timed_out = spoiled(|results| {
        results[0]["status"] = json!("Failure");
        results[0]["checks"] = json!([]);
    });
    assert!(timed_out.contains("out of time"), "{timed_out}");
    for status in ["Unsatisfiable", "Unreachable", "Undetermined"] {
        let unsatisfied = spoiled(|results| {
            let checks = results[0]["checks"].as_array_mut().expect("a list");
            checks.last_mut().expect("a cover")["status"] = json!(status);
        });
        assert!(unsatisfied.contains("cover not satisfied"), "{unsatisfied}");
    }
    for status in ["Failure", "Undetermined"] {
        let failed = spoiled(|results| results[0]["checks"][0]["status"] = json!(status));
        assert!(failed.contains(&format!("{status}: assertion failed")), "{failed}");
    }
    let renamed = spoiled(|results| {
        let checks = results[0]["checks"].as_array_mut().expect("a list");
        checks.last_mut().expect("a cover")["description"] = json!("another");
    });
    assert!(renamed.contains("cover not satisfied") && renamed.contains("not in expected.toml"));
}

#[test]
fn other_releases_and_other_files_are_found() {
    let expected = expected::expected();
    let mut old = export(&expected);
    old["metadata"]["kani_version"] = json!("0.67.0");
    assert_eq!(problems(&expected, &[old]).len(), 1);
    let empty = problems(&expected, &[json!({})]);
    assert_eq!(empty.len(), expected.len() + 2, "no version, no results, nothing run: {empty:?}");
}
