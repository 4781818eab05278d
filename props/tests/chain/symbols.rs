//! The symbols of the paper and of the spec: distances, parameters of the stages and of the requester.

use super::claims::Claim;
use super::ids::requirements;
use super::lines::item;
use super::rows::{Cell, Row};
use super::tree::{Tree, sections};

/// A row for each symbol. `rows`: those of the headings, which lead on.
pub fn all(tree: &Tree, claims: &[Claim], rows: &[Row]) -> Vec<Row> {
    let text = |file: &str| tree.0.get(file).map(String::as_str).unwrap_or_default();
    let (stages, offloading) = ("spec/3-stages.md", "spec/2-offloading.md");
    let (asked, _) = requirements(tree);
    let mut found = Vec::new();
    let mut add = |symbol: &str, paper: &str, file: &str, anchor: &str| {
        found.push(Row::new(symbol, symbol, paper, &format!("{file}#{anchor}")));
    };
    for section in sections(text(stages)) {
        for line in section.lines {
            // s_CAV = ... (3)
            if line.starts_with("    ") && line.contains(" = ") {
                let symbol = line.trim_start().split(['(', ' ']).next().unwrap_or_default();
                let number = line.rsplit(' ').next().filter(|it| it.len() == 3);
                let paper =
                    number.map_or("Paper Sec. IV-F.".to_owned(), |it| format!("Paper eq. {it}."));
                add(symbol, &paper, stages, &section.anchor);
            }
            // Parameters: theta_tr = 0.2 m, ...
            for (at, _) in line.match_indices(" = ").filter(|_| line.starts_with("Parameters ")) {
                let symbol = line[..at].rsplit(' ').next().unwrap_or_default();
                add(symbol, "A parameter of the stages.", stages, &section.anchor);
            }
        }
    }
    for section in sections(text(offloading)) {
        let defaults = section.lines.iter().filter_map(|line| line.split_once("Defaults: "));
        for symbol in
            defaults.flat_map(|(_, it)| it.split(", ")).filter_map(|it| it.split(' ').next())
        {
            add(symbol, "A time of the requester or provider.", offloading, &section.anchor);
        }
    }
    for row in &mut found {
        // A letter is found by the requirement that defines it.
        let formula = format!(" {} = ", row.name);
        let of = asked.iter().filter(|it| row.name.len() == 1 && it.text.contains(&formula));
        row.ids = of.map(|it| it.id.clone()).collect();
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
    for other in rows {
        let (file, anchor) = other.name.split_once('#').unwrap_or((&other.name, ""));
        let text = tree.0.get(file).map(String::as_str).unwrap_or_default();
        let here = sections(text).into_iter().filter(|it| anchor.is_empty() || it.anchor == anchor);
        if here.flat_map(|it| it.lines).any(&is_named) {
            row.add(Cell::Spec, &other.name, "");
        }
    }
    for (file, text) in tree.ending(".rs") {
        for (cell, folder) in [(Cell::Model, "model/src/"), (Cell::Impl, "impl/src/")] {
            let functions = text.lines().filter_map(|line| item(line.trim_start()));
            for name in functions.filter(|it| file.starts_with(folder) && *it == code) {
                row.add(cell, file, name);
            }
        }
    }
    for claim in claims {
        if is_named(&claim.words) || claim.about.iter().any(|it| row.ids.contains(it)) {
            row.cells.entry(claim.cell).or_default().insert(claim.link.clone());
        }
    }
    for (file, text) in tree.ending(".jsonl").filter(|(file, _)| file.starts_with("vectors/")) {
        let cites = |id: &String| text.contains(&format!("\"requirement\": \"{id}\""));
        if (is_named(text) && !file.contains("random")) || row.ids.iter().any(cites) {
            row.add(Cell::Vector, file, "");
        }
    }
    let places = &row.cells[&Cell::Spec];
    let headings = rows.iter().filter(|it| places.iter().any(|link| link.file == it.name));
    if let Some(heading) = headings.into_iter().find(|it| is_named(&it.paper)) {
        row.paper.clone_from(&heading.paper);
    }
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
