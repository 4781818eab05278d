//! Which requirements have no code or no proof, and all of them as a table.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;

use super::citations::{Citations, is_code, is_proof};
use super::ids::{PREFIXES, Requirement, prefix, rule};
use super::tree::Tree;

/// Of each prefix the folders of its code, its relevance, and why some of its requirements have no proof. A row of
/// single ids has what is otherwise than of their prefix.
type Rows<'t> = BTreeMap<&'t str, [&'t str; 3]>;

const FOLDERS: usize = 0;
const RELEVANCE: usize = 1;
const RATIONALE: usize = 2;

fn rows(tree: &Tree) -> Rows<'_> {
    let row = |line| {
        let cells: Vec<&str> = str::split(line, '|').map(str::trim).collect();
        let [_, names, _, folders, relevance, rationale, _] = cells[..] else { return None };
        let cells = [folders, relevance, rationale].map(|it| if it == "-" { "" } else { it });
        Some(names.split(", ").map(move |it| (it.trim_matches('`'), cells)))
    };
    let lines = table(tree).lines().filter(|line| line.starts_with("| `"));
    lines.filter_map(row).flatten().collect()
}

/// What the row of an id says, or else that of its prefix, and whose row it is.
fn said<'t>(rows: &Rows<'t>, id: &str, column: usize) -> (&'t str, &'t str) {
    let of = |key| rows.get_key_value(key).map(|(name, it)| (it[column], *name));
    let found = [id, prefix(id)].into_iter().filter_map(of).find(|(it, _)| !it.is_empty());
    found.unwrap_or_default()
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
    let (rows, mut exempt) = (rows(tree), exempt(tree, "Not in the code"));
    let mut wrong = Vec::new();
    for Requirement { id, text, .. } in found {
        let Some(row) = rows.get(prefix(id)) else {
            wrong.push(format!("{id}: {PREFIXES} does not say where its code is"));
            continue;
        };
        let folders = row[FOLDERS].split(", ").map(|it| it.trim_matches('`'));
        let of: Vec<&str> = folders.filter(|it| !it.is_empty()).collect();
        let is_there = |by: &String| is_code(by) && of.iter().any(|it| by.starts_with(it));
        let is_cited = cited.get(id).into_iter().flatten().any(is_there);
        if !of.is_empty() && !is_cited && exempt.remove(id.as_str()).is_none() {
            wrong.push(format!("{id}: not in {}: {text}", of.join(", ")));
        }
    }
    wrong.extend(exempt.keys().map(|id| format!("{id}: needs no reason not to be in the code")));
    wrong
}

/// Requirements that have neither a proof nor a reason for that, reasons that none needs, and rows of ids that say no
/// other thing than that of their prefix.
pub fn not_proved(tree: &Tree, found: &[Requirement], cited: &Citations) -> Vec<String> {
    let rows = rows(tree);
    let is_proved = |id: &str| cited.get(id).into_iter().flatten().any(|by| is_proof(by));
    let (mut wrong, mut used) = (Vec::new(), BTreeSet::new());
    for Requirement { id, text, .. } in found.iter().filter(|it| !is_proved(&it.id)) {
        match said(&rows, id, RATIONALE) {
            ("", _) => wrong.push(format!("{id}: no proof, and no reason for that: {text}")),
            (_, whose) => drop(used.insert(whose)),
        }
    }
    for (name, row) in &rows {
        let of = rows.get(prefix(name)).filter(|_| prefix(name) != *name);
        let is_known = found.iter().any(|it| of.is_none() || it.id == *name);
        if !row[RATIONALE].is_empty() && !used.contains(name) {
            wrong.push(format!("{name}: needs no reason to have no proof"));
        }
        if !is_known || of.is_some_and(|it| it[RELEVANCE] == row[RELEVANCE]) {
            wrong.push(format!("{name}: needs no row of its own"));
        }
    }
    wrong
}

/// A row of comma-separated values for each requirement.
pub fn matrix(tree: &Tree, found: &[Requirement], cited: &Citations) -> String {
    let (rows, exempt) = (rows(tree), exempt(tree, "Not in the code"));
    let quoted = |text: &str| format!("\"{}\"", text.replace('"', "\"\""));
    let mut out = "id,relevance,method,text,code,tests,vectors,proofs,rationale\n".to_owned();
    for Requirement { id, text, .. } in found {
        let (relevance, _) = said(&rows, id, RELEVANCE);
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
        let why = if proofs.is_empty() { said(&rows, id, RATIONALE).0 } else { "" };
        let lists = [code, tests, vectors, proofs, vec![why]];
        let lists = lists.map(|it| quoted(&it.join("; "))).join(",");
        let _ = writeln!(out, "{id},{relevance},{method},{},{lists}", quoted(text));
    }
    out
}

#[test]
fn what_no_code_cites_is_seen() {
    let page = "| `A` | [a](x.md) | `impl/src` | goal | too large |\n| `B` | [b](x.md) | - | none | - |\n\
                | `A-02`, `A-03` | words | | evidence | |\n\n## Not in the code\n\n* A-02: follows\n* A-03: old\n";
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
    let row = "\nA-03,evidence,none,\"It MUST \"\"b\"\".\",\"impl/src/a.rs::f; old\",\"\",\"\",\"\",\"too large\"\n";
    assert!(rows.ends_with(row), "{rows}");
    let by = ["a_test", "proofs/src/a.rs::law", "vectors/a.jsonl"].map(str::to_owned);
    let rows = matrix(&tree, &found[..1], &[("A-01".to_owned(), by.into())].into());
    assert!(
        rows.ends_with("\"a_test\",\"vectors/a.jsonl\",\"proofs/src/a.rs::law\",\"\"\n"),
        "{rows}"
    );
    assert!(rows.contains("A-01,goal,both,"), "{rows}");
}

#[test]
fn what_has_neither_a_proof_nor_a_reason_is_seen() {
    let judged = |page: &str, proofs: &[&str]| {
        let tree = Tree([(PREFIXES.to_owned(), page.to_owned())].into());
        let asked = |id: &str| Requirement {
            id: id.to_owned(),
            place: String::new(),
            text: "It MUST.".to_owned(),
        };
        let of = |id: &&str| ((*id).to_owned(), ["proofs/src/a.rs::law".to_owned()].into());
        not_proved(&tree, &["A-01", "A-02"].map(asked), &proofs.iter().map(of).collect())
    };
    let row = |why: &str| format!("| `A` | [a](x.md) | - | goal | {why} |\n");
    assert_eq!(judged(&row("too large"), &["A-01"]), [""; 0]);
    assert_eq!(judged(&row("-"), &["A-01", "A-02"]), [""; 0]);
    let without = ["A-02: no proof, and no reason for that: It MUST."];
    assert_eq!(judged(&row("-"), &["A-01"]), without);
    let needless = ["A: needs no reason to have no proof"];
    assert_eq!(judged(&row("too large"), &["A-01", "A-02"]), needless);
    let own = |cells: &str| row("-") + "| `A-02` | words | | " + cells + " |\n";
    assert_eq!(judged(&own("none | too large"), &["A-01"]), [""; 0]);
    assert_eq!(judged(&own("none | too large"), &["A-02"])[1], needless[0].replace('A', "A-02"));
    assert_eq!(judged(&own("goal | too large"), &["A-01"]), ["A-02: needs no row of its own"]);
    let other = row("-") + "| `A-03` | words | | none | |\n";
    assert_eq!(judged(&other, &["A-01", "A-02"]), ["A-03: needs no row of its own"]);
}
