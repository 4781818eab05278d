//! Every mutant still applies; and the record of the changes under CBMC has every one of them as it is, none
//! survived, and `proofs/HARNESSES.md` says how many were run.

use std::collections::BTreeSet;
use std::path::Path;

use mufasa_mutants::place::{Sources, Span};
use mufasa_mutants::{Engine, Mutant, Seen};

const HARNESSES: &str = include_str!("../../HARNESSES.md");
const MONITOR: &str = include_str!("../../mutants-monitor.md");

#[test]
fn every_change_for_cbmc_is_in_the_record() {
    let mutants = mufasa_mutants::all().expect("the list is read");
    let seen = mufasa_mutants::seen().expect("the record is read");
    let said = |mutant: &Mutant| {
        let claims = mutant.refutes.get(&Engine::Cbmc).cloned().unwrap_or_default();
        let (change, fingerprint) = (mutant.change.clone(), mutant.fingerprint());
        claims.into_iter().map(move |claim| (change.clone(), claim, fingerprint.clone()))
    };
    let said: BTreeSet<_> = mutants.iter().flat_map(said).collect();
    let found = seen.iter().map(|one| (one.change.clone(), one.claim.clone(), one.mutant.clone()));
    let found: BTreeSet<_> = found.collect();
    let (never, old) = (said.difference(&found), found.difference(&said));
    let problems: Vec<_> = never
        .map(|it| format!("not in the record as it is: {it:?}"))
        .chain(old.map(|it| format!("not in mutants.toml as it was: {it:?}")))
        .collect();
    assert!(problems.is_empty(), "scripts/mutants --missing cbmc\n{}", problems.join("\n"));
    assert_eq!(found.len(), seen.len(), "one entry for each");
}

#[test]
fn none_survived_and_the_number_of_runs_is_said() {
    let seen = mufasa_mutants::seen().expect("the record is read");
    let was_run = |one: &&Seen| one.found != "not run";
    for one in seen.iter().filter(was_run) {
        assert_eq!(one.found, "refuted", "{}: {}", one.change, one.claim);
        assert!(one.seconds.is_some() && one.sources.is_some(), "{}: {}", one.change, one.claim);
    }
    let number = format!("Of {} such pairs {} ", seen.len(), seen.iter().filter(was_run).count());
    assert!(HARNESSES.contains(&number), "proofs/HARNESSES.md does not say: {number}");
}

/// The page is of the list as it is, none survived, and `proofs/HARNESSES.md` says how many were run.
#[test]
fn each_seeded_bug_of_the_monitor_is_on_the_page() {
    let mutants = mufasa_mutants::all().expect("the list is read");
    let said = mutants.iter().flat_map(|mutant| {
        let claims = mutant.refutes.get(&Engine::Monitor).into_iter().flatten();
        claims.map(move |claim| format!("| {claim} | {} |", mutant.change))
    });
    let mut said: Vec<String> = said.collect();
    said.sort();
    let rows: Vec<&str> = MONITOR.lines().filter(|it| it.starts_with("| MON-")).collect();
    assert_eq!(rows.len(), said.len(), "scripts/mutants monitor");
    let run = rows.iter().filter(|row| !row.contains("| not run |")).count();
    let number = format!("{run} of {} are recorded as run", rows.len());
    assert!(HARNESSES.contains(&number), "proofs/HARNESSES.md does not say: {number}");
    for (row, said) in rows.iter().zip(&said) {
        assert!(row.starts_with(said), "scripts/mutants monitor: {said}");
        let found = row.split('|').skip(3).take(3).any(|cell| !cell.trim().is_empty());
        assert!(found, "it survives: {row}");
    }
}

/// Its item is there, and `from` stands in it once.
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
