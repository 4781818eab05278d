//! What a witness says in words, for every cycle of `vectors/` that fails.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use mufasa_drives::check::words;
use mufasa_model::numbers::reading::Reading;
use mufasa_model::report::Rule;
use serde_json::Value;

/// The cycles of the vectors, each on a line of its own.
fn cycles() -> String {
    let mut lines = String::new();
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../vectors");
    let folders = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    for folder in folders.filter(|path| path.is_dir()) {
        for file in fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()) {
            if file.extension().is_none_or(|it| it != "jsonl") {
                continue;
            }
            for line in fs::read_to_string(file).unwrap().lines() {
                let vector: Value = serde_json::from_str(line).unwrap();
                if vector["input"]["kind"] == "cycle" {
                    lines.push_str(&vector["input"].to_string());
                    lines.push('\n');
                }
            }
        }
    }
    lines
}

/// The two numbers in brackets at the end and how they compare; `None` where there is one, and the other
/// is the same double.
fn compared(words: &str) -> Option<(f64, &str, f64)> {
    let inner = words.rsplit_once('(').and_then(|(_, rest)| rest.strip_suffix(')')).unwrap();
    if let Some(one) = inner.strip_suffix(" by less than doubles tell apart") {
        assert!(one.starts_with("above ") || one.starts_with("below "), "{words}");
        return None;
    }
    let parts: Vec<_> = inner.split(' ').filter(|it| !["m", "s"].contains(it)).collect();
    let [left, relation, right] = parts[..] else { panic!("{words}") };
    Some((left.parse().unwrap(), relation, right.parse().unwrap()))
}

#[test]
fn the_relation_holds_between_the_numbers_as_they_are_printed() {
    let mut seen: BTreeMap<String, usize> = BTreeMap::new();
    let (mut by_less, mut starts, mut turns) = (0, [0; 2], [0; 2]);
    for (id, cycle) in mufasa_records::cycles_from_lines(&cycles()).into_iter().flatten() {
        let Ok(report) = mufasa_model::stages::check(&cycle, Reading::Exact) else { continue };
        let Some(witness) = words::failed_witness(&report) else { continue };
        let words = words::witness(witness);
        let numbers = compared(&words);
        let holds = numbers.is_none_or(|(left, relation, right)| match relation {
            "<" => left < right,
            "<=" => left <= right,
            ">" => left > right,
            ">=" => left >= right,
            "~" => true,
            _ => panic!("{id}: {words}"),
        });
        assert!(holds, "{id}: {words}");
        by_less += usize::from(numbers.is_none());
        *seen.entry(format!("{:?}", witness.rule)).or_default() += 1;
        let product = usize::from(words.contains("cross product"));
        match witness.rule {
            Rule::StartHeading => starts[product] += 1,
            Rule::StepTurn => turns[product] += 1,
            _ => {}
        }
    }
    assert!(seen.len() > 25, "{seen:?}");
    assert!(
        by_less > 0 && starts.iter().chain(&turns).all(|count| *count > 0),
        "{starts:?} {turns:?}"
    );
}
