//! Who may know whom: model and implementation share no code, and the implementation needs
//! nothing but `libm`. Read from the manifests, so that a new dependency fails here.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

/// Names under a table of a manifest, such as `dependencies`.
fn names(manifest: &str, table: &str) -> BTreeSet<String> {
    let manifest: toml::Table = manifest.parse().expect("a manifest is TOML");
    let table = manifest.get(table).and_then(|table| table.as_table());
    table.into_iter().flat_map(toml::Table::keys).cloned().collect()
}

fn manifest(package: &str) -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("..").join(package).join("Cargo.toml");
    fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// All tables in which a dependency can stand, those of targets included.
fn all_dependencies(manifest: &str) -> BTreeSet<String> {
    let mut found = BTreeSet::new();
    for table in ["dependencies", "dev-dependencies", "build-dependencies"] {
        found.extend(names(manifest, table));
    }
    assert!(!manifest.contains("[target."), "read dependencies of targets too");
    found
}

/// The packages of the workspace by their names.
fn workspace() -> Vec<String> {
    let root = manifest(".");
    let (_, members) = root.split_once("members = [").expect("the members of the workspace");
    let (members, _) = members.split_once(']').expect("the end of the list");
    let name = |member: &str| {
        let manifest = manifest(member.trim().trim_matches('"'));
        let mut lines = manifest.lines();
        let name = lines.find_map(|line| line.strip_prefix("name = "));
        name.expect("a package has a name").trim_matches('"').to_owned()
    };
    let names: Vec<String> = members.split(',').map(name).collect();
    assert!(names.len() >= 7 && names.iter().any(|name| name == "mufasa-capi"), "{names:?}");
    names
}

#[test]
fn model_and_implementation_know_no_crate_of_the_workspace() {
    for package in ["model", "impl"] {
        let dependencies = all_dependencies(&manifest(package));
        for name in workspace() {
            assert!(!dependencies.contains(&name), "{package} depends on {name}");
        }
        assert!(!manifest(package).contains("path ="), "{package} has a dependency by path");
    }
}

#[test]
fn the_implementation_needs_libm_and_at_most_optional_serde() {
    let manifest = manifest("impl");
    let mut dependencies = names(&manifest, "dependencies");
    assert!(dependencies.remove("libm"), "the manifest was not understood");
    if dependencies.remove("serde") {
        assert!(manifest.contains("optional = true"), "serde has to be optional");
    }
    assert_eq!(dependencies, BTreeSet::new());
    assert_eq!(names(&manifest, "build-dependencies"), BTreeSet::new());
}

/// Laws are for whoever runs the implementation, a model checker too: they know nothing else.
#[test]
fn laws_know_the_implementation_alone() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../proofs/src/law");
    let mut files = 0;
    for entry in fs::read_dir(&folder).expect("the folder of the laws") {
        let text = fs::read_to_string(entry.expect("a file").path()).expect("a source");
        for name in workspace().iter().map(|name| name.replace('-', "_")) {
            let known = name == "mufasa";
            assert!(known || !text.contains(&name), "a law names {name}");
        }
        files += 1;
    }
    assert!(files >= 3, "the laws are gone");
}

/// The rule can fail: a manifest that breaks it is seen to.
#[test]
fn a_forbidden_dependency_is_seen_in_every_form() {
    for text in [
        "[dependencies]\nmufasa = { path = \"../impl\" }\n",
        "[dependencies]\nmufasa.workspace = true\n",
        "[dependencies.mufasa]\nversion = \"1\"\n",
        "[package]\nname = \"x\"\n\n[dev-dependencies]\n# why\nmufasa = \"0.1\"\n",
    ] {
        assert!(all_dependencies(text).contains("mufasa"), "{text}");
    }
}
