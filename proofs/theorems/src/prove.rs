//! Proves a claim on every path of its execution.

use std::io;
use std::time::{Duration, Instant};

use mufasa_z3::{Answer, Effort, Solver, number};

use crate::numbers::real::formula::{Formula, not};
use crate::numbers::real::path;
use crate::theorem::Theorem;

/// For the claim on one path.
const CLAIM: Effort = Effort { steps: 100_000_000, limit_ms: 60_000 };

/// How a proof ended.
#[derive(Clone, Debug, PartialEq)]
pub enum Verdict {
    /// True of all real numbers on every path.
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
    pub verdict: Verdict,
    /// Paths executed.
    pub paths: usize,
    /// Questions to the solver.
    pub questions: usize,
    /// Time taken.
    pub time: Duration,
}

/// A theorem judged.
#[derive(Clone, Debug)]
pub struct Judgement {
    /// Of its claim.
    pub proof: Proof,
    /// Of its wrong variant, which must be refuted.
    pub control: Proof,
}

impl Judgement {
    /// The claim's verdict; not known when the wrong variant is not refuted, because then the
    /// claim may be one of nothing.
    pub fn verdict(&self) -> &Verdict {
        match (&self.proof.verdict, &self.control.verdict) {
            (Verdict::Proved, Verdict::Proved | Verdict::Unknown) => &Verdict::Unknown,
            (verdict, _) => verdict,
        }
    }
}

/// Proves a theorem and refutes its wrong variant. Errors are those of talking to the solver.
pub fn judge(theorem: &Theorem) -> io::Result<Judgement> {
    let proof = prove(&theorem.claim)?;
    Ok(Judgement { proof, control: prove(&theorem.wrong.claim)? })
}

/// Runs `claim` on every path that its comparisons take, and asks the solver for a
/// counterexample on each, up to the first path where there is one. Errors are those of talking to
/// the solver.
pub fn prove(claim: &dyn Fn() -> Formula) -> io::Result<Proof> {
    let start = Instant::now();
    path::exchange_solver(Some(Solver::start()?));
    path::first();
    let (mut verdict, mut paths) = (Verdict::Proved, 0);
    loop {
        paths += 1;
        match on_this_path(claim) {
            Verdict::Proved => {}
            Verdict::Unknown => verdict = Verdict::Unknown,
            refuted @ Verdict::Refuted(_) => {
                verdict = refuted;
                break;
            }
        }
        if !path::next() {
            break;
        }
    }
    let solver = path::exchange_solver(None);
    path::first();
    let questions = solver.as_ref().map_or(0, |solver| solver.questions);
    match solver.and_then(|mut solver| solver.error.take()) {
        Some(error) => Err(error),
        None => Ok(Proof { verdict, paths, questions, time: start.elapsed() }),
    }
}

fn on_this_path(claim: &dyn Fn() -> Formula) -> Verdict {
    let claim = claim();
    if let Formula::Known(true) = claim {
        return Verdict::Proved;
    }
    let assertion = path::with(|path| not(claim).text(path));
    match path::ask(&assertion, CLAIM) {
        Answer::Unsat => Verdict::Proved,
        Answer::Sat(values) => {
            let names = path::with(|path| path.names.clone());
            let values = values.iter().map(|value| number(value));
            Verdict::Refuted(names.into_iter().zip(values).collect())
        }
        Answer::Unknown => Verdict::Unknown,
    }
}
