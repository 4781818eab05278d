//! Every MUST of `spec/` is named by a test, and every name stands for a MUST.
//!
//! A requirement is a line of `spec/` with a MUST in it. Its name is the file, the anchor of its
//! heading and its place among the requirements under that heading, such as
//! `spec/3-stages.md#distances.2`. The rules H-nn and the interpretations I-nn have names of their
//! own. A test names them in its doc comment or in a comment beside it; a vector names the one that it
//! is of, and `conform/tests/vectors` holds model and implementation to every vector.
//! `cargo test -p mufasa-props --test requirements -- --nocapture` prints the table.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

/// Requirements without a test, each with the reason.
const OPEN: &[(&str, &str)] = &[];

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// Names and first words of all requirements, in the order of `spec/`.
fn requirements() -> Vec<(String, String)> {
    let mut files: Vec<_> = fs::read_dir(root().join("spec"))
        .expect("spec/ is there")
        .map(|entry| entry.expect("a directory entry").path())
        .filter(|path| path.extension().is_some_and(|extension| extension == "md"))
        .collect();
    files.sort();
    let mut found = Vec::new();
    for file in files {
        let text = fs::read_to_string(&file).expect("spec files are readable");
        let name = file.file_name().expect("a file").to_string_lossy().into_owned();
        let (mut anchor, mut count) = (String::new(), 0);
        for line in text.lines() {
            if let Some(heading) = line.trim_start_matches('#').strip_prefix(' ')
                && line.starts_with('#')
            {
                (anchor, count) = (slug(heading), 0);
            }
            if let Some(rule) = rule_of_row(line) {
                found.push((rule.to_string(), line.chars().take(90).collect()));
            }
            if line.contains("MUST") {
                count += 1;
                let words = line.trim_start_matches(['*', ' ']).chars().take(90).collect();
                found.push((format!("spec/{name}#{anchor}.{count}"), words));
            }
        }
    }
    found
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

/// The anchor of a heading as the usual Markdown viewers make it.
fn slug(heading: &str) -> String {
    let kept = heading.to_lowercase();
    kept.chars()
        .filter(|c| c.is_alphanumeric() || matches!(c, ' ' | '-' | '_'))
        .map(|c| if c == ' ' { '-' } else { c })
        .collect()
}

/// Rust files of the workspace, without build products and without this one.
fn sources(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).expect("folders are readable") {
        let path = entry.expect("a directory entry").path();
        let name = path.file_name().expect("a name").to_string_lossy().into_owned();
        if path.is_dir() && name != "target" && !name.starts_with('.') {
            sources(&path, found);
        } else if path.extension().is_some_and(|it| it == "rs") && name != "requirements.rs" {
            found.push(path);
        }
    }
}

/// Requirements and interpretations of the published vectors, with their files.
fn requirements_of_vectors() -> Vec<(String, String)> {
    let mut found = Vec::new();
    for topic in fs::read_dir(root().join("vectors")).expect("vectors/ is there") {
        let topic = topic.expect("a directory entry").path();
        for file in fs::read_dir(&topic).into_iter().flatten() {
            let file = file.expect("a directory entry").path();
            let text = fs::read_to_string(&file).expect("vectors are readable");
            let name = file.strip_prefix(root()).expect("below the root").display().to_string();
            let mut names: BTreeSet<&str> = BTreeSet::new();
            for line in text.lines() {
                for key in ["\"requirement\": \"", "\"flag\": \"interpretation "] {
                    let named = line.split_once(key).map(|(_, rest)| rest);
                    names.extend(named.and_then(|rest| rest.split('"').next()));
                }
            }
            found.extend(names.into_iter().map(|requirement| (requirement.into(), name.clone())));
        }
    }
    found
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
    let requirements = requirements();
    assert!(requirements.len() > 80, "spec/ has about a hundred lines with a MUST");
    let known: BTreeSet<&str> = requirements.iter().map(|(name, _)| name.as_str()).collect();
    let mut files = Vec::new();
    sources(&root(), &mut files);
    let mut named: BTreeMap<String, Vec<String>> = BTreeMap::new();
    for file in files {
        let text = fs::read_to_string(&file).expect("sources are readable");
        if !text.contains("#[test]") && !text.contains("proptest!") {
            continue;
        }
        let path = file.strip_prefix(root()).expect("below the root").display().to_string();
        for name in names_in(&text) {
            named.entry(name).or_default().push(path.clone());
        }
    }
    for (name, file) in requirements_of_vectors() {
        if known.contains(name.as_str()) {
            named.entry(name).or_default().push(file);
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
fn anchors_are_those_of_markdown() {
    assert_eq!(slug("Low-level collision check (LLCC)"), "low-level-collision-check-llcc");
    assert_eq!(slug("Stage v: trajectory with grid map"), "stage-v-trajectory-with-grid-map");
    let names: Vec<_> =
        names_in("see spec/3-stages.md#distances.2, spec/3-stages.md#distances.").collect();
    assert_eq!(names, ["spec/3-stages.md#distances.2"]);
}
