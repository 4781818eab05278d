//! The page, and what is missing on it.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use super::rows::{Cell, Link, Row};

/// Cells with their names on the page.
const CELLS: [(Cell, &str); 9] = [
    (Cell::Spec, "spec"),
    (Cell::Model, "model"),
    (Cell::Impl, "impl"),
    (Cell::Law, "law"),
    (Cell::Theorem, "theorem"),
    (Cell::Harness, "harness"),
    (Cell::Test, "test"),
    (Cell::Vector, "vector"),
    (Cell::Bench, "bench"),
];

/// Cells that every row has to have; a symbol leads on by its headings, and needs the first two alone.
const NEEDED: [(Cell, &str); 6] = [
    (Cell::Proof, "law, theorem or harness"),
    (Cell::Vector, "vector"),
    (Cell::Model, "model"),
    (Cell::Impl, "impl"),
    (Cell::Test, "test"),
    (Cell::Bench, "bench"),
];

type Reasons = [(&'static str, Cell, &'static str)];

/// How many names of a file are shown.
const NAMES: usize = 3;

fn needed(row: &Row) -> &'static [(Cell, &'static str)] {
    if row.is_symbol() { &NEEDED[..2] } else { &NEEDED }
}

fn has(row: &Row, cell: Cell) -> bool {
    let of: &[Cell] = match &cell {
        Cell::Proof => &[Cell::Law, Cell::Theorem, Cell::Harness],
        // One test holds model and implementation to every vector.
        Cell::Test => &[Cell::Test, Cell::Vector],
        cell => std::slice::from_ref(cell),
    };
    of.iter().any(|cell| row.cells.contains_key(cell) || row.elsewhere.contains(cell))
}

/// Needed cells that are empty without a reason, and reasons that nothing needs.
pub fn missing(rows: &[Row], reasons: &Reasons) -> Vec<String> {
    let mut wrong = Vec::new();
    for row in rows {
        for &(cell, name) in needed(row) {
            if !has(row, cell) && reason(row, cell, reasons).is_none() {
                wrong.push(format!("{}: no {name}", row.name));
            }
        }
    }
    for (start, cell, why) in reasons {
        let needs = |row: &&Row| needed(row).iter().any(|(it, _)| it == cell) && !has(row, *cell);
        if !rows.iter().filter(|row| is_about(row, start)).any(|row| needs(&row)) {
            let name = NEEDED.iter().find(|(it, _)| it == cell).map_or("", |(_, name)| name);
            wrong.push(format!("{start}: {name}: is there now, strike out the reason ({why})"));
        }
    }
    wrong
}

/// A reason is for a row of its name, or for headings that begin so.
fn is_about(row: &Row, start: &str) -> bool {
    row.name == start || (start.starts_with("spec/") && row.name.starts_with(start))
}

fn reason(row: &Row, cell: Cell, reasons: &Reasons) -> Option<&'static str> {
    let of = |it: &&(&str, Cell, &'static str)| is_about(row, it.0) && it.1 == cell;
    reasons.iter().find(of).map(|(_, _, why)| *why)
}

/// The page.
pub fn write(rows: &[Row], reasons: &Reasons) -> String {
    let mut out = String::from(
        "# Chain\n\n\
         From the paper to the code and what is known of it, by `UPDATE_CHAIN=1 cargo test -p mufasa-props --test chain` \
         from what the sources say: headings and rules in comments, requirements of vectors, claims and the changes \
         that refute them. A test fails when this page is old, or a place is missing without a reason.\n\n\
         [One test](../props/tests/vectors.rs) holds model and implementation to every vector. \
         `law` has the laws of `proofs/src/law` and the properties of the exploration. What is a claim and what is only \
         tested: [proofs.md](proofs.md).\n\n\
         ## By the paper\n\n| paper | here |\n|---|---|\n",
    );
    let (headings, others): (Vec<_>, Vec<_>) =
        rows.iter().partition(|row| row.name.starts_with("spec/"));
    let link = |row: &Row| format!("[{}](#{})", row.title, anchor(&row.title));
    for row in headings.iter().filter(|row| row.paper.starts_with("Paper ")) {
        let _ = writeln!(out, "| {} | {} |", row.paper.trim_start_matches("Paper "), link(row));
    }
    let is_rule = |row: &&&Row| !row.is_symbol();
    let list = |of: Vec<&&Row>| of.into_iter().map(|row| link(row)).collect::<Vec<_>>().join(" · ");
    let _ =
        writeln!(out, "\nSymbols: {}\n", list(others.iter().filter(|row| !is_rule(row)).collect()));
    let _ = writeln!(
        out,
        "Rules and interpretations: {}\n",
        list(others.iter().filter(is_rule).collect())
    );
    for (title, of) in
        [("Headings of the spec", &headings), ("Rules, interpretations, symbols", &others)]
    {
        let _ = writeln!(out, "## {title}\n");
        of.iter().for_each(|row| out += &section(row, reasons));
    }
    format!("{}\n", out.trim_end())
}

fn section(row: &Row, reasons: &Reasons) -> String {
    let mut out = format!("### {}\n\n", row.title);
    if !row.paper.is_empty() {
        let _ = writeln!(out, "{}\n", row.paper);
    }
    for (cell, name) in CELLS {
        if let Some(links) = row.cells.get(&cell) {
            let mut files: BTreeMap<&str, Vec<&str>> = BTreeMap::new();
            for Link { file, name } in links {
                let names = files.entry(file).or_default();
                names.extend(Some(name.as_str()).filter(|name| !name.is_empty()));
            }
            let files: Vec<_> =
                files.into_iter().map(|(file, names)| place(file, &names)).collect();
            let _ = writeln!(out, "* **{name}** {}", files.join("; "));
        }
    }
    for &(cell, name) in needed(row) {
        if let Some(why) = reason(row, cell, reasons).filter(|_| !has(row, cell)) {
            let _ = writeln!(out, "* no {name}: {why}");
        }
    }
    out.push('\n');
    out
}

/// A link to a file with the names in it.
fn place(file: &str, names: &[&str]) -> String {
    let mut shown: Vec<_> = names.iter().take(NAMES).map(|name| format!("`{name}`")).collect();
    if names.len() > NAMES {
        shown.push(format!("and {} more", names.len() - NAMES));
    }
    let shown = if shown.is_empty() { String::new() } else { format!(" {}", shown.join(", ")) };
    let folders = ["spec/", "model/src/", "impl/src/", "vectors/", "benches/benches/"];
    let short = folders.iter().find_map(|folder| file.strip_prefix(folder)).unwrap_or(file);
    format!("[{short}](../{file}){shown}")
}

fn anchor(title: &str) -> String {
    let kept = title.to_lowercase();
    let kept = kept.chars().filter(|c| c.is_alphanumeric() || matches!(c, ' ' | '-' | '_'));
    kept.map(|c| if c == ' ' { '-' } else { c }).collect()
}
