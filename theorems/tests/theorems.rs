//! Every theorem is proved and its wrong variant refuted, where z3 is there; the mutants still fit
//! the source.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use mufasa_theorems::gappa;
use mufasa_theorems::prove::{Verdict, judge};
use mufasa_theorems::solver;
use mufasa_theorems::theorem;

#[test]
fn every_theorem_is_proved_and_its_wrong_variant_refuted() {
    if !solver::is_new_enough() {
        println!("NOT RUN: no z3 4.8 here");
        return;
    }
    for theorem in theorem::all() {
        let judgement = judge(theorem).expect("z3 answers");
        println!("{}: {} paths", theorem.id, judgement.proof.paths);
        assert_eq!(*judgement.verdict(), Verdict::Proved, "{}: {judgement:?}", theorem.id);
    }
}

#[test]
fn every_bound_is_proved_and_a_smaller_one_is_not() {
    let Some(version) = gappa::version() else {
        println!("NOT RUN: no Gappa here");
        return;
    };
    println!("{version}");
    for bound in &gappa::BOUNDS {
        let (verdict, time) = bound.judge().expect("Gappa runs");
        println!("{}: {time:.1?}", bound.id);
        assert_eq!(verdict, Verdict::Proved, "{}", bound.id);
    }
}

#[test]
fn every_mutant_fits_one_place_of_its_file() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    for theorem in theorem::all() {
        let mutant = &theorem.mutant;
        let text = fs::read_to_string(root.join(mutant.file)).expect(mutant.file);
        assert_eq!(text.matches(mutant.from).count(), 1, "{}: {mutant:?}", theorem.id);
        assert_ne!(mutant.from, mutant.to, "{}", theorem.id);
    }
}

#[test]
fn ids_are_unique() {
    let ids: BTreeSet<&str> = theorem::all().map(|theorem| theorem.id).collect();
    assert_eq!(ids.len(), theorem::all().count());
}
