//! Who depends on whom, by the manifests and by the table of ARCHITECTURE.md.

use std::collections::{BTreeMap, BTreeSet};

use toml::Table;

use super::circles::{self, Graph};
use super::tree::Tree;

/// A package: its dependencies among the packages here, and those of its tests alone.
#[derive(Default)]
struct Package {
    dependencies: BTreeSet<String>,
    of_tests: BTreeSet<String>,
    in_lab: bool,
}

/// Circles of packages, their tests included.
pub fn circles(tree: &Tree) -> Vec<(String, String)> {
    let knows = |package: Package| &package.dependencies | &package.of_tests;
    let graph: Graph = packages(tree).into_iter().map(|(name, it)| (name, knows(it))).collect();
    circles::circles(&graph)
}

/// Rows of the table that say something else than the manifests, and packages without a row.
pub fn table_is_wrong(tree: &Tree) -> Vec<(String, String)> {
    let text = tree.0.get("ARCHITECTURE.md").map(String::as_str).unwrap_or_default();
    let mut wrong = Vec::new();
    for (name, package) in packages(tree) {
        let start = format!("| {name} | ");
        let row = text.lines().find_map(|line| line.split_once(&start).map(|(_, rest)| rest));
        let said = row.and_then(|rest| rest.trim_end_matches([' ', '|']).split_once(" | "));
        let (of_all, of_tests) = said
            .map(|(_, said)| said.split_once("its tests:").unwrap_or((said, "")))
            .unwrap_or_default();
        let differs = |said: &str, right: &BTreeSet<String>| {
            let said: BTreeSet<_> =
                said.split([',', ';', ' ']).filter(|it| !it.is_empty()).collect();
            let short =
                |name: &String| name.trim_start_matches("mufasa-").replace("mufasa", "impl");
            said != right.iter().map(short).collect::<Vec<_>>().iter().map(String::as_str).collect()
        };
        if row.is_none()
            || differs(of_all, &package.dependencies)
            || differs(of_tests, &package.of_tests)
        {
            let right = format!("{:?}; its tests: {:?}", package.dependencies, package.of_tests);
            wrong.push((name, format!("the table says something else than the manifest: {right}")));
        }
    }
    wrong
}

/// Packages outside of `lab/` that need one in it, for their tests alone, too.
pub fn need_the_laboratory(tree: &Tree) -> Vec<(String, String)> {
    let packages = packages(tree);
    let in_lab = |name: &&String| packages[*name].in_lab;
    let apart = packages.iter().filter(|(_, it)| !it.in_lab);
    let needs = apart.flat_map(|(name, it)| {
        let needed = it.dependencies.union(&it.of_tests).filter(in_lab);
        needed.map(move |it| (name.clone(), format!("needs {it} of the laboratory")))
    });
    needs.collect()
}

/// That the changelog does not begin with the version of the workspace.
pub fn changes_of_another_version(tree: &Tree) -> Vec<(String, String)> {
    let text = |path: &str| tree.0.get(path).map(String::as_str).unwrap_or_default();
    let manifest: Table = text("Cargo.toml").parse().expect("a manifest");
    let version = manifest["workspace"]["package"]["version"].as_str();
    let first = text("CHANGELOG.md").lines().find_map(|line| line.strip_prefix("## "));
    let is_wrong = version.is_none() || first != version;
    let wrong =
        ("CHANGELOG.md".to_owned(), format!("begins with {first:?}, and this is {version:?}"));
    is_wrong.then_some(wrong).into_iter().collect()
}

fn packages(tree: &Tree) -> BTreeMap<String, Package> {
    let manifests: Vec<(&str, Table)> = tree
        .ending("Cargo.toml")
        .map(|(path, text)| (path, text.parse().unwrap_or_else(|error| panic!("{path}: {error}"))))
        .filter(|(_, manifest): &(_, Table)| manifest.contains_key("package"))
        .collect();
    let name = |manifest: &Table| manifest["package"]["name"].as_str().map(str::to_owned);
    let names: BTreeSet<_> = manifests.iter().filter_map(|(_, it)| name(it)).collect();
    let of = |manifest: &Table, table: &str| -> BTreeSet<String> {
        let table = manifest.get(table).and_then(|table| table.as_table());
        let all = table.into_iter().flat_map(Table::keys).cloned();
        all.filter(|name| names.contains(name)).collect()
    };
    let package = |(path, manifest): &(&str, Table)| {
        let dependencies = &of(manifest, "dependencies") | &of(manifest, "build-dependencies");
        let of_tests = &of(manifest, "dev-dependencies") - &dependencies;
        let in_lab = path.starts_with("lab/");
        Some((name(manifest)?, Package { dependencies, of_tests, in_lab }))
    };
    manifests.iter().filter_map(package).collect()
}

#[test]
fn circles_and_wrong_rows_are_seen() {
    let manifest = |name: &str, rest: &str| format!("[package]\nname = \"{name}\"\n{rest}");
    let mut files = BTreeMap::from([
        (
            "a/Cargo.toml".to_owned(),
            manifest("a", "[dependencies]\nb.workspace = true\nserde = \"1\"\n"),
        ),
        ("b/Cargo.toml".to_owned(), manifest("b", "[dev-dependencies.a]\npath = \"../a\"\n")),
        (
            "ARCHITECTURE.md".to_owned(),
            "| `a/` | a | first | b |\n| `b/` | b | second | |\n".to_owned(),
        ),
    ]);
    assert_eq!(circles(&Tree(files.clone())), [("a".to_owned(), "a <-> b".to_owned())]);
    let wrong: Vec<_> =
        table_is_wrong(&Tree(files.clone())).into_iter().map(|(name, _)| name).collect();
    assert_eq!(wrong, ["b"]);
    files.insert("b/Cargo.toml".to_owned(), manifest("b", ""));
    assert!(circles(&Tree(files.clone())).is_empty() && table_is_wrong(&Tree(files)).is_empty());
}

#[test]
fn a_package_that_needs_the_laboratory_is_seen() {
    let of = |b: &str| {
        let a = "[package]\nname = \"a\"\n[dev-dependencies]\nb.workspace = true\n";
        let files = [
            ("a/Cargo.toml", a),
            (b, "[package]\nname = \"b\"\n[dependencies]\na.workspace = true\n"),
        ];
        need_the_laboratory(&Tree(
            files.map(|(path, text)| (path.to_owned(), text.to_owned())).into(),
        ))
    };
    assert_eq!(of("lab/b/Cargo.toml"), [("a".to_owned(), "needs b of the laboratory".to_owned())]);
    assert_eq!(of("b/Cargo.toml"), []);
}

#[test]
fn changes_of_another_version_are_seen() {
    let of = |version: &str| {
        let manifest = format!("[workspace.package]\nversion = \"{version}\"\n");
        let files = [("Cargo.toml", manifest), ("CHANGELOG.md", "# A\n\n## 0.2.0\n".to_owned())];
        Tree(files.map(|(path, text)| (path.to_owned(), text)).into())
    };
    assert_eq!(changes_of_another_version(&of("0.3.0")).len(), 1);
    assert_eq!(changes_of_another_version(&of("0.2.0")), []);
}
