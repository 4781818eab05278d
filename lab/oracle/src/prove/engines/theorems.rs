//! z3 on the theorems over the reals.

use std::io;

use indicatif::ProgressBar;
use mufasa_theorems::prove::{self as solve, Decision as Found, Judgement};
use mufasa_theorems::theorem::{self, Theorem};

use crate::prove::claim::{Claim, EngineAnswer, Status};

const ENGINE: &str = "z3";

pub(super) fn claims() -> Vec<Claim> {
    let claim = |theorem: &Theorem| {
        let parts = [theorem.id, theorem.statement, theorem.domain];
        Claim {
            refuted_variant: Some(theorem.wrong.statement.to_owned()),
            ..Claim::new(parts, EngineAnswer::not_run(ENGINE, "no z3 4.8 or newer"))
        }
    };
    theorem::all().map(claim).collect()
}

pub(super) fn judge(claims: Vec<Claim>, bar: &ProgressBar) -> io::Result<Vec<Claim>> {
    if !mufasa_z3::is_new_enough() {
        return Ok(claims);
    }
    // One after the other: the paths of each are on all cores.
    let judged = |line: Claim| {
        bar.set_message(line.id.clone());
        let theorem = theorem::all().find(|theorem| theorem.id == line.id);
        let found = theorem.map(solve::judge).transpose()?;
        bar.inc(1);
        Ok(line.answered(found.iter().map(answer).collect()))
    };
    claims.into_iter().map(judged).collect()
}

fn answer(judgement: &Judgement) -> EngineAnswer {
    let reason = reason(&judgement.claim, &judgement.control);
    let seconds = judgement.time.as_secs_f64();
    let ran = Some(match judgement.paths {
        1 => String::from("1 path"),
        paths => format!("{paths} paths"),
    });
    EngineAnswer {
        ran,
        reason,
        ..EngineAnswer::given(ENGINE, status(judgement.decision()), seconds)
    }
}

/// Why a claim is not proved, by what is found of it and of its wrong variant.
pub(super) fn reason(claim: &Found, control: &Found) -> Option<String> {
    match (claim, control) {
        (Found::Refuted(values), _) => Some(format!("by {}", in_words(values))),
        (Found::Unknown, _) => Some(String::from("no answer in time")),
        (Found::Proved, Found::Refuted(_)) => None,
        (Found::Proved, _) => Some(String::from("its wrong variant was not refuted")),
    }
}

pub(super) fn status(found: &Found) -> Status {
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
