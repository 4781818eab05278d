//! Lengths of files.

use super::tree::Tree;

/// Files of Rust above a number of lines.
pub fn too_long(tree: &Tree, most: usize) -> Vec<(String, String)> {
    let lengths = tree.ending(".rs").map(|(path, text)| (path, text.lines().count()));
    let long = lengths.filter(|(_, lines)| *lines > most);
    long.map(|(path, lines)| (path.to_owned(), format!("{lines} lines"))).collect()
}

/// A README above a number of bytes, or none.
pub fn readme(tree: &Tree, most: usize) -> Vec<(String, String)> {
    let bytes = tree.0.get("README.md").map(String::len);
    let wrong = bytes.is_none_or(|bytes| bytes > most);
    wrong.then(|| ("README.md".to_owned(), format!("{bytes:?} bytes"))).into_iter().collect()
}

#[test]
fn what_is_too_long_is_seen() {
    let files = [("a/long.rs", "1\n2\n3\n"), ("a/short.rs", "1\n2\n"), ("README.md", "123456")];
    let tree = Tree(files.map(|(path, text)| (path.to_owned(), text.to_owned())).into());
    assert_eq!(too_long(&tree, 2), [("a/long.rs".to_owned(), "3 lines".to_owned())]);
    assert_eq!((readme(&tree, 5).len(), readme(&tree, 6).len()), (1, 0));
}
