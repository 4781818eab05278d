//! The published schemas fit the published lines, and refuse what the reader refuses.

use std::collections::BTreeSet;

use jsonschema::Validator;
use serde_json::Value;

use crate::vectors::{folder, published};

fn validator(name: &str) -> Validator {
    let file = folder().join(format!("schemas/{name}.schema.json"));
    let text = std::fs::read_to_string(file).expect("the schema is published");
    let schema = serde_json::from_str(&text).expect("a schema is JSON");
    jsonschema::validator_for(&schema).expect("a valid schema")
}

/// VEC-01 CYCLE-06.
#[test]
fn every_published_line_validates() {
    let vector = validator("vector");
    let kinds = ["cycle", "offloading", "composition"];
    let records = kinds.map(|kind| (kind, validator(kind)));
    let mut seen = BTreeSet::new();
    for (name, lines) in published("jsonl") {
        for line in lines.lines() {
            let line: Value = serde_json::from_str(line).expect("a vector is JSON");
            if let Some(error) = vector.iter_errors(&line).next() {
                panic!("{name} {}: {error}", line["id"]);
            }
            let input = &line["input"];
            if let Some((kind, record)) = records.iter().find(|(kind, _)| input["kind"] == *kind) {
                assert!(record.is_valid(input), "{name} {}", line["id"]);
                seen.insert(*kind);
            }
        }
    }
    assert_eq!(seen.len(), kinds.len());
}

/// Lines that only a reader of the text can refuse: JSON Schema sees values, not how they are
/// written, takes 1.0 for an integer, and knows no bitmaps.
const ONLY_THE_TEXT: [&str; 12] = [
    "-now-fraction",
    "-now-exponent",
    "-now-twice",
    "-ego-twice",
    "-track-id-fraction",
    "-bitmap-length",
    "-bitmap-alphabet",
    "-beyond-doubles",
    "-parameter-fraction",
    "-parameter-negative",
    "-station-fraction",
    "-services-twice",
];

/// A line that is JSON and breaks the schema for the reader breaks the published one, too.
#[test]
fn what_the_reader_refuses_the_schemas_refuse() {
    let validators = [
        ("cycle-lines", validator("cycle")),
        ("offloading-lines", validator("offloading")),
        ("composition-lines", validator("composition")),
    ];
    let mut refused = 0;
    for (name, lines) in published("jsonl") {
        let Some((_, validator)) = validators.iter().find(|(kind, _)| name.contains(kind)) else {
            continue;
        };
        for line in lines.lines() {
            let line: Value = serde_json::from_str(line).expect("a vector is JSON");
            let id = line["id"].as_str().expect("an id");
            let text = line["input"].as_str().expect("a line");
            let Ok(value) = serde_json::from_str::<Value>(text) else { continue };
            if ONLY_THE_TEXT.iter().any(|it| id.ends_with(it)) {
                continue;
            }
            assert!(!validator.is_valid(&value), "{id}: the schema accepts {text}");
            refused += 1;
        }
    }
    assert!(refused > 30, "{refused}");
}

/// Every rule that the schema of an answer knows is the rule of some witness, so none is missing
/// from the vectors and none of the schema's words is made up. `work_limit` and `ambiguous` are no
/// rules of the exact model, whose witnesses are published: only the strict model and implementations
/// name them.
#[test]
fn every_rule_of_a_witness_occurs() {
    let schemas = published("json");
    let (_, cycle) =
        schemas.iter().find(|(name, _)| name.contains("cycle-answer")).expect("published");
    let schema: Value = serde_json::from_str(cycle).expect("JSON");
    let rules = schema["$defs"]["Rule"].clone();
    let listed: BTreeSet<String> = strings(&rules).collect();
    assert!(listed.len() >= 23, "{listed:?}");
    let lines: Vec<String> = published("jsonl").into_iter().map(|(_, lines)| lines).collect();
    let strict_only = ["ambiguous", "work_limit"];
    assert!(strict_only.iter().all(|rule| listed.contains(*rule)), "{listed:?}");
    for rule in listed.into_iter().filter(|rule| !strict_only.contains(&rule.as_str())) {
        let word = format!("\"rule\":\"{rule}\"");
        assert!(lines.iter().any(|text| text.contains(&word)), "no witness of {rule}");
    }
}

/// The values of `enum` and `const` anywhere in a schema.
fn strings(schema: &Value) -> Box<dyn Iterator<Item = String> + '_> {
    match schema {
        Value::Object(fields) => Box::new(fields.iter().flat_map(|(key, value)| {
            let own: Vec<String> = match (key.as_str(), value) {
                ("const", Value::String(word)) => vec![word.clone()],
                ("enum", Value::Array(words)) => {
                    words.iter().filter_map(|word| word.as_str().map(String::from)).collect()
                }
                _ => strings(value).collect(),
            };
            own.into_iter()
        })),
        Value::Array(items) => Box::new(items.iter().flat_map(strings)),
        Value::Null | Value::Bool(_) | Value::Number(_) | Value::String(_) => {
            Box::new(std::iter::empty())
        }
    }
}
