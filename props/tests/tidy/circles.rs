//! Circles of modules. A module is a file; it knows another when a path in its code leads there. What a
//! `pub use` hands on is looked for where it comes from. A path that begins with a child counts where
//! the circle has others than the child's parent and what is below it. Tests are not counted.

use std::collections::{BTreeMap, BTreeSet};

use super::tree::Tree;

/// A node and whom it knows.
pub type Graph = BTreeMap<String, BTreeSet<String>>;

/// The circles of modules of each package, each under its first module, with all of it.
pub fn of_modules(tree: &Tree) -> Vec<(String, String)> {
    let manifests = tree.ending("Cargo.toml").filter(|(_, text)| text.contains("[package]"));
    let packages = manifests.map(|(path, _)| path.trim_end_matches("Cargo.toml"));
    let found = packages.flat_map(|package| {
        let folder = format!("{package}src/");
        let [by_name, by_child] = modules(tree, &folder);
        let is_family = |circle: &str| {
            let all: Vec<&str> = circle.split(" <-> ").collect();
            all.iter().all(|it| {
                all[0] == folder || *it == all[0] || it.starts_with(&format!("{}::", all[0]))
            })
        };
        let further = circles(&by_child).into_iter().filter(|(_, circle)| !is_family(circle));
        let all: BTreeMap<_, _> = circles(&by_name).into_iter().chain(further).collect();
        all
    });
    found.collect()
}

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

/// Which module knows which, below a folder of sources: by paths that are imported or begin with
/// `crate`, `self` or `super`, and by these and paths that begin with a child.
fn modules(tree: &Tree, folder: &str) -> [Graph; 2] {
    let mut files = BTreeMap::new();
    for (path, text) in tree.ending(".rs") {
        if let Some(below) = path.strip_prefix(folder) {
            let mut name: Vec<&str> = below.trim_end_matches(".rs").split('/').collect();
            if ["mod", "lib", "main"].contains(name.last().expect("not empty")) {
                name.pop();
            }
            if !name.contains(&"tests") {
                files.insert(name, paths(text));
            }
        }
    }
    let name = |module: &[&str]| format!("{folder}{}", module.join("::"));
    let mut graphs = [Graph::new(), Graph::new()];
    for (module, paths) in &files {
        let mut known = [BTreeSet::new(), BTreeSet::new()];
        for (path, how) in paths.iter().filter(|(_, how)| *how != How::HandedOn) {
            let path: Vec<&str> = path.split("::").map(str::trim).collect();
            let Some(full) = leads_to(module, &path, &files, 8).filter(|it| it != module) else {
                continue;
            };
            let is_bare = *how == How::Elsewhere && !["crate", "self", "super"].contains(&path[0]);
            known[usize::from(is_bare)].insert(name(&full));
        }
        let [by_name, by_child] = known;
        graphs[1].insert(name(module), &by_name | &by_child);
        graphs[0].insert(name(module), by_name);
    }
    graphs
}

/// How a path stands in a file.
#[derive(Clone, Copy, PartialEq)]
enum How {
    /// By `use`.
    Imported,
    /// By `pub use`.
    HandedOn,
    /// In the code.
    Elsewhere,
}

/// Files by their modules, with their paths.
type Files<'a> = BTreeMap<Vec<&'a str>, Vec<(String, How)>>;

/// The module that a path leads to, over at most so many that hand it on.
fn leads_to<'a>(
    module: &[&'a str],
    path: &[&'a str],
    files: &'a Files<'a>,
    most: usize,
) -> Option<Vec<&'a str>> {
    let (start, mut rest) = start(module, path, files);
    let mut full = start?;
    while let Some((first, more)) = rest.split_first() {
        full.push(first);
        if !files.contains_key(&full) {
            full.pop();
            break;
        }
        rest = more;
    }
    let handed = |(path, how): &&(String, How)| {
        *how == How::HandedOn && path.rsplit("::").next() == rest.first().copied()
    };
    let source = files.get(&full).and_then(|paths| paths.iter().find(handed));
    let (Some((path, _)), true) = (source, most > 0) else { return Some(full) };
    let path: Vec<&str> = path.split("::").map(str::trim).collect();
    leads_to(&full, &path, files, most - 1).or(Some(full))
}

/// Where a path begins, and what is left of it; `None` outside of the crate.
fn start<'a, 'b, T>(
    module: &[&'a str],
    path: &'b [&'a str],
    files: &BTreeMap<Vec<&'a str>, T>,
) -> (Option<Vec<&'a str>>, &'b [&'a str]) {
    let (first, rest) = path.split_first().expect("a path is not empty");
    match *first {
        "crate" => (Some(Vec::new()), rest),
        "self" => (Some(module.to_vec()), rest),
        "super" => {
            let up = path.iter().take_while(|part| **part == "super").count();
            let kept = module.len().saturating_sub(up);
            (Some(module[..kept].to_vec()), &path[up..])
        }
        child => {
            let below = [module, &[child]].concat();
            (files.contains_key(&below).then(|| module.to_vec()), path)
        }
    }
}

/// The paths in the code of a file.
fn paths(text: &str) -> Vec<(String, How)> {
    let text = text.split("#[cfg(test)]\nmod tests {").next().unwrap_or_default();
    let code: Vec<&str> =
        text.lines().map(|line| line.split("//").next().unwrap_or_default()).collect();
    let code = code.join("\n");
    let mut found = Vec::new();
    let mut rest = code.as_str();
    let mut elsewhere = String::new();
    while let Some((before, after)) = rest.split_once("use ") {
        let begins = before.rsplit('\n').next().unwrap_or_default();
        let Some((tree, more)) = after.split_once(';').filter(|_| is_start_of_use(begins)) else {
            elsewhere += before;
            elsewhere += " use ";
            rest = after;
            continue;
        };
        elsewhere += before;
        let mut here = Vec::new();
        expand("", tree.trim(), &mut here);
        let how = if begins.contains("pub") { How::HandedOn } else { How::Imported };
        found.extend(here.into_iter().map(|path| (path, how)));
        rest = more;
    }
    elsewhere += rest;
    let part = |c: char| c.is_alphanumeric() || c == '_';
    for (at, _) in elsewhere.match_indices("::") {
        let start = elsewhere[..at].trim_end_matches(part).len();
        if start < at && !elsewhere[..start].ends_with(':') {
            let path = &elsewhere[start..];
            let end = path.find(|c| !(part(c) || c == ':')).unwrap_or(path.len());
            found.push((path[..end].trim_end_matches(':').to_owned(), How::Elsewhere));
        }
    }
    found
}

/// Nothing but a visibility before `use`.
fn is_start_of_use(before: &str) -> bool {
    let before = before.trim();
    before.is_empty() || (before.starts_with("pub") && !before.contains(' '))
}

/// The paths of a tree of a `use`.
fn expand(before: &str, tree: &str, found: &mut Vec<String>) {
    let Some((path, inner)) = tree.split_once('{') else {
        let path = tree.split(" as ").next().unwrap_or_default();
        found.push(format!("{before}{}", path.trim()));
        return;
    };
    let inner = inner.trim_end();
    let inner = inner.strip_suffix('}').unwrap_or(inner);
    let (mut depth, mut from) = (0, 0);
    for (at, c) in inner.char_indices().chain([(inner.len(), ',')]) {
        match c {
            '{' => depth += 1,
            '}' => depth -= 1,
            ',' if depth == 0 => {
                let part = inner[from..at].trim();
                from = (at + 1).min(inner.len());
                if !part.is_empty() {
                    expand(&format!("{before}{}", path.trim()), part, found);
                }
            }
            _ => {}
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found(files: &[(&str, &str)]) -> Vec<String> {
        let mut tree = BTreeMap::from([("a/Cargo.toml".to_owned(), "[package]\n".to_owned())]);
        tree.extend(files.iter().map(|(path, text)| ((*path).to_owned(), (*text).to_owned())));
        of_modules(&Tree(tree)).into_iter().map(|(_, circle)| circle).collect()
    }

    #[test]
    fn a_circle_is_seen_in_every_form() {
        let lib = ("a/src/lib.rs", "pub mod b;\npub mod c;\npub use b::B;\n");
        for (b, c) in [
            ("use crate::c::C;\n", "use super::b::B;\n"),
            ("use crate::{x::Y, c::{C, D}};\n", "fn f() { crate::b::g() }\n"),
            ("fn f() -> super::c::C { todo() }\n", "use crate::b as other;\n"),
        ] {
            let circle = found(&[lib, ("a/src/b.rs", b), ("a/src/c.rs", c)]);
            assert_eq!(circle, ["a/src/b <-> a/src/c"], "{b}{c}");
        }
        let child =
            [lib, ("a/src/b.rs", "mod d;\nuse d::D;\n"), ("a/src/b/d.rs", "use super::B;\n")];
        assert_eq!(found(&child), ["a/src/b <-> a/src/b::d"]);
    }

    #[test]
    fn a_circle_is_seen_through_what_hands_on_and_through_a_bare_child() {
        let lib = ("a/src/lib.rs", "mod b;\nmod c;\npub use c::C;\n");
        let handed = [lib, ("a/src/b.rs", "use crate::C;\n"), ("a/src/c.rs", "use crate::b::B;\n")];
        assert_eq!(found(&handed), ["a/src/b <-> a/src/c"]);
        let bare = [
            lib,
            ("a/src/b.rs", "mod d;\nfn f() { d::g() }\n"),
            ("a/src/b/d.rs", "use crate::c::C;\n"),
            ("a/src/c.rs", "use crate::b::B;\n"),
        ];
        assert_eq!(found(&bare), ["a/src/b <-> a/src/b::d <-> a/src/c"]);
        let family = [lib, bare[1], ("a/src/b/d.rs", "use super::B;\n"), ("a/src/c.rs", "")];
        assert!(found(&family).is_empty());
    }

    #[test]
    fn one_way_is_no_circle_nor_are_tests_and_what_is_handed_on() {
        let files = [
            ("a/src/lib.rs", "pub mod b;\npub mod c;\n"),
            ("a/src/b.rs", "use crate::c::C;\n// crate::b\n"),
            (
                "a/src/c.rs",
                "pub use crate::b::B;\n#[cfg(test)]\nmod tests {\n    use crate::b::B;\n}\n",
            ),
            ("a/src/c/tests.rs", "use crate::b::B;\n"),
        ];
        assert!(found(&files).is_empty());
    }
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
