//! What is published is what the model answers today, and covers the text.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

use mufasa_conform::vectors;
use mufasa_conform::vectors::flag::Flag;

use crate::vectors::{FILES, all, folder};

/// VEC-01: a change of a vector, of its id or of an answer is seen here.
/// `mufasa vectors --out vectors` writes them anew.
#[test]
fn the_published_files_are_those_that_are_made_today() {
    for (name, content) in &vectors::contents(&FILES) {
        let there = fs::read_to_string(folder().join(name)).unwrap_or_default();
        assert!(there == *content, "vectors/{name} is not what `mufasa vectors` writes");
    }
}

/// Requirements that no vector shows, each with the reason.
const NOT_SHOWN: [(&str, &str); 15] = [
    ("SVC-05", "changes of a service set have no record"),
    ("FALL-10", "differences of the whole range are in no trace of allowed times"),
    ("FALL-11", "joins cycles and traces: the program's own wiring"),
    ("SCHED-18", "what reaches control is in no record"),
    ("SCHED-19", "every vector with a failed stage"),
    ("INPUT-07", "every vector with invalid input"),
    ("INPUT-08", "every vector with invalid input"),
    ("H-14.8", "tests of the model ask for the heading of the last place"),
    ("H-14.9", "each witness of a place"),
    ("H-14.14", "of which time pose and speed are is in no record"),
    ("H-14.50", "each witness of the rule"),
    ("SEEN-04", "a term: H-01.1 has its vectors"),
    ("SEEN-05", "a term: SEEN-06 has its vectors"),
    ("SEEN-14", "tests of the model exchange the pasts of two objects"),
    ("F-19", "what the remote ENV used is in no record"),
];

/// Prefixes of the requirements that vectors have to cover.
const COVERED: [&str; 14] = [
    "SVC", "COMP", "REQ", "QOS", "FALL", "SCHED", "DIST", "S1", "S2", "LLCC", "S3", "S4", "S5",
    "INPUT",
];

/// Names of the requirements that vectors have to cover.
fn requirements() -> BTreeSet<String> {
    let mut names = BTreeSet::new();
    for file in ["1-services.md", "2-offloading.md", "3-stages.md"] {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../spec").join(file);
        let text = fs::read_to_string(path).expect("spec/ is there");
        let ids = text.split("**[").skip(1).filter_map(|it| it.split("]**").next());
        let covered = |id: &&str| id.split('-').next().is_some_and(|it| COVERED.contains(&it));
        names.extend(ids.filter(covered).map(str::to_owned));
    }
    names.extend(of_rules());
    names.extend([1, 2, 4, 5, 6, 7, 8, 10, 11, 14].map(|n| format!("H-{n:02}")));
    names.extend(pages("findings").filter(|name| name.starts_with("F-")));
    names
}

/// Names of the pages of a folder, without `.md`.
fn pages(folder: &str) -> impl Iterator<Item = String> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").join(folder);
    let files = fs::read_dir(folder).expect("the folder is there");
    let names = files.map(|file| file.expect("an entry").file_name().into_string().expect("text"));
    names.filter_map(|name| Some(name.strip_suffix(".md")?.to_owned()))
}

/// Ids of the pages of rules.
fn of_rules() -> BTreeSet<String> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../spec/hardened");
    let ids = |page: String| -> Vec<String> {
        let text = fs::read_to_string(folder.join(page + ".md")).expect("text");
        let lines = text.lines().filter_map(|line| line.strip_prefix("- **["));
        lines.filter_map(|line| Some(line.split_once(']')?.0.to_owned())).collect()
    };
    pages("spec/hardened").flat_map(ids).collect()
}

/// Every requirement of stages, schedule, distances, protocol, composition and rules has a vector; every rule and finding has
/// two answers, every interpretation one that decides.
#[test]
fn every_requirement_rule_finding_and_interpretation_has_vectors() {
    let mut answers: BTreeMap<&str, BTreeSet<String>> = BTreeMap::new();
    for vector in all() {
        let expect = serde_json::to_value(&vector.expect).expect("JSON");
        let rule = vector.requirement.split('.').next().filter(|it| it.starts_with("H-"));
        for name in [Some(vector.requirement), rule].into_iter().flatten() {
            answers.entry(name).or_default().insert(expect.to_string());
        }
    }
    let (known, of_rules) = (requirements(), of_rules());
    assert!(known.len() > 80, "{}", known.len());
    let mut few = Vec::new();
    for name in &known {
        let is_excused = NOT_SHOWN.iter().any(|(excused, _)| excused == name);
        let count = answers.get(name.as_str()).map_or(0, BTreeSet::len);
        let is_one = COVERED.contains(&name.split('-').next().unwrap_or_default())
            || of_rules.contains(name);
        let least = if is_one { 1 } else { 2 };
        if is_excused != (count == 0) || (!is_excused && count < least) {
            few.push(format!("{name}: {count}"));
        }
    }
    assert!(few.is_empty(), "{few:?}");
    for n in 1..=12 {
        let name = format!("I-{n:02}");
        let decides = |flag: Flag| matches!(flag, Flag::Interpretation(it) if it == name);
        assert!(all().any(|vector| decides(vector.flag)), "{name} has no vector");
    }
    for configuration in ["Local", "MotRemote", "AllRemote", "PlanRemote"] {
        let prefix = format!("{configuration}-");
        let count = all().filter(|vector| vector.id.starts_with(&prefix)).count();
        assert_eq!(count, 200, "{configuration}");
    }
}
