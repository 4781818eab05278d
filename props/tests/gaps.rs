//! Records of gaps that an attack on the second edition found (`spec/7-fail-safe.md`): those that it
//! accepted wrongly are unsafe now, to the model and to the implementation, but for those listed here.

use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use mufasa_model::input::cycle::Cycle;
use mufasa_model::report::Reading;
use mufasa_model::stages::check;
use mufasa_props::bridge::check_impl;
use mufasa_props::conformance::name;
use mufasa_records::read::{Record, record};

/// How the ids begin of what was accepted wrongly.
const ACCEPTED_WRONGLY: [&str; 8] = [
    "creep-",
    "fast-",
    "start-into-the-way-PlanRemote",
    "plan-of-3s-",
    "first-point-1m-ahead-",
    "lane-change-start-0.49-",
    "overhang-5cm-",
    "start-4m-ahead-100ms-old-",
];

/// What is safe, by how its id begins, and why.
const SAFE: [(&str, &str); 3] = [
    ("hidden-person-MotRemote", "F-42: the true track of another explains who passes it"),
    ("hidden-person-AllRemote", "F-42"),
    ("5cm-before-", "the CAV stands 5 cm before the way of the other: right"),
];

/// The record is safe to the exact model, and to the implementation as well.
fn is_safe(cycle: &Cycle) -> bool {
    let exact = check(cycle, Reading::Exact).expect("valid input");
    let implementation = check_impl(cycle).expect("valid input");
    assert_eq!(name(exact.failed_stage), name(implementation.failed_stage));
    exact.failed_stage.is_none()
}

/// The records, or `None` after a loud line: in `gaps` beside `MUFASA_DATA`, or beside `shared/data`.
fn records() -> Option<String> {
    let data = std::env::var_os("MUFASA_DATA").map_or_else(
        || Path::new(env!("CARGO_MANIFEST_DIR")).join("../../shared/data"),
        PathBuf::from,
    );
    let path = data.join("../gaps/records.jsonl");
    fs::read_to_string(&path)
        .inspect_err(|error| {
            let line = format!("NOT RUN: gaps: {}: {error}; set MUFASA_DATA\n", path.display());
            // The macros' output is captured, and nobody would see it.
            io::stderr().write_all(line.as_bytes()).expect("standard error can be written");
        })
        .ok()
}

#[test]
fn what_was_accepted_wrongly_is_unsafe() {
    let Some(text) = records() else { return };
    let (mut wrong, mut reasons) = (Vec::new(), 0);
    for line in text.lines() {
        let Ok(Record::Cycle { id, cycle }) = record(line) else { panic!("no cycle: {line}") };
        let is_safe = is_safe(&cycle);
        let reason = SAFE.iter().find(|(start, _)| id.starts_with(start) && !id.ends_with("-seen"));
        println!("{id}: {}", if is_safe { "safe" } else { "unsafe" });
        let is_gap = ACCEPTED_WRONGLY.iter().any(|start| id.starts_with(start));
        reasons += usize::from(reason.is_some());
        if reason.is_some() && !is_safe || reason.is_none() && is_gap && is_safe {
            wrong.push(id);
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
    assert_eq!(reasons, 3, "each reason is needed");
}
