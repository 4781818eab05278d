//! The judge of Kani's export: accepts an export in which all is well, and sees each thing that can
//! be wrong with one.

use serde_json::{Value, json};

use super::expected::{Expected, expected};
use super::export::{KANI, problems};

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
    let expected: Vec<_> = expected().into_iter().filter(|one| one.shard.is_some()).collect();
    let shards: Vec<Value> = (1..=2)
        .map(|shard| {
            let of_shard = expected.iter().filter(|one| one.shard == Some(shard));
            let part: Vec<_> = of_shard.cloned().collect();
            export(&part)
        })
        .collect();
    assert_eq!(problems(&expected, &shards), [""; 0]);
}

type Change = fn(&mut Vec<Value>);

#[test]
fn each_thing_that_is_wrong_is_found() {
    fn cover(results: &mut [Value]) -> &mut Value {
        results[0]["checks"].as_array_mut().and_then(|checks| checks.last_mut()).expect("a cover")
    }
    let first = &expected()[0].id;
    let (missing, twice) = (format!("{first}: missing"), format!("{first}: run 2 times"));
    let faults: [(Change, &[&str]); 10] = [
        (|it| drop(it.remove(0)), &[&missing]),
        (|it| it.push(it[0].clone()), &[&twice]),
        (
            |it| {
                it.push(it[0].clone());
                it[1]["harness_id"] = json!("harness::quality_of_service::verify_another");
            },
            &["quality_of_service::verify_another: not in expected.toml"],
        ),
        (|it| it[0]["status"] = json!("Failure"), &["\"Failure\""]),
        (|it| it[0]["checks"] = json!([]), &["out of time"]),
        (|it| cover(it)["status"] = json!("Unsatisfiable"), &["cover not satisfied"]),
        (|it| cover(it)["status"] = json!("Unreachable"), &["cover not satisfied"]),
        (
            |it| cover(it)["description"] = json!("another"),
            &["cover not satisfied", "not in expected.toml"],
        ),
        (|it| it[0]["checks"][0]["status"] = json!("Failure"), &["Failure: assertion failed"]),
        (|it| it[0]["checks"][0]["status"] = json!("Undetermined"), &["Undetermined: assertion"]),
    ];
    for (change, said) in faults {
        let expected = expected();
        let mut export = export(&expected);
        change(export["verification_results"]["results"].as_array_mut().expect("a list"));
        let found = problems(&expected, &[export]).join("; ");
        assert!(said.iter().all(|said| found.contains(said)), "{said:?}: {found}");
    }
}

#[test]
fn other_releases_and_other_files_are_found() {
    let expected = expected();
    let mut old = export(&expected);
    old["metadata"]["kani_version"] = json!("0.67.0");
    assert_eq!(problems(&expected, &[old]).len(), 1);
    let empty = problems(&expected, &[json!({})]);
    assert_eq!(empty.len(), expected.len() + 1, "no version, nothing run: {empty:?}");
}
