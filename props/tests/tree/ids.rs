//! Requirements of the normative text: `**[DIST-02]** A trajectory point MUST ...`.
//!
//! An id stands at the beginning of a list item or of a row of a table. What it names is the row, or
//! the item with what is below it (indented lines, a table or a block behind it), up to the next id.
//! A line below it that begins with `Why:` gives a reason and is no part of it.

use super::tree::{Tree, sections};

/// A requirement, or a definition that others count on.
#[derive(Clone, Debug, PartialEq)]
pub struct Requirement {
    /// `DIST-02`, `H-04.1`; `I-02` for a row of the table of interpretations.
    pub id: String,
    /// File and anchor of its heading.
    pub place: String,
    /// Its words, with one space between them.
    pub text: String,
}

/// Says which prefix stands for which heading.
pub const PREFIXES: &str = "spec/README.md";

/// The rows `| DIST | [words](3-stages.md#distances) |`.
pub fn prefixes(tree: &Tree) -> Vec<(&str, String)> {
    let text = tree.0.get(PREFIXES).map(String::as_str).unwrap_or_default();
    text.lines().filter_map(prefix_of_row).collect()
}

fn prefix_of_row(line: &str) -> Option<(&str, String)> {
    let (name, rest) = line.strip_prefix("| ")?.split_once(" | ")?;
    let target = rest.split_once("](")?.1.split_once(')')?.0;
    Some((name.trim_matches('`'), format!("spec/{target}")))
}

/// The files that say what is asked for.
fn is_normative(path: &str) -> bool {
    let name = path.strip_prefix("spec/").and_then(|name| name.strip_suffix(".md"));
    name.is_some_and(|name| {
        let begins = name.starts_with(|c: char| c.is_ascii_digit());
        begins || name == "monitor" || name.starts_with("hardened/")
    })
}

/// All requirements in the order of the text, and the lines with a MUST that have no id.
pub fn requirements(tree: &Tree) -> (Vec<Requirement>, Vec<String>) {
    let (mut found, mut nameless) = (Vec::<Requirement>::new(), Vec::new());
    for (file, text) in tree.ending(".md").filter(|(path, _)| is_normative(path)) {
        for section in sections(text) {
            let place = format!("{file}#{}", section.anchor);
            let (mut open, mut reason, mut blank) = (false, false, false);
            for line in section.lines {
                let trimmed = line.trim_start();
                if let Some((id, words)) = begins(trimmed) {
                    let id = id.to_owned();
                    found.push(Requirement { id, place: place.clone(), text: words.to_owned() });
                    (open, reason) = (!trimmed.starts_with('|'), false);
                } else if trimmed.is_empty() {
                    (blank, reason) = (true, false);
                    continue;
                } else {
                    let is_below = line.starts_with(' ') || trimmed.starts_with('|');
                    open &= is_below || (!blank && !trimmed.starts_with(['*', '-']));
                    reason |= trimmed.trim_start_matches("* ").starts_with("Why:");
                    if let Some(last) = found.last_mut().filter(|_| open && !reason) {
                        last.text = format!("{} {trimmed}", last.text);
                    } else if line.contains("MUST") {
                        nameless.push(format!("{place}: {line}"));
                    }
                }
                blank = false;
            }
        }
    }
    for requirement in &mut found {
        requirement.text = requirement.text.split_whitespace().collect::<Vec<_>>().join(" ");
    }
    (found, nameless)
}

/// The id at the beginning of a line, and what stands behind it. A row of interpretations begins
/// with its id alone.
fn begins(line: &str) -> Option<(&str, &str)> {
    let of_row = line.strip_prefix("| ");
    let rest = of_row.or_else(|| line.strip_prefix("* ")).or_else(|| line.strip_prefix("- "))?;
    if let Some((id, words)) = rest.strip_prefix("**[").and_then(|rest| rest.split_once("]**")) {
        return Some((id, words));
    }
    let (id, words) = of_row?.split_once(" | ")?;
    (ids_in(id) == [id] && (id.starts_with("I-") || id.starts_with("H-"))).then_some((id, words))
}

/// Everything in a text that has the form of an id, whatever its prefix.
pub fn ids_in(text: &str) -> Vec<&str> {
    ids_at(text).into_iter().map(|(_, id)| id).collect()
}

/// Ids with the places where they begin.
pub fn ids_at(text: &str) -> Vec<(usize, &str)> {
    let joins = |c: char| c.is_ascii_alphanumeric() || c == '-' || c == '_';
    let digits = |text: &str| text.find(|c: char| !c.is_ascii_digit()).unwrap_or(text.len());
    let mut found = Vec::new();
    for (at, _) in text.match_indices('-') {
        let is_prefix = |c: char| c.is_ascii_uppercase() || c.is_ascii_digit();
        let start = text[..at]
            .rfind(|c: char| !is_prefix(c))
            .map_or(0, |end| end + text[end..].chars().next().map_or(0, char::len_utf8));
        let mut end = at + 1 + digits(&text[at + 1..]);
        if end != at + 3 || !text[start..at].starts_with(|c: char| c.is_ascii_uppercase()) {
            continue;
        }
        if let Some(rest) = text[end..].strip_prefix('.') {
            end += Some(digits(rest)).filter(|it| *it > 0).map_or(0, |count| count + 1);
        }
        if !text[..start].ends_with(joins) && !text[end..].starts_with(joins) {
            found.push((start, &text[start..end]));
        }
    }
    found
}

/// `DIST` of `DIST-02`, `H` of `H-04.1`.
pub fn prefix(id: &str) -> &str {
    id.split('-').next().unwrap_or_default()
}

/// `H-04` of `H-04.1`: a rule with all its requirements.
pub fn rule(id: &str) -> &str {
    id.split('.').next().unwrap_or_default()
}

#[test]
fn ids_are_whole_words() {
    let text = "DIST-02, H-04.1. I-02: F-42-hidden ISO-8859 UTF-8 x-12 H-14.\nA-H-01 \u{e9}S1-03";
    assert_eq!(ids_in(text), ["DIST-02", "H-04.1", "I-02", "H-14", "S1-03"]);
}

#[test]
fn a_requirement_ends_where_the_next_begins_and_has_no_reason() {
    let text = "## Monitor\n\n* **[A-01]** It MUST   be:\n  * this;\n  Why: since\n  so.\n\n\
                * **[A-02]** So MUST it:\n\n| a |\n\nIt MUST not be lost.\n\n| **[A-03]** x | 1 |\n\
                | I-02 | how | so |\n";
    let file = "spec/monitor.md";
    let (found, nameless) = requirements(&Tree([(file.to_owned(), text.to_owned())].into()));
    let found: Vec<_> = found.iter().map(|it| (it.id.as_str(), it.text.as_str())).collect();
    let expected = [
        ("A-01", "It MUST be: * this;"),
        ("A-02", "So MUST it: | a |"),
        ("A-03", "x | 1 |"),
        ("I-02", "how | so |"),
    ];
    assert_eq!(found, expected);
    assert_eq!(nameless, [format!("{file}#monitor: It MUST not be lost.")]);
}
