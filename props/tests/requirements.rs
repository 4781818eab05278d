//! Every MUST of `spec/` is named by a test, and every name stands for a MUST.
//!
//! A requirement is a line of `spec/` with a MUST in it. Its name is the file, the anchor of its
//! heading and its place among the requirements under that heading, such as
//! `spec/3-stages.md#distances.2`. The rules H-nn and the interpretations I-nn have names of their
//! own. A test names them in its doc comment or in a comment beside it; a vector names the one that it
//! is of, and `lab/conform/tests/vectors` holds model and implementation to every vector.
//! `cargo test -p mufasa-props --test requirements -- --nocapture` prints the table.

mod tree;

use std::collections::{BTreeMap, BTreeSet};

use tree::{Tree, sections};

/// Requirements without a test, each with the reason.
const OPEN: &[(&str, &str)] = &[];

/// Names and first words of all requirements, in the order of `spec/`.
fn requirements(tree: &Tree) -> Vec<(String, String)> {
    let mut found = Vec::new();
    for (file, text) in tree.ending(".md").filter(|(path, _)| is_normative(path)) {
        for section in sections(text) {
            let mut count = 0;
            for line in section.lines {
                let words = line.trim_start_matches(['*', ' ', '|']).chars().take(90).collect();
                if let Some(rule) = rule_of_row(line) {
                    found.push((rule.to_owned(), words));
                } else if line.contains("MUST") {
                    count += 1;
                    found.push((format!("{file}#{}.{count}", section.anchor), words));
                }
            }
        }
    }
    found
}

/// `spec/3-stages.md`, but not `spec/CHANGES.md`.
fn is_normative(path: &str) -> bool {
    path.strip_prefix("spec/").is_some_and(|name| name.starts_with(|c: char| c.is_ascii_digit()))
}

/// `| H-04 | ...` is the row of a rule, `| I-02 | ...` of an interpretation.
fn rule_of_row(line: &str) -> Option<&str> {
    let name = line.strip_prefix("| ")?.split(' ').next()?;
    is_rule(name).then_some(name)
}

fn is_rule(name: &str) -> bool {
    let digits = name.strip_prefix("H-").or_else(|| name.strip_prefix("I-"));
    digits.is_some_and(|digits| digits.len() == 2 && digits.chars().all(|c| c.is_ascii_digit()))
}

/// Names in a text: `spec/<file>#<anchor>.<number>`, `H-<number>`, `I-<number>`.
fn names_in(text: &str) -> impl Iterator<Item = String> {
    let rules = ["H-", "I-"].into_iter().flat_map(|kind| text.match_indices(kind));
    let rules = rules.filter_map(|(start, _)| text.get(start..start + 4).filter(|n| is_rule(n)));
    rules.map(String::from).chain(places_in(text))
}

fn places_in(text: &str) -> impl Iterator<Item = String> {
    text.match_indices("spec/").filter_map(|(start, _)| {
        let rest = &text[start..];
        let end = rest
            .find(|c: char| !(c.is_alphanumeric() || matches!(c, '/' | '.' | '#' | '-' | '_')))
            .unwrap_or(rest.len());
        let name = rest[..end].trim_end_matches('.');
        let (place, number) = name.rsplit_once('.')?;
        (place.contains('#') && number.parse::<usize>().is_ok()).then(|| name.to_string())
    })
}

#[test]
fn every_must_is_named_by_a_test() {
    let tree = Tree::here();
    let requirements = requirements(&tree);
    assert!(requirements.len() > 80, "spec/ has about a hundred lines with a MUST");
    let known: BTreeSet<&str> = requirements.iter().map(|(name, _)| name.as_str()).collect();
    let mut named: BTreeMap<String, Vec<&str>> = BTreeMap::new();
    for (path, text) in tree.ending(".rs").filter(|(path, _)| !path.ends_with("requirements.rs")) {
        if text.contains("#[test]") || text.contains("proptest!") {
            names_in(text).for_each(|name| named.entry(name).or_default().push(path));
        }
    }
    for (path, text) in tree.ending(".jsonl").filter(|(path, _)| path.starts_with("vectors/")) {
        for line in text.lines() {
            let value = |key: &str| {
                let (_, rest) = line.split_once(&format!("\"{key}\": \""))?;
                rest.split('"').next()
            };
            // The flag of a vector that depends on an interpretation ends in the interpretation.
            let flag = value("flag").and_then(|flag| flag.strip_prefix("interpretation "));
            for name in [value("requirement"), flag].into_iter().flatten() {
                let files = named.get(name);
                if known.contains(name) && !files.is_some_and(|files| files.contains(&path)) {
                    named.entry(name.to_owned()).or_default().push(path);
                }
            }
        }
    }
    let mut open = Vec::new();
    for (name, why) in OPEN {
        assert!(known.contains(name), "{name} is no requirement");
        assert!(!named.contains_key(*name), "{name} has a test and is no longer open: {why}");
    }
    for (name, words) in &requirements {
        let files = named.get(name).map(Vec::as_slice).unwrap_or_default();
        println!("{name}\n    {words}\n    {}", files.join(" "));
        if files.is_empty() && !OPEN.iter().any(|(open, _)| open == name) {
            open.push(format!("{name}: {words}"));
        }
    }
    let strangers: Vec<_> = named.keys().filter(|name| !known.contains(name.as_str())).collect();
    assert!(strangers.is_empty(), "names without a requirement: {strangers:#?}");
    assert!(open.is_empty(), "requirements without a test: {open:#?}");
}

#[test]
fn a_name_ends_where_the_sentence_goes_on() {
    let names: Vec<_> =
        names_in("see spec/3-stages.md#distances.2, spec/3-stages.md#distances.").collect();
    assert_eq!(names, ["spec/3-stages.md#distances.2"]);
}
