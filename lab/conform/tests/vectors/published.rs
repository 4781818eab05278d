//! What is published is what the model answers today, and covers the text.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

use mufasa_conform::vectors;
use mufasa_conform::vectors::flag::Flag;
use mufasa_records as json;
use serde_json::Value;

use crate::{ALL, folder, published};

/// `spec/5-interfaces.md#vectors.1`: a change of a vector, of its id or of an answer is seen here.
/// `mufasa vectors --out vectors` writes them anew.
#[test]
fn the_published_files_are_those_that_are_made_today() {
    let contents = vectors::contents().expect("author and model agree");
    for (name, content) in &contents {
        let there = fs::read_to_string(folder().join(name)).unwrap_or_default();
        assert!(there == *content, "vectors/{name} is not what `mufasa vectors` writes");
    }
}

/// Also of files that others put there.
#[test]
fn the_oracle_gives_every_published_answer() {
    let mut count = 0;
    for (name, lines) in published("jsonl") {
        for line in lines.lines() {
            let vector: Value = serde_json::from_str(line).expect("a vector is JSON");
            let text = match &vector["input"] {
                Value::String(line) => line.clone(),
                record => record.to_string(),
            };
            let answer = serde_json::to_value(json::answer(text.as_bytes(), 1)).expect("JSON");
            assert_eq!(answer, vector["expect"], "{name}: {}", vector["id"]);
            count += 1;
        }
    }
    assert!(count > 1_500, "{count} vectors");
}

/// Requirements that no vector shows, each with the reason.
const NOT_SHOWN: [(&str, &str); 4] = [
    ("spec/1-services.md#service.3", "changes of a service set have no record"),
    ("spec/2-offloading.md#fallback.6", "joins cycles and traces: the program's own wiring"),
    (
        "spec/7-fail-safe.md#when-the-cav-is-where.2",
        "when pose and speed were measured is in no record",
    ),
    ("F-19", "what the remote ENV used is in no record"),
];

/// Names of the requirements of the headings that vectors have to cover.
fn requirements() -> BTreeSet<String> {
    let headings = [
        ("1-services.md", ["service", "composition"].as_slice()),
        ("2-offloading.md", &["requester", "quality-of-service", "fallback"]),
        (
            "3-stages.md",
            &[
                "schedule",
                "distances",
                "stage-i-track-validation",
                "stage-ii-trajectory-to-map",
                "low-level-collision-check-llcc",
                "stage-iii-trajectory-with-tracks",
                "stage-iv-trajectory-with-detections",
                "stage-v-trajectory-with-grid-map",
                "invalid-input",
            ],
        ),
        (
            "7-fail-safe.md",
            &[
                "the-fail-safe-rule-h-14",
                "the-path",
                "when-the-cav-is-where",
                "reach",
                "motions",
                "meeting",
            ],
        ),
    ];
    let mut names = BTreeSet::new();
    for (file, anchors) in headings {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../spec").join(file);
        let text = fs::read_to_string(path).expect("spec/ is there");
        let (mut anchor, mut count) = (String::new(), 0);
        for line in text.lines() {
            if let Some(heading) = line.strip_prefix("## ").or_else(|| line.strip_prefix("# ")) {
                let plain = |c: char| c.is_alphanumeric() || c == ' ' || c == '-';
                let kept: String = heading.to_lowercase().chars().filter(|c| plain(*c)).collect();
                (anchor, count) = (kept.replace(' ', "-"), 0);
            }
            if line.contains("MUST") {
                count += 1;
                if anchors.contains(&anchor.as_str()) {
                    names.insert(format!("spec/{file}#{anchor}.{count}"));
                }
            }
        }
    }
    names.extend([1, 2, 4, 5, 6, 7, 8, 10, 11, 14].map(|n| format!("H-{n:02}")));
    names.extend((1..=48).map(|n| format!("F-{n:02}")));
    names
}

/// Every MUST of stages, schedule, distances, protocol, composition and fail-safe rule has vectors, each with at
/// least two answers if it has several; every rule, every finding, every interpretation.
#[test]
fn every_requirement_rule_finding_and_interpretation_has_vectors() {
    let mut answers: BTreeMap<&str, BTreeSet<String>> = BTreeMap::new();
    for vector in ALL.iter() {
        let expect = serde_json::to_value(&vector.expect).expect("JSON");
        answers.entry(vector.requirement).or_default().insert(expect.to_string());
    }
    let known = requirements();
    assert!(known.len() > 80, "{}", known.len());
    let mut few = Vec::new();
    for name in &known {
        let is_excused = NOT_SHOWN.iter().any(|(excused, _)| excused == name);
        let count = answers.get(name.as_str()).map_or(0, BTreeSet::len);
        if is_excused != (count == 0) || count == 1 {
            few.push(format!("{name}: {count}"));
        }
    }
    assert!(few.is_empty(), "{few:?}");
    for n in 1..=12 {
        let name = format!("I-{n:02}");
        let decides = |flag: Flag| matches!(flag, Flag::Interpretation(it) if it == name);
        assert!(ALL.iter().any(|vector| decides(vector.flag)), "{name} has no vector");
    }
    for configuration in ["Local", "MotRemote", "AllRemote", "PlanRemote"] {
        let prefix = format!("{configuration}-");
        let count = ALL.iter().filter(|vector| vector.id.starts_with(&prefix)).count();
        assert_eq!(count, 200, "{configuration}");
    }
}
