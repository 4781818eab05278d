//! Every mutant still applies: its item is there, and `from` stands in it once.

use std::collections::BTreeSet;
use std::path::Path;

use mufasa_mutants::place::{Sources, Span};

#[test]
fn every_mutant_applies() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let sources = Sources::read(&root).expect("the sources are Rust");
    let mutants = mufasa_mutants::all().expect("the list is read");
    let mut problems = Vec::new();
    for mutant in &mutants {
        assert!(!mutant.at.is_empty() && !mutant.refutes.is_empty(), "{}", mutant.change);
        let mut taken: Vec<Span<'_>> = Vec::new();
        for place in &mutant.at {
            assert_ne!(place.from, place.to, "{}", mutant.change);
            match sources.find(place) {
                Ok(found) if taken.iter().any(|other| other.overlaps(&found)) => {
                    problems.push(format!("{}: two places overlap", mutant.change));
                }
                Ok(found) => taken.push(found),
                Err(problem) => problems.push(problem),
            }
        }
    }
    assert!(problems.is_empty(), "{}", problems.join("\n"));
    let changes: BTreeSet<&str> = mutants.iter().map(|mutant| mutant.change.as_str()).collect();
    assert_eq!(changes.len(), mutants.len(), "a sentence names one mutant");
}
