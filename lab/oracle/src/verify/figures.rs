//! What was measured before, as parts of a page, beside it the commit that it is of and what changed since.

use std::fs;
use std::path::Path;

use mufasa_drives::pictures::escape;

#[path = "../../../../props/tests/tree/stamps.rs"]
mod stamps;

use self::stamps::{SOURCES, Stamp, stamps};
use super::documents::{self, link};
use crate::document;

/// The page about tests, and how its sentences with figures begin.
const COVERAGE: &str = "docs/coverage.md";
const STRENGTH: [&str; 5] = [
    "Measured with: ",
    "Requirements that code cites: ",
    "Lines with code that tests execute: ",
    "Conditions that tests saw true and false: ",
    "Commit ",
];
const MARGINS: &str = "docs/safety-manual.md";
/// Documents, and the place in each whose first table has figures.
const FIGURES: [(&str, &str, &str); 5] = [
    ("docs/drives.md", "scripts/availability", "Clean cycles of recorded drives that are accepted"),
    ("docs/exploration.md", "mufasa explore --bounds small", "Worlds of the protocol"),
    ("docs/speed.md", "race", "Times beside the best libraries"),
    ("docs/embedded.md", "embedded", "Bytes on processors of vehicles"),
    (MARGINS, "mufasa evaluate margins", "How far assumptions may be wrong"),
];
/// A drive that a test drives anew, so that its table has no stamp.
const DEMO: (&str, &str) = ("docs/drives.md", "mufasa demo");

/// The stamp of a page, as an item of a list.
struct Row {
    page: &'static str,
    text: String,
    html: String,
    is_old: bool,
}

/// All stamps of the checkout.
pub(super) struct Record<'r> {
    root: &'r Path,
    up: Option<&'r str>,
    rows: Vec<Row>,
}

impl<'r> Record<'r> {
    pub(super) fn new(root: &'r Path, up: Option<&'r str>) -> Self {
        let row = |page, stamp: &Stamp<'_>| {
            let place = link(page, &format!("{page}:{}", stamp.line), up);
            let old = stamp.old(root);
            let said = old.as_ref().map_or_else(
                || format!("no source changed since {}", escape(stamp.commit)),
                |it| format!("<b class=\"not-run\">OLD: {}</b>", escape(it)),
            );
            let html = format!("<li>{place}: {said}</li>\n");
            Row { page, text: stamp.text.to_owned(), html, is_old: old.is_some() }
        };
        let of = |(page, _): &(&'static str, _)| {
            let text = fs::read_to_string(root.join(page)).unwrap_or_default();
            stamps(page, &text).iter().map(|it| row(*page, it)).collect::<Vec<_>>()
        };
        Self { root, up, rows: SOURCES.iter().flat_map(of).collect() }
    }

    /// How many are old, if there are some.
    pub(super) fn old(&self) -> String {
        let (old, all) = (self.rows.iter().filter(|it| it.is_old).count(), self.rows.len());
        if old == 0 {
            return String::new();
        }
        format!(
            "<p class=\"not-run\">OLD: the sources of {old} of {all} <a href=\"#figures\">measured tables</a> \
             have changed since.</p>\n"
        )
    }

    /// What tests execute and notice.
    pub(super) fn strength(&self) -> String {
        let said = documents::lines(self.root, COVERAGE, &STRENGTH, self.up);
        let link = link(COVERAGE, COVERAGE, self.up);
        let stamps = self.stamps(COVERAGE, "");
        if said.is_empty() {
            said
        } else {
            format!("<p>From {link}, on record:</p>\n{stamps}{said}")
        }
    }

    /// Figures, a cycle of the demo, and how far assumptions may be wrong.
    pub(super) fn figures(&self) -> String {
        let tables =
            FIGURES.map(|(file, place, words)| self.folded(file, place, words, true)).concat();
        let demo = self.folded(
            DEMO.0,
            DEMO.1,
            "A drive, attacked: what is caught; a test keeps it",
            false,
        );
        format!(
            "<p>These are on record. This run did not measure them anew.</p>\n<details open=\"open\">\n\
             <summary>Of which commit each table is</summary>\n{}</details>\n{tables}{demo}",
            list(self.rows.iter())
        ) + &documents::picture(self.root, "docs/demo.svg")
            + &self.stamps(MARGINS, "")
            + &documents::picture(self.root, "docs/margins.svg")
    }

    fn folded(&self, file: &str, place: &str, words: &str, is_stamped: bool) -> String {
        let text = document::read(&self.root.join(file), place).unwrap_or_default();
        let stamps = if is_stamped { self.stamps(file, &text) } else { String::new() };
        let (link, table) = (link(file, file, self.up), documents::tables(&text, file, self.up, 1));
        format!(
            "<details>\n<summary>{words}</summary>\n<p>From {link}.</p>\n{stamps}{table}</details>\n"
        )
    }

    /// Those in a part of a page, or where it has none all of the page.
    fn stamps(&self, page: &str, part: &str) -> String {
        let of_page = || self.rows.iter().filter(|it| it.page == page);
        let has_own = of_page().any(|it| part.contains(&it.text));
        list(of_page().filter(|it| !has_own || part.contains(&it.text)))
    }
}

fn list<'t>(rows: impl Iterator<Item = &'t Row>) -> String {
    let items: String = rows.map(|it| it.html.as_str()).collect();
    if items.is_empty() { items } else { format!("<ul>\n{items}</ul>\n") }
}
