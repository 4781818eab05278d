//! Model and implementation on every published vector (`spec/5-interfaces.md#vectors`): what `vectors/` shows has no
//! second test of its own.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use mufasa_model::cycle::check;
use mufasa_model::report::Reading;
use mufasa_props::bridge;
use mufasa_props::refine::Pair;
use mufasa_records::{self as json, Record};
use serde_json::Value;
use serde_json::value::RawValue;

/// A vector: its keys with their text, since a JSON library may change a last digit.
type Vector = BTreeMap<String, Box<RawValue>>;

/// Calls a job with every published vector and its line.
fn each(mut job: impl FnMut(&Vector, &str)) {
    let mut open = vec![Path::new(env!("CARGO_MANIFEST_DIR")).join("../vectors")];
    while let Some(folder) = open.pop() {
        let entries = fs::read_dir(folder).expect("the vectors are published");
        let paths: Vec<PathBuf> = entries.map(|it| it.expect("a directory entry").path()).collect();
        for path in paths {
            if path.is_dir() {
                open.push(path);
            } else if path.extension().is_some_and(|it| it == "jsonl") {
                for line in fs::read_to_string(path).expect("text").lines() {
                    let vector: Vector = serde_json::from_str(line).expect("a vector is JSON");
                    let input = vector["input"].get();
                    job(&vector, &serde_json::from_str(input).unwrap_or_else(|_| input.to_owned()));
                }
            }
        }
    }
}

/// With every outcome and witness, and the verdicts of the strict and the lax reading.
#[test]
fn the_model_gives_every_published_answer() {
    let mut count = 0;
    each(|vector, line| {
        let answer = serde_json::to_value(json::answer(line.as_bytes(), 1)).expect("JSON");
        let expected: Value = serde_json::from_str(vector["expect"].get()).expect("JSON");
        assert_eq!(answer, expected, "{}: {}", vector["id"], vector["note"]);
        count += 1;
    });
    assert!(count > 2_000, "{count}");
}

#[test]
fn the_implementation_conforms_on_every_published_vector() {
    let mut count = BTreeMap::<&str, u32>::new();
    each(|vector, line| {
        let kind = match json::parse(line.as_bytes(), 1) {
            Ok(Record::Cycle { cycle, .. }) => {
                let [exact, strict] = [Reading::Exact, Reading::Strict].map(|it| check(&cycle, it));
                let found = bridge::check_impl(&cycle);
                if let Err(disagreement) = bridge::conforms(&exact, &strict, &found) {
                    panic!("{}: {disagreement}", vector["id"]);
                }
                "cycle"
            }
            Ok(Record::Offloading { trace, .. }) => {
                let mut pair = Pair::new(trace.profile, trace.parameters).expect("it starts");
                for event in &trace.events {
                    if let Err(difference) = pair.step(event) {
                        panic!("{}: {difference}", vector["id"]);
                    }
                }
                "offloading"
            }
            // The implementation has no services, and reads no lines; `tests/monitor` compares monitors.
            Ok(Record::Composition { .. } | Record::Monitor { .. }) | Err(_) => "other",
        };
        *count.entry(kind).or_default() += 1;
    });
    assert!(count["cycle"] > 1_300 && count["offloading"] > 100, "{count:?}");
}
