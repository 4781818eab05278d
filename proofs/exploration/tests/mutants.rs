//! The mutants of `proofs/mutants` still fit the sources: `proofs/mutants/run`, which explores each
//! of them, is for a night, and a patch that no longer applies would be noticed only there.

use std::fs;
use std::path::{Path, PathBuf};

use mufasa_exploration::properties::Law;

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// The lines that a hunk expects, and those that it puts in their place.
fn hunk(body: &str) -> [String; 2] {
    ['-', '+'].map(|sign| {
        let lines = body.lines().skip(1).filter_map(|line| match line.split_at_checked(1) {
            None => Some(""),
            Some((" ", rest)) => Some(rest),
            Some((it, rest)) => it.starts_with(sign).then_some(rest),
        });
        lines.flat_map(|line| [line, "\n"]).collect()
    })
}

#[test]
fn every_mutant_changes_the_sources_and_names_its_property() {
    let mut named = Vec::new();
    let folder = fs::read_dir(root().join("proofs/mutants")).expect("the folder of the mutants");
    for file in folder.map(|entry| entry.expect("a file").path()) {
        if file.extension().is_none_or(|it| it != "patch") {
            continue;
        }
        let name = file.display();
        let text = fs::read_to_string(&file).unwrap_or_else(|error| panic!("{name}: {error}"));
        let property = text.lines().find_map(|line| line.strip_prefix("Property: "));
        let law = Law::ALL.into_iter().find(|law| Some(law.name()) == property);
        let law = law.unwrap_or_else(|| panic!("{name}: {property:?} is no property"));
        let stem = file.file_stem().and_then(|stem| stem.to_str()).expect("a name");
        named.push((law.name(), stem.to_owned()));
        let changes: Vec<_> = text.split("\n--- a/").skip(1).collect();
        assert!(!changes.is_empty(), "{name} changes nothing");
        for change in changes {
            let (path, hunks) = change.split_once('\n').expect("a path");
            let source = fs::read_to_string(root().join(path)).expect(path);
            for body in hunks.split("\n@@ ").skip(1) {
                let [old, new] = hunk(body);
                assert_ne!(old, new, "{name}: a hunk changes nothing");
                assert!(source.contains(&old), "{name} does not fit {path}:\n{old}");
            }
        }
    }
    let said = Law::ALL.into_iter().flat_map(|law| {
        assert!(!law.mutants().is_empty(), "{}: no mutant", law.name());
        law.mutants().iter().map(move |&mutant| (law.name(), mutant.to_owned()))
    });
    let mut said: Vec<_> = said.collect();
    named.sort_unstable();
    said.sort_unstable();
    assert_eq!(named, said, "the patches and `Law::mutants`");
}
