//! Style that a search for words can keep.

use super::tree::Tree;

/// What Rust must not say, and why. In two parts, so that they are not found here.
const NOT_IN_RUST: [(&str, &str, &str); 5] = [
    ("todo", "!(", "what is not there is not claimed"),
    ("unimplemented", "!(", "what is not there is not claimed"),
    ("dbg", "!(", "is left from a search for a mistake"),
    ("#[ign", "ore", "a test that is not run shows nothing"),
    ("FIX", "ME", "a known mistake is mended or is a finding"),
];

/// What breaks the style: words above, sources without a sentence at the top (but for the tests of
/// the module around them), and paths of somebody's machine.
pub fn broken(tree: &Tree) -> Vec<(String, String)> {
    let mut wrong = Vec::new();
    for (path, text) in tree.ending(".rs") {
        for (word, rest, why) in NOT_IN_RUST {
            if text.contains(&format!("{word}{rest}")) {
                wrong.push((path.to_owned(), format!("{word}{rest}: {why}")));
            }
        }
        if !text.starts_with("//!") && !text.starts_with("#!") && !path.ends_with("/tests.rs") {
            wrong.push((path.to_owned(), "does not begin with what it is (//!)".to_owned()));
        }
    }
    let text = [".rs", ".md", ".toml"].into_iter().flat_map(|kind| tree.ending(kind));
    for (path, text) in text {
        for home in ["/ho", "/wo", "/tm"].iter().zip(["me/", "rk/", "p/"]) {
            let home = format!("{}{}", home.0, home.1);
            let starts =
                |at: usize| !text[..at].ends_with(|c: char| c.is_alphanumeric() || c == '.');
            if text.match_indices(&home).any(|(at, _)| starts(at)) {
                wrong.push((path.to_owned(), format!("{home}: a path of somebody's machine")));
            }
        }
    }
    wrong
}

#[test]
fn what_breaks_the_style_is_seen() {
    let tree = |text: &str| Tree([("a/src/b.rs".to_owned(), text.to_owned())].into());
    let late = concat!("//! A.\nfn a() { todo", "!() }\n");
    let machine = concat!("//! A.\n// /ho", "me/me/a.rs\n");
    for text in [late, machine, "fn a() {}\n"] {
        assert_eq!(broken(&tree(text)).len(), 1, "{text}");
    }
    assert!(broken(&tree("//! A.\nfn a() { done() }\n")).is_empty());
}
