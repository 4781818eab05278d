//! Stamps of tables that were measured: that their commits had no changes, that no page lacks one, and what changed since.

use std::path::Path;

#[path = "../tree/stamps.rs"]
mod of_pages;

use super::tree::Tree;
use of_pages::{BESIDES, SOURCES, stamps};

/// What begins a table that a program writes.
const WRITTEN: &str = ": begin -->";

/// Stamps of no commit, or of a page whose sources are not known; pages without a stamp.
pub fn wrong(tree: &Tree) -> Vec<(String, String)> {
    let mut wrong = Vec::new();
    for (page, text) in tree.ending(".md") {
        let stamps = stamps(page, text);
        for stamp in &stamps {
            let place = format!("{page}:{}", stamp.line);
            if stamp.text.contains(&format!("{} with changes", stamp.commit)) {
                wrong.push((
                    stamp.commit.to_owned(),
                    format!("{place}: with changes, measure it again"),
                ));
            }
            if stamp.sources.is_none() {
                wrong.push((page.to_owned(), format!("{place}: SOURCES does not say of what")));
            }
        }
        // Whatever changed says when.
        let is_history = page.ends_with("CHANGES.md") || page.ends_with("CHANGELOG.md");
        let is_measured =
            !is_history && text.lines().any(|it| it.ends_with(WRITTEN) || has_date(it));
        let is_known = SOURCES.iter().any(|(it, _)| *it == page);
        if stamps.is_empty() && (is_measured || is_known) {
            wrong.push((page.to_owned(), "has figures and no stamp (scripts/measured)".to_owned()));
        }
    }
    if tree.0.get("docs/conformance.md").is_some_and(|it| !it.contains(BESIDES.0)) {
        wrong.push((BESIDES.0.to_owned(), "no stamp depends on vectors".to_owned()));
    }
    for (page, sources) in SOURCES {
        for it in sources.split(' ').filter(|it| !tree.0.keys().any(|file| file.starts_with(it))) {
            wrong.push((it.to_owned(), format!("is not there, and {page} depends on it")));
        }
    }
    wrong
}

/// Whether it has a date, such as 2026-11-29.
fn has_date(line: &str) -> bool {
    let is_right = |(at, byte): (usize, &u8)| match at {
        4 | 7 => *byte == b'-',
        _ => byte.is_ascii_digit(),
    };
    line.as_bytes().windows(10).any(|it| it.iter().enumerate().all(is_right))
}

/// Of each stamp whose sources are others now what changed, or why nobody can know.
pub fn old(tree: &Tree, root: &Path) -> Vec<String> {
    let pages = tree.ending(".md").flat_map(|(page, text)| {
        let of =
            move |it: of_pages::Stamp<'_>| Some(format!("{page}:{}: {}", it.line, it.old(root)?));
        stamps(page, text).into_iter().filter_map(of)
    });
    pages.collect()
}

#[test]
fn a_stamp_that_says_too_little_is_seen() {
    let of = |text: &str, page: &str| {
        let stamp = "The vectors: commit 0123456789, rustc\n".to_owned();
        let pages = SOURCES.map(|(it, _)| (it.to_owned(), stamp.clone()));
        let sources = SOURCES.iter().flat_map(|it| it.1.split(' '));
        let sources = sources.map(|it| (it.to_owned(), String::new()));
        let more = [(page.to_owned(), text.to_owned())];
        Tree(pages.into_iter().chain(sources).chain(more).collect())
    };
    let page = "docs/drives.md";
    let count = |text: &str, page: &str| wrong(&of(text, page)).len();
    assert_eq!(count("Measured with: commit 0123456789 with changes, rustc", page), 1);
    assert_eq!(count("It may commit everything.", page), 1, "no stamp");
    assert_eq!(count("Commit 0123456789.", "docs/b.md"), 1, "no sources");
    assert_eq!(count("commit 0123456789", "docs/conformance.md"), 1, "no vectors");
    assert_eq!(count("Measured on 2026-11-29.", "docs/b.md"), 1, "a date");
    assert_eq!(count("<!-- a: begin -->", "docs/b.md"), 1, "written by a program");
    assert_eq!(count("Version 2-11-29 of 2026-1-2.", "docs/b.md"), 0, "no date");
    let tree = of("1 (commit 0123456789)", page);
    assert_eq!(wrong(&tree), []);
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    assert!(old(&tree, root).iter().all(|it| it.ends_with("nobody can know")), "no such commit");
    assert_eq!(
        wrong(&Tree([].into())).len(),
        SOURCES.iter().flat_map(|it| it.1.split(' ')).count()
    );
}
