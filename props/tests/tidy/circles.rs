//! Circles of a graph, and stages that know what they must not.

use std::collections::{BTreeMap, BTreeSet};

use super::tree::Tree;

/// A node and whom it knows.
pub type Graph = BTreeMap<String, BTreeSet<String>>;

/// The parts of a graph in which each reaches each, of two nodes or more.
pub fn circles(graph: &Graph) -> Vec<(String, String)> {
    let reached = |from: &String| {
        let mut seen = BTreeSet::new();
        let mut next = vec![from];
        while let Some(node) = next.pop() {
            for known in graph.get(node).into_iter().flatten() {
                if seen.insert(known) {
                    next.push(known);
                }
            }
        }
        seen
    };
    let reaches: BTreeMap<_, _> = graph.keys().map(|node| (node, reached(node))).collect();
    let mut found = BTreeSet::new();
    for (node, seen) in &reaches {
        let circle: Vec<&str> = reaches
            .iter()
            .filter(|(other, back)| seen.contains(*other) && back.contains(node))
            .map(|(other, _)| other.as_str())
            .collect();
        if circle.len() > 1 {
            found.insert((circle[0].to_owned(), circle.join(" <-> ")));
        }
    }
    found.into_iter().collect()
}

/// Files of the stages, in model and implementation, that know a rule or the set of rules.
pub fn stages_that_know_rules(tree: &Tree) -> Vec<(String, String)> {
    let is_stage = |path: &str| {
        ["model", "impl"].iter().any(|it| path.starts_with(&format!("{it}/src/stages/")))
            && !path.ends_with("/tests.rs")
    };
    let is_known = |text: &str| {
        ["crate::hardened", "hardened::", "HardenedRule", "Profile"]
            .iter()
            .any(|it| text.contains(it))
    };
    let files = tree.ending(".rs").filter(|(path, text)| is_stage(path) && is_known(text));
    files.map(|(path, _)| (path.to_owned(), "a stage knows no rule".to_owned())).collect()
}

#[test]
fn a_stage_that_knows_a_rule_is_seen() {
    let file = |path: &str, text: &str| (path.to_owned(), text.to_owned());
    let tree = Tree(BTreeMap::from([
        file("impl/src/stages/v.rs", "use crate::hardened::h06;"),
        file("model/src/stages/v.rs", "use crate::stages::llcc;"),
        file("model/src/stages/iv.rs", "use crate::input::profile::HardenedRule;"),
        file("model/src/stages/v/tests.rs", "use crate::input::profile::Profile;"),
        file("model/src/cycle.rs", "use crate::hardened::h06;"),
    ]));
    let found = stages_that_know_rules(&tree);
    let files: Vec<&str> = found.iter().map(|it| it.0.as_str()).collect();
    assert_eq!(files, ["impl/src/stages/v.rs", "model/src/stages/iv.rs"]);
}
