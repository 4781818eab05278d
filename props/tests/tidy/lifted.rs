//! Lints that `impl` and `capi` lift, beside the page that has each place with its reason.

use super::tree::Tree;

const PAGE: &str = "docs/iso-26262.md";

/// Files that lift lints at other counts of places than the page names them. A row of the page begins with a lint.
pub fn not_listed(tree: &Tree) -> Vec<(String, String)> {
    let page = tree.0.get(PAGE).map_or("", String::as_str);
    let is_row = |line: &&str| line.starts_with("| `clippy::") || line.starts_with("| `missing_");
    let rows: Vec<&str> = page.lines().filter(is_row).collect();
    let mut wrong = Vec::new();
    for (path, text) in tree.ending(".rs") {
        if !path.starts_with("impl/src/") && !path.starts_with("capi/src/") {
            continue;
        }
        let name = format!("`{path}`");
        let listed: usize = rows.iter().map(|row| row.matches(&name).count()).sum();
        let lifted = text.lines().filter(|line| lifts(line.trim_start())).count();
        if lifted != listed {
            wrong.push((path.to_owned(), format!("lifts {lifted} times, {PAGE} has {listed}")));
        }
    }
    wrong
}

/// What lifts a lint for a whole file is of tests: `lib.rs` and files of `#[cfg(test)]`.
fn lifts(line: &str) -> bool {
    line.starts_with("#[allow(") || line.starts_with("#[expect(")
}

#[test]
fn a_lint_that_is_lifted_in_silence_is_seen() {
    let wrong = |text: &str, page: &str| {
        let files = [("impl/src/a.rs", text), ("props/src/b.rs", "#[allow(x)]\n"), (PAGE, page)];
        let files = files.map(|(path, text)| (path.to_owned(), text.to_owned()));
        not_listed(&Tree(files.into())).len()
    };
    let row = "| `clippy::x` | 1 | `impl/src/a.rs` (why) |\n";
    assert_eq!(wrong("    #[allow(clippy::x)]\n", row), 0);
    assert_eq!(wrong("#[expect(\n    clippy::x,\n)]\n", row), 0);
    assert_eq!(wrong("#[allow(clippy::x)]\n", "`impl/src/a.rs`"), 1, "no row");
    assert_eq!(wrong("fn a() {}\n", row), 1, "no such place any more");
    assert_eq!(wrong("#[allow(a)]\n#[allow(b)]\n", row), 1, "two places");
}
