//! Whether a compiled harness can fail, and whether its covers and its end can be reached.

use std::collections::{BTreeMap, HashMap};

use crate::machine::{Machine, Place};
use crate::module::Module;
use crate::smt::{self, Possible};
use crate::term::Term;

/// What was found about one harness.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Found {
    /// What can be said of its assertions.
    pub trap: Trap,
    /// Covers, and 0 for the end, that some input reaches; a run with that input has been seen.
    pub reached: Vec<u32>,
    /// Terms of the graph.
    pub terms: usize,
    /// Instructions run.
    pub steps: u64,
    /// Questions to z3.
    pub questions: u64,
}

/// Whether an input makes it trap.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Trap {
    /// None does.
    Never,
    /// One does, here, as a run with that input has shown.
    At(String),
    /// Why nothing can be said.
    Unknown(String),
}

/// The end of a harness among covers; no name hashes to it.
pub const END: u32 = 0;

/// Runs the exported harness and asks z3, at most `limit_ms` for each question.
pub fn prove_export(module: &Module<'_>, export: &str, limit_ms: u32) -> Result<Found, String> {
    let mut machine = Machine::new(module);
    let end = machine.run(export)?;
    let mut goals = machine.covers.clone();
    goals.insert(END, end);
    let never = machine.terms.truth(false);
    let traps: Vec<Term> = machine.traps.iter().map(|(condition, _)| *condition).collect();
    let any_trap = traps.iter().fold(never, |any, trap| machine.terms.or(any, *trap));

    let mut questions = machine.questions;
    let mut ask = |truth: Term| {
        questions += 1;
        smt::ask(&machine.terms, truth, limit_ms).map_err(|error| error.to_string())
    };
    let trap = match ask(any_trap)? {
        Possible::Never => Trap::Never,
        Possible::Unknown => Trap::Unknown(format!("z3 had not ended after {limit_ms} ms")),
        Possible::With(values) => {
            let (again, _) = replay(module, export, &machine.draws, &values)?;
            let Some((_, place)) = again.traps.first() else {
                return Err("a counterexample that is none: the machine is wrong".to_owned());
            };
            Trap::At(place.clone())
        }
    };
    let mut reached = Vec::new();
    for (cover, condition) in &goals {
        let Possible::With(values) = ask(*condition)? else { continue };
        let (again, ended) = replay(module, export, &machine.draws, &values)?;
        let seen = if *cover == END { Some(&ended) } else { again.covers.get(cover) };
        if seen.and_then(|truth| again.terms.number(*truth)) != Some(1) {
            return Err("an input that reaches nothing: the machine is wrong".to_owned());
        }
        reached.push(*cover);
    }
    Ok(Found { trap, reached, terms: machine.terms.len(), steps: machine.steps, questions })
}

/// The run with these numbers of the variables, in which every term is a number.
fn replay<'a>(
    module: &'a Module<'a>,
    export: &str,
    draws: &BTreeMap<Place, u32>,
    values: &[(u32, u64)],
) -> Result<(Machine<'a>, Term), String> {
    let values: HashMap<u32, u64> = values.iter().copied().collect();
    let value = |number: &u32| values.get(number).copied().unwrap_or(0);
    let given = draws.iter().map(|(place, number)| (place.clone(), value(number))).collect();
    let mut machine = Machine::new(module);
    machine.given = Some(given);
    let ended = machine.run(export)?;
    Ok((machine, ended))
}
