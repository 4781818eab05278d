//! Every requirement of `spec/` has an id, is cited, and stays what it was when it was cited.
//!
//! `**[DIST-02]**` in the text names a requirement (`tree/ids.rs`); comments and strings of tests and
//! of `proofs/`, `requirement` and `flag` of vectors, and comments of the code cite it.
//! `spec/requirements.lock` holds a hash of each requirement, and of the terms of each rule, as it was confirmed. Who changes a sentence reads what cites
//! it and confirms it, id by id:
//! `CONFIRM=DIST-02,H-04.1 cargo test -p mufasa-props --test requirements`.
//! This, and `UPDATE_MATRIX=1`, writes `docs/requirements.csv`, a row for each requirement. With
//! `-- --nocapture` the table of requirements and citations is printed.

#[path = "tree/citations.rs"]
mod citations;
#[path = "tree/code.rs"]
mod code;
#[path = "tree/hash.rs"]
mod hash;
#[path = "tree/ids.rs"]
mod ids;
#[path = "tree/lines.rs"]
mod lines;
#[path = "tree/lock.rs"]
mod lock;
mod tree;

use std::collections::BTreeSet;
use std::path::Path;

use citations::{Citations, citations, evidence, is_code, strangers};
use code::{exempt, matrix, not_implemented, not_proved};
use ids::{PREFIXES, Requirement, prefix, prefixes, requirements, rule};
use lock::{Lock, definitions};
use tree::Tree;

const LOCK: &str = "spec/requirements.lock";

const MATRIX: &str = "docs/requirements.csv";

/// Ids that stand twice, lines with a MUST that have none, and prefixes that stand elsewhere than the
/// table of prefixes says, or nowhere.
fn ill_named(tree: &Tree) -> Vec<String> {
    let (found, nameless) = requirements(tree);
    let mut wrong: Vec<String> = nameless.into_iter().map(|it| format!("no id: {it}")).collect();
    let mut known = BTreeSet::new();
    let table = prefixes(tree);
    for Requirement { id, place, .. } in &found {
        if !known.insert(id) {
            wrong.push(format!("{id} stands twice"));
        }
        if ids::ids_in(id) != [id] {
            wrong.push(format!("{id}: an id is a prefix and two digits, such as DIST-02"));
        }
        if !table.iter().any(|(name, target)| *name == prefix(id) && place.starts_with(target)) {
            wrong.push(format!("{id} stands at {place}: {PREFIXES} says otherwise"));
        }
    }
    for (name, target) in &table {
        if !found.iter().any(|it| prefix(&it.id) == *name) {
            wrong.push(format!("{PREFIXES}: {name} ({target}) has no requirement"));
        }
    }
    wrong
}

/// Requirements that no test, vector or proof cites, and reasons that none needs. A vector of a rule cites all that it
/// asks for.
fn not_cited(tree: &Tree, found: &[Requirement], cited: &Citations) -> Vec<String> {
    let mut exempt = exempt(tree, "Not tested");
    let of_rule = |id: &str| {
        let by = cited.get(rule(id)).into_iter().flatten();
        by.into_iter().any(|it| it.starts_with("vectors/"))
    };
    let tested = |id: &str| cited.get(id).into_iter().flatten().any(|by| !is_code(by));
    let without = found.iter().filter(|it| !tested(&it.id) && !of_rule(&it.id));
    let without = without.filter(|it| exempt.remove(it.id.as_str()).is_none());
    let mut wrong: Vec<String> = without.map(|it| format!("{}: {}", it.id, it.text)).collect();
    wrong.extend(exempt.keys().map(|id| format!("{id}: needs no reason not to be tested")));
    wrong
}

#[test]
fn every_requirement_has_an_id_of_its_own() {
    let wrong = ill_named(&Tree::here());
    assert!(wrong.is_empty(), "\n{}", wrong.join("\n"));
}

#[test]
fn every_requirement_is_cited_by_a_test_a_vector_or_a_proof() {
    let tree = Tree::here();
    let (found, _) = requirements(&tree);
    let cited = evidence(&tree);
    for Requirement { id, text, .. } in &found {
        let by: Vec<&str> = cited.get(id).into_iter().flatten().map(String::as_str).collect();
        println!("{id}\n    {text}\n    {}", by.join(" "));
    }
    let wrong = not_cited(&tree, &found, &cited);
    assert!(wrong.is_empty(), "requirements without a test: {wrong:#?}");
}

#[test]
fn every_requirement_is_implemented_somewhere() {
    let tree = Tree::here();
    let wrong = not_implemented(&tree, &requirements(&tree).0, &citations(&tree));
    assert!(wrong.is_empty(), "\n{}\n\nsee CONTRIBUTING.md, Requirements", wrong.join("\n"));
}

#[test]
fn every_requirement_has_a_proof_or_a_reason_why_not() {
    let tree = Tree::here();
    let wrong = not_proved(&tree, &requirements(&tree).0, &evidence(&tree));
    assert!(wrong.is_empty(), "\n{}\n\nsee {PREFIXES}, last column", wrong.join("\n"));
}

#[test]
fn the_matrix_is_what_the_sources_say() {
    let tree = Tree::here();
    let matrix = matrix(&tree, &requirements(&tree).0, &evidence(&tree));
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("..").join(MATRIX);
    if ["UPDATE_MATRIX", "CONFIRM"].iter().any(|name| std::env::var_os(name).is_some()) {
        std::fs::write(&file, &matrix).expect("the matrix can be written");
    }
    let kept = std::fs::read_to_string(&file).unwrap_or_default();
    assert!(kept == matrix, "{MATRIX} is old: UPDATE_MATRIX=1 and this test again");
}

#[test]
fn every_citation_is_of_a_requirement() {
    let tree = Tree::here();
    let wrong = strangers(&tree, &requirements(&tree).0, &Lock::parse(lock_of(&tree)).retired);
    assert!(wrong.is_empty(), "\n{}", wrong.join("\n"));
}

#[test]
fn what_cites_a_requirement_was_confirmed_since_it_changed() {
    let tree = Tree::here();
    let (mut found, _) = requirements(&tree);
    found.extend(definitions(&tree));
    let cited = citations(&tree);
    let mut lock = Lock::parse(lock_of(&tree));
    if let Ok(names) = std::env::var("CONFIRM") {
        let names = names.split([',', ' ']).filter(|it| !it.is_empty());
        lock.confirm(&names.collect::<Vec<_>>(), &found);
        let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("..").join(LOCK);
        std::fs::write(file, lock.to_string()).expect("the lock can be written");
    }
    let wrong = lock.suspects(&found, &cited);
    assert!(wrong.is_empty(), "\n{}\n\nsee CONTRIBUTING.md, Requirements", wrong.join("\n"));
}

fn lock_of(tree: &Tree) -> &str {
    tree.0.get(LOCK).map(String::as_str).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tree(files: &[(&str, &str)]) -> Tree {
        let table = "| prefix | where |\n|---|---|\n| `A` | [here](x.md) |\n";
        let files = files.iter().copied().chain([(PREFIXES, table)]);
        Tree(files.map(|(path, text)| (path.to_owned(), text.to_owned())).collect())
    }

    #[test]
    fn an_id_that_is_missing_or_stands_twice_or_elsewhere_is_seen() {
        let file = "spec/monitor.md";
        let wrong = ill_named(&tree(&[(
            file,
            "# M\n\n* **[A-01]** It MUST.\n* **[A-01]** So MUST it.\n* It MUST.\n",
        )]));
        let expected = [
            format!("no id: {file}#m: * It MUST."),
            format!("A-01 stands at {file}#m: {PREFIXES} says otherwise"),
            "A-01 stands twice".to_owned(),
            format!("A-01 stands at {file}#m: {PREFIXES} says otherwise"),
        ];
        assert_eq!(wrong, expected);
        assert_eq!(ill_named(&tree(&[])), ["spec/README.md: A (spec/x.md) has no requirement"]);
    }

    /// What is not cited and what is cited in vain, with a file beside two requirements.
    fn judged(path: &str, text: &str) -> [Vec<String>; 2] {
        let asked = "# M\n\n* **[A-01]** It MUST.\n* **[H-04.1]** So MUST it.\n";
        let tree = tree(&[("spec/monitor.md", asked), (path, text)]);
        let found = requirements(&tree).0;
        let retired = BTreeSet::from(["A-09".to_owned()]);
        [not_cited(&tree, &found, &citations(&tree)), strangers(&tree, &found, &retired)]
    }

    #[test]
    fn what_no_page_has_an_answer_for_is_no_proof() {
        let source = "const ALL: &[Theorem] = &[\n    // A-01\n    id: \"it_is\", // A-02\n];\n/// A-03\nfn part() {}\n";
        let files = [
            ("docs/proofs.md", "| `it_is` | It is. | z3 |\n| `a::verify` | So. | cbmc |\n"),
            ("proofs/theorems/src/theorem/b.rs", source),
            ("proofs/src/harness/a.rs", "/// A-04\nfn verify() {}\n/// A-05\nfn other() {}\n"),
            ("proofs/src/law/c.rs", "/// A-06\npub fn law() -> bool {}\n"),
        ];
        let kept = evidence(&tree(&files)).into_iter().filter(|(_, by)| !by.is_empty());
        assert_eq!(kept.map(|(id, _)| id).collect::<Vec<_>>(), ["A-02", "A-04", "A-06"]);
    }

    #[test]
    fn a_requirement_without_a_test_and_a_test_without_a_requirement_are_seen() {
        let fine = [Vec::<String>::new(), Vec::new()];
        let both = "/// A-01, H-04.1\n#[test]\nfn f() {}\n";
        assert_eq!(judged("a/tests/b.rs", both), fine);
        assert_eq!(
            judged("proofs/src/law/a.rs", "/// A-01, H-04.1\npub fn f() -> bool {}\n"),
            fine
        );
        let first = ["A-01: It MUST."];
        assert_eq!(
            judged("vectors/a.jsonl", r#"{"requirement": "H-04", "note": "A-01"}"#)[0],
            first
        );
        // A rule as a whole is cited by a vector alone, and a source is no test.
        let second = ["H-04.1: So MUST it."];
        assert_eq!(judged("a/tests/b.rs", "// A-01, H-04\n#[test]\nfn f() {}\n")[0], second);
        assert_eq!(judged("a/src/b.rs", "/// A-01, H-04.1\nfn f() {}\n")[0].len(), 2);
        // Neither is code; but the tests at its end are.
        let code =
            "// A-01, H-04.1\nfn f() {}\n#[cfg(test)]\nmod tests {\n    // A-01\n    #[test]\n}\n";
        assert_eq!(judged("impl/src/b.rs", code)[0], second);

        let stranger = |path: &str| format!("{path}: A-09 is no requirement");
        assert_eq!(judged("a/src/b.rs", "// A-09, B-01")[1], [stranger("a/src/b.rs")]);
        let vector = r#"{"requirement": "A-09", "id": "A-07"}"#;
        assert_eq!(judged("vectors/a.jsonl", vector)[1], [stranger("vectors/a.jsonl")]);
        assert_eq!(judged("a.md", "A-09 was retired.")[1], [""; 0]);
        assert_eq!(judged("a.md", "A-08 is made up.")[1], ["a.md: A-08 is no requirement"]);
    }
}
