//! Proves a claim on every path of its execution.

use std::io;
use std::time::Instant;

use crate::solver::{Effort, Satisfiability, Solver, number};

use crate::claim::{Decision, Judgement, Proof, Theorem};
use crate::numbers::real::formula::{Formula, not};
use crate::numbers::real::path;

/// For the claim on one path.
const CLAIM: Effort = Effort { steps: 100_000_000, limit_ms: 60_000 };

/// Proves a theorem and refutes its wrong variant. Errors are those of talking to the solver.
pub fn judge(theorem: &Theorem) -> io::Result<Judgement> {
    let start = Instant::now();
    let Proof { decision: claim, paths } = prove_claim(&theorem.claim)?;
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
