//! Proves a claim on every path of its execution.

mod side_by_side;

use std::io;
use std::time::{Duration, Instant};

use mufasa_z3::{Effort, Satisfiability, Solver, number};

use crate::numbers::real::formula::{Formula, not};
use crate::numbers::real::path;
use crate::theorem::Theorem;

/// For the claim on one path.
const CLAIM: Effort = Effort { steps: 100_000_000, limit_ms: 60_000 };

/// What a solver decides of a claim.
#[derive(Clone, Debug, PartialEq)]
pub enum Decision {
    /// True of all numbers of its domain.
    Proved,
    /// False of these.
    Refuted(Vec<(String, f64)>),
    /// The solver does not know, or took too long.
    Unknown,
}

/// A proof or its failure.
#[derive(Clone, Debug)]
pub struct Proof {
    /// How it ended.
    pub decision: Decision,
    /// Paths executed.
    pub paths: usize,
}

/// A claim judged.
#[derive(Clone, Debug)]
pub struct Judgement {
    /// Of the claim.
    pub claim: Decision,
    /// Of its wrong variant, which must be refuted.
    pub control: Decision,
    /// Paths of the claim executed, of which ranges of doubles have one.
    pub paths: usize,
    /// Time taken.
    pub time: Duration,
}

impl Judgement {
    /// Of the claim; not known when the wrong variant is not refuted, because then the claim may
    /// be one of nothing.
    pub fn decision(&self) -> &Decision {
        match (&self.claim, &self.control) {
            (Decision::Proved, Decision::Proved | Decision::Unknown) => &Decision::Unknown,
            (decision, _) => decision,
        }
    }
}

/// Proves a theorem and refutes its wrong variant. Errors are those of talking to the solver.
pub fn judge(theorem: &Theorem) -> io::Result<Judgement> {
    let start = Instant::now();
    let Proof { decision: claim, paths } = side_by_side::prove(theorem.claim)?;
    let control = prove_claim(&theorem.wrong.claim)?.decision;
    Ok(Judgement { claim, control, paths, time: start.elapsed() })
}

/// Runs `claim` on every path that its comparisons take, and asks the solver for a
/// counterexample on each, up to the first path where there is one. Errors are those of talking to
/// the solver.
pub fn prove_claim(claim: &dyn Fn() -> Formula) -> io::Result<Proof> {
    path::exchange_solver(Some(Solver::start()?));
    path::first();
    let (mut decision, mut paths) = (Decision::Proved, 0);
    loop {
        paths += 1;
        match on_this_path(claim) {
            Decision::Proved => {}
            Decision::Unknown => decision = Decision::Unknown,
            refuted @ Decision::Refuted(_) => {
                decision = refuted;
                break;
            }
        }
        if !path::next() {
            break;
        }
    }
    let solver = path::exchange_solver(None);
    path::first();
    match solver.and_then(|mut solver| solver.error.take()) {
        Some(error) => Err(error),
        None => Ok(Proof { decision, paths }),
    }
}

fn on_this_path(claim: &dyn Fn() -> Formula) -> Decision {
    let claim = claim();
    if let Formula::Known(true) = claim {
        return Decision::Proved;
    }
    let assertion = path::with(|path| not(claim).text(path));
    match path::ask(&assertion, CLAIM) {
        Satisfiability::Unsat => Decision::Proved,
        Satisfiability::Sat(values) => {
            let names = path::with(|path| path.names.clone());
            let values = values.iter().map(|value| number(value));
            Decision::Refuted(names.into_iter().zip(values).collect())
        }
        Satisfiability::Unknown => Decision::Unknown,
    }
}
