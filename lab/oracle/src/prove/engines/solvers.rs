//! What solvers decide: z3 of the theorems over the reals, Gappa of the rounding errors of the distances,
//! bitwuzla of their ranges in doubles.

use std::io;

use indicatif::ProgressBar;
use mufasa_theorems::claim::{Decision as Found, Judgement, Theorem};
use mufasa_theorems::doubles::{self, Range};
use mufasa_theorems::gappa::{self, Bound};
use mufasa_theorems::{prove as solve, solver, theorem};
use rayon::prelude::*;

use super::ClaimSource;
use crate::prove::claim::{Claim, EngineAnswer, Status};

const Z3: &str = "z3";
const GAPPA: &str = "gappa";
const BITWUZLA: &str = "bitwuzla";

pub(super) fn theorems() -> Vec<Claim> {
    let claim = |theorem: &Theorem| {
        let parts = [theorem.id, theorem.statement, theorem.domain];
        let wrong = Some(theorem.wrong.statement);
        not_run(parts, wrong, EngineAnswer::not_run(Z3, "no z3 4.8 or newer"))
    };
    theorem::all().map(claim).collect()
}

pub(super) fn bounds() -> Vec<Claim> {
    let claim = |bound: &Bound| {
        let parts = [bound.id, bound.statement, bound.domain];
        not_run(parts, None, EngineAnswer::not_run(GAPPA, "no Gappa here"))
    };
    gappa::BOUNDS.iter().map(claim).collect()
}

pub(super) fn ranges() -> Vec<Claim> {
    let claim = |range: &Range| {
        let parts = [range.id, range.statement, doubles::DOMAIN];
        let wrong = Some(range.wrong.statement);
        not_run(parts, wrong, EngineAnswer::not_run(BITWUZLA, "no bitwuzla here"))
    };
    doubles::RANGES.iter().map(claim).collect()
}

fn not_run(parts: [&str; 3], wrong: Option<&str>, answer: EngineAnswer) -> Claim {
    Claim { refuted_variant: wrong.map(str::to_owned), ..Claim::new(parts, answer) }
}

/// Whether the solver of these claims is here.
pub(super) fn is_here(source: ClaimSource) -> bool {
    match source {
        ClaimSource::Theorems => solver::is_new_enough(),
        ClaimSource::Gappa => gappa::version().is_some(),
        _ => doubles::version().is_some(),
    }
}

/// Where it comes from.
pub(super) const fn package(source: ClaimSource) -> &'static str {
    match source {
        ClaimSource::Theorems => "Debian's package z3, 4.8 or newer",
        ClaimSource::Gappa => "Debian's package gappa",
        _ => "python3 -m pip install bitwuzla==0.9.1",
    }
}

/// Judges each claim of these, if their solver is here. Errors are those of talking to it.
pub(super) fn judge(
    source: ClaimSource,
    claims: Vec<Claim>,
    bar: &ProgressBar,
) -> io::Result<Vec<Claim>> {
    if !is_here(source) {
        return Ok(claims);
    }
    let judged = |line: Claim| {
        bar.set_message(line.id.clone());
        let answer = answer(&line.id)?;
        bar.inc(1);
        Ok(line.answered(answer.into_iter().collect()))
    };
    claims.into_par_iter().with_max_len(1).map(judged).collect()
}

fn answer(id: &str) -> io::Result<Option<EngineAnswer>> {
    if let Some(theorem) = theorem::all().find(|theorem| theorem.id == id) {
        let judgement = solve::judge(theorem)?;
        let ran = Some(match judgement.paths {
            1 => String::from("1 path"),
            paths => format!("{paths} paths"),
        });
        return Ok(Some(EngineAnswer { ran, ..judged(Z3, &judgement) }));
    }
    if let Some(range) = doubles::RANGES.iter().find(|range| range.id == id) {
        return Ok(Some(judged(BITWUZLA, &range.judge()?)));
    }
    let Some(bound) = gappa::BOUNDS.iter().find(|bound| bound.id == id) else { return Ok(None) };
    let (found, time) = bound.judge()?;
    let reason = (found != Found::Proved).then(|| String::from("no proof, or one of less, too"));
    let answer = EngineAnswer::given(GAPPA, status(&found), time.as_secs_f64());
    Ok(Some(EngineAnswer { reason, ..answer }))
}

fn judged(engine: &'static str, judgement: &Judgement) -> EngineAnswer {
    let reason = reason(&judgement.claim, &judgement.control);
    let seconds = judgement.time.as_secs_f64();
    EngineAnswer { reason, ..EngineAnswer::given(engine, status(judgement.decision()), seconds) }
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
