//! Links of Markdown, and files and headings that prose and comments name.

use super::tree::{Tree, sections};

/// Links to files that are not there and to headings that are not there.
pub fn broken(tree: &Tree) -> Vec<(String, String)> {
    let mut wrong = Vec::new();
    for (path, text) in tree.ending(".md") {
        for link in links(&prose(text)) {
            if link.contains("://") || link.starts_with("mailto:") {
                continue;
            }
            if !leads(tree, path, link) {
                wrong.push((path.to_owned(), format!("({link}) leads nowhere")));
            }
        }
    }
    wrong
}

/// Whether a link of a file leads to a file, a folder or a heading.
pub fn leads(tree: &Tree, from: &str, link: &str) -> bool {
    let (file, anchor) = link.split_once('#').unwrap_or((link, ""));
    let target = if file.is_empty() { from.to_owned() } else { join(from, file) };
    let is_folder = tree.0.keys().any(|it| it.starts_with(&format!("{target}/")));
    match tree.0.get(&target) {
        Some(text) => anchor.is_empty() || sections(text).iter().any(|it| it.anchor == anchor),
        None => anchor.is_empty() && is_folder,
    }
}

/// Files that Markdown names between backticks, from the root or from its own folder, and that are
/// not there. Each is a place of its own.
pub fn named(tree: &Tree) -> Vec<(String, String)> {
    let mut wrong = Vec::new();
    for (path, text) in tree.ending(".md") {
        for code in fences_left_out(text).split('`').skip(1).step_by(2) {
            let name = code.split(['#', ':']).next().unwrap_or_default();
            let kind = name.rsplit_once('.').map_or("", |(_, kind)| kind);
            let is_file =
                ["rs", "md", "toml", "json", "jsonl", "svg", "py", "c", "h"].contains(&kind);
            let plain = |c: char| c.is_alphanumeric() || "/._-".contains(c);
            if !is_file || !name.contains('/') || !name.chars().all(plain) || name.starts_with('/')
            {
                continue;
            }
            let is_there =
                [name.to_owned(), join(path, name)].iter().any(|it| tree.0.contains_key(it));
            if !is_there {
                wrong.push((name.to_owned(), format!("is named by {path}")));
            }
        }
    }
    wrong
}

/// Headings of `spec/` that Rust and Markdown name and that are not there.
pub fn headings_named(tree: &Tree) -> Vec<(String, String)> {
    let mut wrong = Vec::new();
    for (path, text) in tree.ending(".rs").chain(tree.ending(".md")) {
        for (at, _) in text.match_indices("spec/") {
            let name = |c: char| c.is_alphanumeric() || "/._-#".contains(c);
            let end = text[at..].find(|c| !name(c)).map_or(text.len(), |end| at + end);
            let Some((file, anchor)) = text[at..end].split_once(".md#") else { continue };
            let anchor = anchor.split('.').next().unwrap_or_default();
            let known = tree.0.get(&format!("{file}.md")).map(|text| sections(text));
            let is_there = known.is_some_and(|all| all.iter().any(|it| it.anchor == anchor));
            if !is_there && !anchor.is_empty() {
                wrong.push((path.to_owned(), format!("{file}.md#{anchor} is no heading")));
            }
        }
    }
    wrong
}

/// The targets of `[words](target)`.
fn links(text: &str) -> impl Iterator<Item = &str> {
    let ends = text.match_indices("](").map(|(at, _)| &text[at + 2..]);
    ends.filter_map(|rest| rest.split_once(')').map(|(target, _)| target))
}

/// Without fenced blocks and what stands between backticks.
fn prose(text: &str) -> String {
    fences_left_out(text).split('`').step_by(2).collect()
}

/// Without fenced and indented blocks.
pub fn fences_left_out(text: &str) -> String {
    let mut fenced = false;
    let mut kept = String::new();
    for line in text.lines() {
        let fence = line.starts_with("```");
        fenced ^= fence;
        if !fenced && !fence && !line.starts_with("    ") {
            kept += line;
            kept.push('\n');
        }
    }
    kept
}

/// A path from the folder of a file.
fn join(from: &str, to: &str) -> String {
    let mut parts: Vec<&str> = from.split('/').collect();
    parts.pop();
    for part in to.trim_end_matches('/').split('/') {
        match part {
            ".." => drop(parts.pop()),
            "." => {}
            part => parts.push(part),
        }
    }
    parts.join("/")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn with(text: &str) -> Tree {
        let files = [
            ("docs/a.md", text),
            ("spec/b.md", "# One\n## Two words\n"),
            ("text/b.md", "# One\n\n## Two words\n"),
            ("src/c.rs", ""),
        ];
        Tree(files.map(|(path, text)| (path.to_owned(), text.to_owned())).into())
    }

    #[test]
    fn links_that_lead_nowhere_are_seen() {
        for text in ["[b](b.md)", "![b](../text/c.svg)", "[b](../text/b.md#three)", "[me](#here)"] {
            assert_eq!(broken(&with(text)).len(), 1, "{text}");
        }
        for text in [
            "[b](../text/b.md) [c](../src/c.rs) [folder](../src) [far](https://example.org)",
            "[b](../text/b.md#two-words)",
            "# Here\n[me](#here)",
            "`[b](b.md)`",
            "```sh\n[b](b.md)\n```",
        ] {
            assert!(broken(&with(text)).is_empty(), "{text}");
        }
    }

    #[test]
    fn files_and_headings_that_are_gone_are_seen() {
        let b = concat!("spec", "/b.md");
        assert_eq!(named(&with(&format!("`src/d.rs` and `{b}#two-words`"))).len(), 1);
        assert!(
            named(&with("`src/c.rs::f`, `../src/c.rs`, `cargo run a/b.rs`, `x.rs`")).is_empty()
        );
        assert_eq!(headings_named(&with(&format!("{b}#two, {b}#two-words.1."))).len(), 1);
    }
}
