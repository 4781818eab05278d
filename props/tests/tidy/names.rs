//! Names of modules and functions.

use std::collections::{BTreeMap, BTreeSet};

use super::tree::Tree;

/// Folders in which model and implementation have the same modules.
const FOLDERS: [&str; 5] = ["stages", "hardened", "input", "offloading", "services"];

/// Modules of a folder that only one of the two has. What a module has below itself is its own.
pub fn unequal(tree: &Tree) -> Vec<(String, String)> {
    let modules = |folder: &str| -> BTreeSet<String> {
        let below = tree.ending(".rs").filter_map(|(path, _)| path.strip_prefix(folder));
        let modules = below.filter_map(|path| path.strip_prefix('/')?.split(['/', '.']).next());
        modules.filter(|name| *name != "mod").map(str::to_owned).collect()
    };
    let mut wrong = Vec::new();
    for folder in FOLDERS {
        let [model, own] =
            ["model", "impl"].map(|package| modules(&format!("{package}/src/{folder}")));
        for name in &model ^ &own {
            let (has, lacks) =
                if model.contains(&name) { ("model", "impl") } else { ("impl", "model") };
            wrong.push((
                format!("{has}/src/{folder}/{name}"),
                format!("{lacks} has no such module"),
            ));
        }
    }
    wrong
}

/// Functions outside of `impl` blocks that other modules see and that are called like their file.
pub fn functions_like_modules(tree: &Tree) -> Vec<(String, String)> {
    let mut wrong = BTreeMap::new();
    for (path, text) in tree.ending(".rs").filter(|(path, _)| path.contains("/src/")) {
        let mut parts = path.trim_end_matches(".rs").rsplit('/');
        let module = parts.find(|name| *name != "mod").unwrap_or_default();
        for line in text.lines().filter(|line| line.starts_with("pub")) {
            let name = line.split_once("fn ").and_then(|(_, name)| name.split(['(', '<']).next());
            if name == Some(module) {
                wrong.insert(path.to_owned(), format!("{module}::{module}"));
            }
        }
    }
    wrong.into_iter().collect()
}

#[test]
fn names_that_break_the_rules_are_seen() {
    let tree = |files: &[(&str, &str)]| {
        Tree(files.iter().map(|(path, text)| ((*path).to_owned(), (*text).to_owned())).collect())
    };
    let wrong = unequal(&tree(&[
        ("model/src/stages/mod.rs", ""),
        ("model/src/stages/i_track_validation.rs", ""),
        ("impl/src/stages/i_track_validation/mod.rs", ""),
        ("impl/src/stages/i_track_validation/fast.rs", ""),
        ("impl/src/stages/examined.rs", ""),
    ]));
    let wrong: Vec<_> = wrong.into_iter().map(|(place, _)| place).collect();
    assert_eq!(wrong, ["impl/src/stages/examined"]);
    for (path, text, count) in [
        ("a/src/tracks.rs", "pub fn tracks(a: u8) {}\n", 1),
        ("a/src/tracks/mod.rs", "pub(crate) const fn tracks<T>() {}\n", 1),
        ("a/src/tracks.rs", "fn tracks() {}\n", 0),
        ("a/src/tracks.rs", "impl Tracks {\n    pub fn tracks() {}\n}\npub fn track() {}\n", 0),
        ("a/src/close_tracks.rs", "pub fn tracks() {}\n", 0),
    ] {
        assert_eq!(functions_like_modules(&tree(&[(path, text)])).len(), count, "{path} {text}");
    }
}
