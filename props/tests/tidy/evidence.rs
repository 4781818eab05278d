//! Evidence that the pages for an assessor name between backticks.

use std::collections::BTreeSet;

use super::lines::item;
use super::links::fences_left_out;
use super::tree::Tree;

/// The pages.
const PAGES: [&str; 7] = [
    "docs/safety-manual.md",
    "docs/hazards.md",
    "docs/known-problems.md",
    "docs/iso-26262.md",
    "docs/tools.md",
    "docs/what-the-proofs-assume.md",
    "SECURITY.md",
];

/// Names of files, functions, claims and vectors on these pages that are not in the sources; a page that is not
/// there.
///
/// A name is a file when it has a `/`, with `::` and an item of that file behind it or not. It is a
/// function or a claim when it has at least three `_`, or `::verify_`, and a vector when it begins with a finding.
pub fn missing(tree: &Tree) -> Vec<(String, String)> {
    let functions: BTreeSet<&str> =
        tree.ending(".rs").flat_map(|(_, text)| text.lines().filter_map(of_line)).collect();
    let claims = tree.0.get("docs/proofs.md").map_or("", String::as_str);
    let claims: BTreeSet<&str> = claims
        .lines()
        .filter_map(|line| Some(line.strip_prefix("| `")?.split_once('`')?.0))
        .collect();
    let vectors: String = tree.ending(".jsonl").map(|(_, text)| text).collect();
    let exists = |name: &str| {
        if name.contains('/') {
            let (file, item) = name.split_once("::").map_or((name, None), |(f, i)| (f, Some(i)));
            let text = tree.0.get(file);
            let has = |item| text.is_some_and(|it| it.lines().any(|it| of_line(it) == Some(item)));
            return item.map_or(text.is_some() || is_folder(tree, file), has);
        }
        if is_finding(name) {
            return vectors.contains(&format!("\"id\": \"{name}\""));
        }
        let is_function = name.matches('_').count() > 2 || name.contains("::verify_");
        !is_function || functions.contains(name) || claims.contains(name)
    };
    let mut wrong = Vec::new();
    for page in PAGES {
        let Some(text) = tree.0.get(page) else {
            wrong.push((page.to_owned(), "is not there".to_owned()));
            continue;
        };
        let text = fences_left_out(text);
        let names = text.split('`').skip(1).step_by(2).filter(|name| is_plain(name));
        let unknown = names.filter(|name| !exists(name));
        wrong.extend(unknown.map(|name| (page.to_owned(), format!("`{name}` is nowhere"))));
    }
    wrong
}

/// The item that begins on a line.
fn of_line(line: &str) -> Option<&str> {
    item(line.trim_start())
}

/// One word, and no option of a command.
fn is_plain(name: &str) -> bool {
    name.chars().all(|c| c.is_alphanumeric() || "/._-:".contains(c)) && !name.starts_with('-')
}

/// `F-46-turns`
fn is_finding(name: &str) -> bool {
    let rest = name.strip_prefix("F-").unwrap_or_default();
    rest.split_once('-').is_some_and(|(number, _)| number.bytes().all(|c| c.is_ascii_digit()))
}

fn is_folder(tree: &Tree, name: &str) -> bool {
    let folder = format!("{}/", name.trim_end_matches('/'));
    tree.0.keys().any(|path| path.starts_with(&folder))
}

#[test]
fn a_name_of_nothing_is_seen() {
    let with = |text: &str| {
        let files = [
            ("a/src/b.rs", "fn it_is_found_here() {}\nconst fn c() {}\n"),
            ("docs/proofs.md", "| `of-any_CAV_is_proved` | x |\n| `a::verify_b` | y |\n"),
            ("vectors/f.jsonl", "{\"id\": \"F-01-paper\"}\n"),
        ];
        let pages = PAGES.map(|page| (page, if page == PAGES[0] { text } else { "" }));
        let files = files.into_iter().chain(pages);
        missing(&Tree(files.map(|(path, text)| (path.to_owned(), text.to_owned())).collect()))
    };
    for text in [
        "`it_is_found_there`",
        "`of_any_CAV_is_refuted`",
        "`a::verify_c`",
        "`F-01-hardened`",
        "`a/src/c.rs`",
        "`a/src/b.rs::d`",
        "`d/src/`",
    ] {
        assert_eq!(with(text).len(), 1, "{text}");
    }
    let fine = "`it_is_found_here` `of-any_CAV_is_proved` `a::verify_b` `F-01-paper` `a/src/b.rs` \
                `a/src/b.rs::c` `a/src/` `t_wait` `cargo run -p a_b_c_d`\n```sh\n`a/no/file`\n```";
    assert_eq!(with(fine), []);
    assert_eq!(missing(&Tree([].into())).len(), PAGES.len(), "no page at all");
}
