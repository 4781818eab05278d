//! Which requirements have no code, and all of them as a table.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use super::citations::{Citations, is_code, is_proof};
use super::ids::{PREFIXES, Requirement, prefix, rule};
use super::tree::Tree;

/// Of each prefix the folders of its code, none where its column has `-`, and its relevance.
fn prefixes(tree: &Tree) -> BTreeMap<&str, (Vec<&str>, &str)> {
    let row = |line| {
        let cells: Vec<&str> = str::split(line, '|').map(str::trim).collect();
        let [_, name, _, folders, relevance, _] = cells[..] else { return None };
        let of = folders.split(", ").map(|it| it.trim_matches('`')).filter(|it| *it != "-");
        Some((name.trim_matches('`'), (of.collect(), relevance)))
    };
    table(tree).lines().filter_map(row).collect()
}

/// The requirements that are not in the code, or not tested, `* MON-01: why`.
pub fn exempt<'t>(tree: &'t Tree, heading: &str) -> BTreeMap<&'t str, &'t str> {
    let list = table(tree).split("\n## ").find(|it| it.starts_with(heading)).unwrap_or_default();
    let items = list.lines().filter_map(|line| line.strip_prefix("* ")?.split_once(": "));
    items.collect()
}

fn table(tree: &Tree) -> &str {
    tree.0.get(PREFIXES).map(String::as_str).unwrap_or_default()
}

/// Requirements that the code of their prefix does not cite, and reasons that none needs.
pub fn not_implemented(tree: &Tree, found: &[Requirement], cited: &Citations) -> Vec<String> {
    let (prefixes, mut exempt) = (prefixes(tree), exempt(tree, "Not in the code"));
    let mut wrong = Vec::new();
    for Requirement { id, text, .. } in found {
        let Some((of, _)) = prefixes.get(prefix(id)) else {
            wrong.push(format!("{id}: {PREFIXES} does not say where its code is"));
            continue;
        };
        let is_there = |by: &String| is_code(by) && of.iter().any(|it| by.starts_with(it));
        let is_cited = cited.get(id).into_iter().flatten().any(is_there);
        if !of.is_empty() && !is_cited && exempt.remove(id.as_str()).is_none() {
            wrong.push(format!("{id}: not in {}: {text}", of.join(", ")));
        }
    }
    wrong.extend(exempt.keys().map(|id| format!("{id}: needs no reason not to be in the code")));
    wrong
}

/// A row of comma-separated values for each requirement.
pub fn matrix(tree: &Tree, found: &[Requirement], cited: &Citations) -> String {
    let (prefixes, exempt) = (prefixes(tree), exempt(tree, "Not in the code"));
    let quoted = |text: &str| format!("\"{}\"", text.replace('"', "\"\""));
    let mut out = "id,relevance,method,text,code,tests,vectors,proofs\n".to_owned();
    for Requirement { id, text, .. } in found {
        let relevance = prefixes.get(prefix(id)).map_or("", |(_, it)| it);
        let of = |id: &str| cited.get(id).into_iter().flatten().map(String::as_str);
        let (mut code, by): (Vec<&str>, Vec<&str>) = of(id).partition(|by| is_code(by));
        code.extend(exempt.get(id.as_str()));
        let (proofs, by): (Vec<&str>, Vec<&str>) = by.into_iter().partition(|by| is_proof(by));
        let is_vector = |by: &&str| by.starts_with("vectors/");
        let (mut vectors, tests): (Vec<&str>, Vec<&str>) = by.into_iter().partition(is_vector);
        vectors.extend(of(rule(id)).filter(|by| rule(id) != id && is_vector(by)));
        let method = match (proofs.is_empty(), tests.is_empty() && vectors.is_empty()) {
            (true, true) => "none",
            (true, false) => "tested",
            (false, true) => "proved",
            (false, false) => "both",
        };
        let lists = [code, tests, vectors, proofs].map(|it| quoted(&it.join("; "))).join(",");
        let _ = writeln!(out, "{id},{relevance},{method},{},{lists}", quoted(text));
    }
    out
}

#[test]
fn what_no_code_cites_is_seen() {
    let page = "| prefix | where | code | relevance |\n|---|---|---|---|\n| `A` | [a](x.md) | `impl/src` | goal |\n\
                | `B` | [b](x.md) | - | none |\n\n## Not in the code\n\n* A-02: follows\n* A-03: old\n";
    let tree = Tree([(PREFIXES.to_owned(), page.to_owned())].into());
    let asked = |id: &str| Requirement {
        id: id.to_owned(),
        place: String::new(),
        text: "It MUST \"b\".".to_owned(),
    };
    let found = ["A-01", "A-02", "A-03", "B-01", "C-01"].map(asked);
    let by = |id: &str, by: &str| (id.to_owned(), [by.to_owned()].into());
    let cited =
        Citations::from([by("A-01", "impl/src/a/tests.rs"), by("A-03", "impl/src/a.rs::f")]);
    let expected = [
        "A-01: not in impl/src: It MUST \"b\".",
        "C-01: spec/README.md does not say where its code is",
        "A-03: needs no reason not to be in the code",
    ];
    assert_eq!(not_implemented(&tree, &found, &cited), expected);
    let rows = matrix(&tree, &found[1..3], &cited);
    let row = "\nA-03,goal,none,\"It MUST \"\"b\"\".\",\"impl/src/a.rs::f; old\",\"\",\"\",\"\"\n";
    assert!(rows.ends_with(row), "{rows}");
    let by = ["a_test", "proofs/src/a.rs::law", "vectors/a.jsonl"].map(str::to_owned);
    let rows = matrix(&tree, &found[..1], &[("A-01".to_owned(), by.into())].into());
    assert!(rows.ends_with("\"a_test\",\"vectors/a.jsonl\",\"proofs/src/a.rs::law\"\n"), "{rows}");
    assert!(rows.contains("A-01,goal,both,"), "{rows}");
}
