//! Which requirements have no code, and all of them as a table.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use super::citations::{Citations, is_code};
use super::ids::{PREFIXES, Requirement, prefix, rule};
use super::tree::Tree;

/// Of each prefix the folders of its code, none where its column has `-`.
fn folders(tree: &Tree) -> BTreeMap<&str, Vec<&str>> {
    let row = |line| {
        let cells: Vec<&str> = str::split(line, '|').map(str::trim).collect();
        let [_, name, _, folders, _] = cells[..] else { return None };
        let of = folders.split(", ").map(|it| it.trim_matches('`')).filter(|it| *it != "-");
        Some((name.trim_matches('`'), of.collect()))
    };
    table(tree).lines().filter_map(row).collect()
}

/// The requirements that are not in the code, `* MON-01: why`.
fn exempt(tree: &Tree) -> BTreeMap<&str, &str> {
    let list = table(tree).split("## Not in the code").nth(1).unwrap_or_default();
    let items = list.lines().filter_map(|line| line.strip_prefix("* ")?.split_once(": "));
    items.collect()
}

fn table(tree: &Tree) -> &str {
    tree.0.get(PREFIXES).map(String::as_str).unwrap_or_default()
}

/// Requirements that the code of their prefix does not cite, and reasons that none needs.
pub fn not_implemented(tree: &Tree, found: &[Requirement], cited: &Citations) -> Vec<String> {
    let (folders, mut exempt) = (folders(tree), exempt(tree));
    let mut wrong = Vec::new();
    for Requirement { id, text, .. } in found {
        let Some(of) = folders.get(prefix(id)) else {
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
    let exempt = exempt(tree);
    let quoted = |text: &str| format!("\"{}\"", text.replace('"', "\"\""));
    let mut out = "id,text,code,tests-vectors-proofs\n".to_owned();
    for Requirement { id, text, .. } in found {
        let by = cited.get(id).into_iter().flatten().map(String::as_str);
        let (mut code, mut tests): (Vec<&str>, Vec<&str>) = by.partition(|by| is_code(by));
        code.extend(exempt.get(id.as_str()));
        let whole = cited.get(rule(id)).filter(|_| rule(id) != id).into_iter().flatten();
        tests.extend(whole.map(String::as_str).filter(|by| by.starts_with("vectors/")));
        let cells = [text, &code.join("; "), &tests.join("; ")].map(|cell| quoted(cell));
        let _ = writeln!(out, "{id},{}", cells.join(","));
    }
    out
}

#[test]
fn what_no_code_cites_is_seen() {
    let page = "| prefix | where | code |\n|---|---|---|\n| `A` | [a](x.md) | `impl/src` |\n\
                | `B` | [b](x.md) | - |\n\n## Not in the code\n\n* A-02: follows\n* A-03: old\n";
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
    assert!(
        rows.ends_with("\nA-03,\"It MUST \"\"b\"\".\",\"impl/src/a.rs::f; old\",\"\"\n"),
        "{rows}"
    );
}
