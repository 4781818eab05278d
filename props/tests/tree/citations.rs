//! What cites a requirement: tests, vectors and proofs, and the code that implements it.

use std::collections::{BTreeMap, BTreeSet};

use super::ids::{Requirement, ids_in, prefix, rule};
use super::lines::{Place, lines};
use super::tree::Tree;

/// Of each id what cites it: the name of a function or type of Rust, or a file; of code and proofs both.
pub type Citations = BTreeMap<String, BTreeSet<String>>;

/// The tests that read ids themselves.
const BOOKS: [&str; 3] = ["props/tests/chain/", "props/tests/requirements.rs", "props/tests/tree/"];

/// Items that name requirements without asking for them: that no vector or record shows, or that a report is about.
const LISTS: [&str; 3] = ["NO_RECORD", "NOT_SHOWN", "REQUIREMENTS"];

/// The sources of what a vehicle runs.
const CODE: [&str; 2] = ["impl/src/", "capi/src/"];

/// Whether it is code that cites, and no test of it.
pub fn is_code(by: &str) -> bool {
    CODE.iter().any(|folder| by.starts_with(folder)) && !by.ends_with("/tests.rs")
}

/// Whether it is a proof: a law, harness, theorem or exploration, or the statement of one.
pub fn is_proof(by: &str) -> bool {
    by.starts_with("proofs/") && !by.contains("/tests/")
}

/// All that tests, vectors, proofs and code cite.
pub fn citations(tree: &Tree) -> Citations {
    let mut found = Citations::new();
    for (path, text) in tree.ending("") {
        for (id, by) in of_file(path, text) {
            found.entry(id.to_owned()).or_default().insert(by);
        }
    }
    found
}

/// Of what cites them what is evidence: of proofs the claims that a page has an answer for, and the laws that harnesses
/// assert. A step that shows that a law is not empty, or a part of a theorem, is none.
pub fn evidence(tree: &Tree) -> Citations {
    let pages = ["docs/proofs.md", "docs/exploration.md"].map(|it| tree.0.get(it));
    let rows = pages.into_iter().flatten().flat_map(|page| page.lines());
    let names = rows.filter_map(|line| line.strip_prefix("| ")?.split(" | ").next());
    let answered: BTreeSet<&str> = names.map(|it| it.trim_matches('`')).collect();
    let is_answered = |by: &str| {
        let (path, name) = by.split_once("::").unwrap_or((by, ""));
        let module = path.rsplit('/').next().unwrap_or_default().trim_end_matches(".rs");
        let has_row = answered.contains(name) || answered.contains(&*format!("{module}::{name}"));
        has_row || path == "proofs/expected.toml" || path.starts_with("proofs/src/law/")
    };
    let mut found = citations(tree);
    found.values_mut().for_each(|its| its.retain(|by| !is_proof(by) || is_answered(by)));
    found
}

fn of_file<'a>(path: &'a str, text: &'a str) -> Vec<(&'a str, String)> {
    let is_test = text.contains("#[test]") || text.contains("proptest!");
    match (path.split('/').next(), kind(path)) {
        _ if BOOKS.iter().any(|it| path.starts_with(it)) => Vec::new(),
        (Some("vectors"), "jsonl") => {
            text.lines().flat_map(of_vector).map(|id| (id, path.to_owned())).collect()
        }
        _ if path == "proofs/expected.toml" => {
            ids_in(text).into_iter().map(|id| (id, path.to_owned())).collect()
        }
        (Some("proofs"), "rs") => of_rust(path, text),
        (_, "rs") if is_code(path) => of_code(path, text),
        (_, "rs") if is_test => of_rust(path, text),
        _ => Vec::new(),
    }
}

/// What stands behind the last point of a name.
fn kind(path: &str) -> &str {
    path.rsplit('.').next().unwrap_or_default()
}

/// The requirement of a vector, and the interpretation in which its flag ends.
fn of_vector(line: &str) -> impl Iterator<Item = &str> {
    let value = |key: &str| {
        let (_, rest) = line.split_once(&format!("\"{key}\": \""))?;
        rest.split('"').next()
    };
    [value("requirement"), value("flag")].into_iter().flatten().flat_map(ids_in)
}

/// Ids of a file of Rust, each with the item whose comment or body cites it, else with the file.
fn of_rust<'a>(path: &str, text: &'a str) -> Vec<(&'a str, String)> {
    let cited = lines(text).into_iter().flat_map(|line| {
        let by = match line.at {
            Place::Item(name) if is_proof(path) => format!("{path}::{name}"),
            Place::Item(name) => name.to_owned(),
            Place::Head => path.to_owned(),
        };
        let ids = ids_in(line.code).into_iter().chain(ids_in(line.comment));
        ids.map(move |id| (id, by.clone()))
    });
    cited.filter(|(_, by)| !LISTS.contains(&by.as_str())).collect()
}

/// Ids of a source, each with the item whose comment cites it. A comment names rules as a whole for many a
/// reason: that is no citation. The tests at its end cite as others do.
fn of_code<'a>(path: &str, text: &'a str) -> Vec<(&'a str, String)> {
    let end = text.find("#[cfg(test)]\nmod tests {").unwrap_or(text.len());
    let cited = lines(&text[..end]).into_iter().flat_map(|line| {
        let item =
            if let Place::Item(name) = line.at { format!("::{name}") } else { String::new() };
        let ids =
            ids_in(line.comment).into_iter().filter(|id| prefix(id) != "H" || rule(id) != *id);
        ids.map(move |id| (id, format!("{path}{item}")))
    });
    cited.chain(of_rust(&format!("tests of {path}"), &text[end..])).collect()
}

/// Citations of no requirement. Prose may name what is retired.
pub fn strangers(
    tree: &Tree,
    requirements: &[Requirement],
    retired: &BTreeSet<String>,
) -> Vec<String> {
    let known: BTreeSet<&str> =
        requirements.iter().flat_map(|it| [it.id.as_str(), rule(&it.id)]).collect();
    let prefixes: BTreeSet<&str> = known.iter().map(|id| prefix(id)).collect();
    let mut wrong = BTreeSet::new();
    for (path, text) in tree.ending("") {
        let is_book = BOOKS.iter().any(|it| path.starts_with(it)) || kind(path) == "lock";
        let is_prose = kind(path) == "md";
        let ids = if kind(path) == "jsonl" {
            text.lines().flat_map(of_vector).collect()
        } else {
            ids_in(text)
        };
        for id in ids {
            let is_named = known.contains(id) || (is_prose && retired.contains(id));
            if prefixes.contains(prefix(id)) && !is_named && !is_book {
                wrong.insert(format!("{path}: {id} is no requirement"));
            }
        }
    }
    wrong.into_iter().collect()
}
