//! Every vector tells the implementation from at least one mutant of it, or says why it stays.
//!
//! A mutant is the implementation with its input or its answer changed on the way, as a program
//! would behave that forgot a rule, read a threshold otherwise, or took a field for another.

mod cycles;
mod others;
mod sequences;

use mufasa_conform::vectors::book::{STAYS, Vector};
use mufasa_model::cycle::check;
use mufasa_model::report::{Outcome, Reading, Report, Rule, Witness};
use mufasa_props::bridge::{self, Answer};
use mufasa_records::Record;

use crate::vectors::{all, record};

/// Whether a mutant's answer to a cycle is told from a right one: by verdict, failed stage or
/// place of invalid input; where strict and exact model agree in all of them, by an outcome or a
/// witness, too.
fn told_apart(exact: &Answer, strict: &Answer, mutant: &Answer) -> bool {
    if bridge::conforms(exact, strict, mutant).is_err() {
        return true;
    }
    match (exact, strict, mutant) {
        (Ok(exact), Ok(strict), Ok(mutant)) => {
            let places = |report: &Report| report.stages.each_ref().map(place);
            // An implementation may name the work where the exact model, which has no limit, names
            // what it found.
            let names_work = mutant.stages.iter().any(|outcome| {
                matches!(outcome, Outcome::Failed(witness) if witness.rule == Rule::WorkLimit)
            });
            places(exact) == places(strict) && places(exact) != places(mutant) && !names_work
        }
        _ => false,
    }
}

/// An outcome without the numbers that were compared.
fn place(outcome: &Outcome) -> Outcome {
    match outcome {
        Outcome::Failed(witness) => {
            Outcome::Failed(Witness { segment: None, compared: [0.0; 2], ..witness.clone() })
        }
        other => other.clone(),
    }
}

/// The names of the mutants that a vector tells apart.
fn killed(vector: &Vector) -> Vec<&'static str> {
    match record(vector) {
        Some(Record::Cycle { cycle, .. }) => {
            let [exact, strict] =
                [Reading::Exact, Reading::Strict].map(|reading| check(&cycle, reading));
            let itself = told_apart(&exact, &strict, &bridge::check_impl(&cycle));
            assert!(!itself, "{}: tells the implementation itself apart", vector.id);
            let mutants = cycles::MUTANTS
                .iter()
                .filter(|(_, mutant)| told_apart(&exact, &strict, &mutant(&cycle)));
            mutants.map(|(name, _)| *name).collect()
        }
        Some(Record::Offloading { trace, .. }) => others::of_trace(&trace),
        Some(Record::Composition { task, .. }) => others::of_task(&task),
        Some(Record::Monitor { sequence, .. }) => sequences::of_sequence(&sequence),
        None => others::of_line(vector.input.text()),
    }
}

#[test]
fn every_vector_kills_a_mutant_or_says_why_it_stays() {
    let (mut survived, mut stay) = (Vec::new(), 0);
    let mut useful = std::collections::BTreeMap::<&str, u32>::new();
    for vector in all() {
        let killed = killed(vector);
        for name in &killed {
            *useful.entry(name).or_default() += 1;
        }
        if killed.is_empty() && vector.note.contains(STAYS) {
            stay += 1;
        } else if killed.is_empty() {
            survived.push(format!("{}: {}", vector.id, vector.note));
        }
    }
    println!("{stay} of {} vectors stay though they tell no mutant apart", all().count());
    for (name, count) in &useful {
        println!("{count:5} vectors tell apart: {name}");
    }
    for name in cycles::MUTANTS
        .iter()
        .map(|(name, _)| *name)
        .chain(others::names())
        .chain(sequences::names())
    {
        assert!(useful.contains_key(name), "no vector tells apart: {name}");
    }
    assert!(survived.is_empty(), "{} vectors do nothing: {survived:#?}", survived.len());
}
