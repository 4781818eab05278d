//! What z3 decides of the theorems over the reals.

use std::io;

use indicatif::ProgressBar;
use mufasa_theorems::claim::{Decision as Found, Judgement, Theorem};
use mufasa_theorems::{prove as solve, solver, theorem};
use rayon::prelude::*;

use crate::prove::claim::{Claim, EngineAnswer, Status};

const Z3: &str = "z3";
/// Where it comes from.
pub(super) const PACKAGE: &str = "Debian's package z3, 4.8 or newer";

pub(super) fn theorems() -> Vec<Claim> {
    let claim = |theorem: &Theorem| {
        let parts = [theorem.id, theorem.statement, theorem.domain];
        let refuted_variant = Some(theorem.wrong.statement.to_owned());
        let answer = EngineAnswer::not_run(Z3, "no z3 4.8 or newer");
        Claim { refuted_variant, ..Claim::new(parts, answer) }
    };
    theorem::all().map(claim).collect()
}

/// Whether z3 is here.
pub(super) fn is_here() -> bool {
    solver::is_new_enough()
}

/// Judges each claim of these, if z3 is here. Errors are those of talking to it.
pub(super) fn judge(claims: Vec<Claim>, bar: &ProgressBar) -> io::Result<Vec<Claim>> {
    if !is_here() {
        return Ok(claims);
    }
    let judged = |line: Claim| {
        bar.set_message(line.id.clone());
        let theorem = theorem::all().find(|theorem| theorem.id == line.id);
        let judgement = theorem.map(solve::judge).transpose()?;
        let drive = judgement.as_ref().and_then(Judgement::drive);
        let answer = judgement.as_ref().map(answer);
        bar.inc(1);
        Ok(Claim { drive, ..line.answered(answer.into_iter().collect()) })
    };
    claims.into_par_iter().with_max_len(1).map(judged).collect()
}

fn answer(judgement: &Judgement) -> EngineAnswer {
    let ran = Some(match judgement.paths {
        1 => String::from("1 path"),
        paths => format!("{paths} paths"),
    });
    let reason = reason(&judgement.claim, &judgement.control);
    let seconds = judgement.time.as_secs_f64();
    EngineAnswer { ran, reason, ..EngineAnswer::given(Z3, status(judgement.decision()), seconds) }
}

/// Why a claim is not proved, by what is found of it and of its wrong variant.
fn reason(claim: &Found, control: &Found) -> Option<String> {
    match (claim, control) {
        (Found::Refuted(values), _) => Some(format!("by {}", in_words(values))),
        (Found::Unknown, _) => Some(String::from("no answer in time")),
        (Found::Proved, Found::Refuted(_)) => None,
        (Found::Proved, _) => Some(String::from("its wrong variant was not refuted")),
    }
}

fn status(found: &Found) -> Status {
    match found {
        Found::Proved => Status::Proved,
        Found::Refuted(_) => Status::Refuted,
        Found::Unknown => Status::Unknown,
    }
}

fn in_words(values: &[(String, f64)]) -> String {
    let words: Vec<String> =
        values.iter().map(|(name, value)| format!("{name} = {value}")).collect();
    words.join(", ")
}
