//! bitwuzla on the distances in doubles.

use std::io;

use indicatif::ProgressBar;
use mufasa_theorems::doubles::{self, Range};
use mufasa_theorems::prove::Judgement;

use super::theorems;
use crate::prove::claim::{Claim, EngineAnswer};

const ENGINE: &str = "bitwuzla";

pub(super) fn claims() -> Vec<Claim> {
    let claim = |range: &Range| {
        let parts = [range.id, range.statement, doubles::DOMAIN];
        Claim {
            refuted_variant: Some(range.wrong.statement.to_owned()),
            ..Claim::new(parts, EngineAnswer::not_run(ENGINE, "no bitwuzla here"))
        }
    };
    doubles::RANGES.iter().map(claim).collect()
}

pub(super) fn judge(claims: Vec<Claim>, bar: &ProgressBar) -> io::Result<Vec<Claim>> {
    if doubles::version().is_none() {
        return Ok(claims);
    }
    let judged = |line: Claim| {
        bar.inc(1);
        bar.set_message(line.id.clone());
        let Some(range) = doubles::RANGES.iter().find(|range| range.id == line.id) else {
            return Ok(line);
        };
        let judgement = range.judge()?;
        Ok(line.answered(vec![answer(&judgement)]))
    };
    claims.into_iter().map(judged).collect()
}

fn answer(judgement: &Judgement) -> EngineAnswer {
    let reason = theorems::reason(&judgement.claim, &judgement.control);
    let status = theorems::status(judgement.decision());
    EngineAnswer { reason, ..EngineAnswer::given(ENGINE, status, judgement.time.as_secs_f64()) }
}
