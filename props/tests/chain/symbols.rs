//! The symbols of the paper and of the spec: distances, parameters of the stages and of the requester.

use std::collections::BTreeSet;

use super::claims::Claim;
use super::lines::{Place, item, lines};
use super::rows::{BOOKS, Cell, Row, add_benches, is_test};
use super::tree::{Tree, sections};

/// A row for each symbol. `rows`: those of the headings.
pub fn all(tree: &Tree, claims: &[Claim], rows: &[Row]) -> Vec<Row> {
    let text = |file: &str| tree.0.get(file).map(String::as_str).unwrap_or_default();
    let stages = "spec/3-stages.md";
    let mut found = Vec::new();
    for section in sections(text(stages)) {
        let place = format!("{stages}#{}", section.anchor);
        // s_CAV = ... (3)
        for line in
            section.lines.iter().filter(|line| line.starts_with("    ") && line.contains(" = "))
        {
            let symbol = line.trim_start().split(['(', ' ']).next().unwrap_or_default();
            let number = line.rsplit(' ').next().unwrap_or_default();
            found.push(Row::new(symbol, symbol, &format!("Paper eq. {number}."), &place));
        }
        // Parameters: theta_tr = 0.2 m, ...
        for line in section.lines.iter().filter(|line| line.starts_with("Parameters ")) {
            for (at, _) in line.match_indices(" = ") {
                let symbol = line[..at].rsplit(' ').next().unwrap_or_default();
                let profile =
                    match (line[..at].contains("Both:"), line[..at].contains("Hardened only:")) {
                        (true, _) => "both profiles",
                        (_, true) => "the hardened profile",
                        _ => "the paper profile",
                    };
                let words = format!("A parameter of {profile}.");
                found.push(Row::new(symbol, symbol, &words, &place));
            }
        }
    }
    let offloading = "spec/2-offloading.md";
    for section in sections(text(offloading)) {
        let place = format!("{offloading}#{}", section.anchor);
        for line in section.lines {
            let Some((_, defaults)) = line.split_once("Defaults: ") else { continue };
            for default in defaults.split(", ").filter_map(|it| it.split(' ').next()) {
                found.push(Row::new(
                    default,
                    default,
                    "A time of the requester or provider.",
                    &place,
                ));
            }
        }
    }
    for row in &mut found {
        complete(tree, claims, rows, row);
    }
    found
}

fn complete(tree: &Tree, claims: &[Claim], rows: &[Row], row: &mut Row) {
    let symbol = row.name.clone();
    let code = symbol.to_lowercase();
    let is_named = |text: &str| {
        has_word(text, &symbol) || has_word(text, &code) || has_word(text, &format!("{code}_ns"))
    };
    for (file, text) in tree
        .ending(".md")
        .filter(|(file, _)| file.starts_with("spec/") && !file.ends_with("CHANGES.md"))
    {
        let with = sections(text)
            .into_iter()
            .filter(|section| section.lines.iter().any(|line| is_named(line)));
        for section in with.filter(|section| section.lines.iter().any(|line| line.contains("MUST")))
        {
            row.add(Cell::Spec, &format!("{file}#{}", section.anchor), "");
        }
    }
    for (cell, folder) in [(Cell::Model, "model/src/"), (Cell::Impl, "impl/src/")] {
        let files =
            || tree.ending(".rs").filter(|(file, _)| file.starts_with(folder) && !is_test(file));
        let mut functions = BTreeSet::new();
        for (file, text) in files() {
            functions.extend(functions_with(text, &code).into_iter().map(|name| (file, name)));
        }
        let is_own = functions.iter().any(|(_, name)| *name == code);
        for (file, name) in functions.iter().filter(|(_, name)| !is_own || *name == code) {
            row.add(cell, file, name);
        }
    }
    for claim in claims.iter().filter(|claim| is_named(&claim.words)) {
        row.cells.entry(claim.cell).or_default().insert(claim.link.clone());
    }
    let tests = || tree.ending(".rs").filter(|(_, text)| text.contains("#[test]"));
    for (file, text) in tests().filter(|(file, _)| !BOOKS.iter().any(|it| file.starts_with(it))) {
        for name in text.lines().filter_map(|line| item(line.trim_start())) {
            if text.contains(&format!("fn {name}()")) && has_word(name, &code) {
                row.add(Cell::Test, file, name);
            }
        }
    }
    if !row.cells.contains_key(&Cell::Test) {
        for (file, _) in tests().filter(|(file, text)| is_test(file) && is_named(text)) {
            row.add(Cell::Test, file, "");
        }
    }
    for (file, text) in tree.ending(".jsonl").filter(|(file, _)| file.starts_with("vectors/")) {
        if is_named(text) && !file.contains("random") {
            row.add(Cell::Vector, file, "");
        }
    }
    let places: BTreeSet<_> = row.cells[&Cell::Spec].iter().map(|link| link.file.clone()).collect();
    let headings = || rows.iter().filter(|other| places.contains(&other.name));
    if !row.cells.contains_key(&Cell::Vector) {
        let links =
            headings().filter_map(|other| other.cells.get(&Cell::Vector)).flatten().cloned();
        row.cells.entry(Cell::Vector).or_default().extend(links);
    }
    if let Some(heading) = headings().find(|other| is_named(&other.paper)) {
        row.paper.clone_from(&heading.paper);
    }
    add_benches(tree, row);
    row.cells.retain(|_, links| !links.is_empty());
}

/// The functions in which a word stands, and a function of this name.
fn functions_with(text: &str, word: &str) -> BTreeSet<String> {
    let timed = format!("{word}_ns");
    let lines = lines(text).into_iter();
    let with = lines.filter(|line| has_word(line.code, word) || has_word(line.code, &timed));
    let items = with.filter_map(|line| match line.at {
        Place::Item(name) => Some(name.to_owned()),
        Place::Head => None,
    });
    items.collect()
}

/// Whether a word stands in a text, also as a part of a name with underscores. A single letter has
/// to be a field.
pub fn has_word(text: &str, word: &str) -> bool {
    let field = format!(".{word}");
    let wanted = if word.len() == 1 { &field } else { word };
    text.match_indices(wanted).any(|(at, _)| {
        let apart = |c: Option<char>| c.is_none_or(|c| !c.is_alphanumeric());
        let before = text[..at].chars().next_back();
        let after = text[at + wanted.len()..].chars().next();
        let longer = word.len() == 1 && after == Some('_');
        (word.len() == 1 || apart(before)) && apart(after) && !longer
    })
}

#[test]
fn words_are_whole() {
    assert!(has_word("fn s_follow_never_below()", "s_follow") && has_word("(s_CAV)", "s_CAV"));
    assert!(
        !has_word("s_followed", "s_follow")
            && !has_word("abs_b", "s_b")
            && has_word("p.n * 2", "n")
    );
    assert!(!has_word("p.now", "n") && !has_word("n", "n"));
}
