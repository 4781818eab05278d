//! "No result MUST ..." asks for nothing: by RFC 2119 it says that a result need not, and "MUST ... only" that it has
//! to at least then. MUST NOT forbids.

use super::tree::Tree;

/// Words before MUST that turn round what is asked for.
const TURNING: [&str; 7] = ["no", "neither", "nor", "only", "none", "nothing", "nobody"];

/// Clauses of `spec/` in which such a word stands before MUST.
pub fn turned_round(tree: &Tree) -> Vec<(String, String)> {
    let mut wrong = Vec::new();
    for (path, text) in tree.ending(".md").filter(|(path, _)| path.starts_with("spec/")) {
        let clauses = text.split(". ").flat_map(|it| it.split([',', ';', ':', '(', '|', '\n']));
        for clause in clauses {
            let parts: Vec<_> = clause.split("MUST").collect();
            let words = |it: &str| {
                let split = it.split(|c: char| !c.is_alphabetic());
                split.map(str::to_lowercase).collect::<Vec<_>>()
            };
            let mut before = parts[..parts.len() - 1].iter().flat_map(|it| words(it));
            let is_only = |it: &&str| words(it).iter().any(|word| word == "only");
            if before.any(|word| TURNING.contains(&word.as_str())) || parts[1..].iter().any(is_only)
            {
                wrong.push((path.to_owned(), format!("write MUST NOT: {}", clause.trim())));
            }
        }
    }
    wrong
}

#[test]
fn a_requirement_that_asks_for_nothing_is_seen() {
    let tree = |text: &str| Tree([("spec/1-a.md".to_owned(), text.to_owned())].into());
    let only = ["Only tracks MUST pass.", "It MUST be used only now."];
    for text in ["No result MUST count.", "A (b): neither MUST panic."].into_iter().chain(only) {
        assert_eq!(turned_round(&tree(text)).len(), 1, "{text}");
    }
    let fine = "There is no list. It MUST end, when no one asks. It only helps.";
    assert_eq!(turned_round(&tree(fine)), []);
}
