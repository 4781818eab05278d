//! How many findings there are, and how many are open: the README, the page of findings and that of known problems count the
//! rows of their tables.

use super::tree::Tree;

/// Sentences that a page should have, by what its table has, and has not.
pub fn missing(tree: &Tree) -> Vec<(String, String)> {
    let text = |path: &str| tree.0.get(path).map_or("", |text| text);
    let rows = |text: &'_ str| -> Vec<String> {
        text.lines().filter(|it| it.starts_with("| [F-")).map(str::to_owned).collect()
    };
    let all = rows(text("findings/README.md"));
    let hardened = all.iter().filter(|it| it.contains(".md) | (hardened")).count();
    let method = all.len() - hardened;
    let (first, _) = text("docs/known-problems.md").split_once("## Rests").unwrap_or_default();
    let open = rows(first).len();
    [
        ("README.md", format!("one of [{} findings]", all.len())),
        (
            "README.md",
            format!("{method} about the method and {hardened} about the hardened profile"),
        ),
        ("README.md", format!("{open} findings are open in `hardened`")),
        ("findings/README.md", format!("{method} findings are about the paper profile")),
        ("findings/README.md", format!("{hardened}, marked \"hardened\"")),
    ]
    .into_iter()
    .filter(|(path, words)| {
        let page: Vec<_> = text(path).split_whitespace().collect();
        !page.join(" ").contains(words)
    })
    .map(|(path, words)| (path.to_owned(), words))
    .collect()
}

#[test]
fn a_finding_that_is_not_counted_is_seen() {
    let mut tree = Tree::here();
    let page = tree.0.get_mut("findings/README.md").expect("the page");
    page.push_str("| [F-99](F-99.md) | (hardened) a new one |\n");
    assert_eq!(missing(&tree).len(), 3);
}
