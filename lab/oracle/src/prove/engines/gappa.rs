//! Gappa on the rounding errors of the distances.

use std::io;

use indicatif::ProgressBar;
use mufasa_theorems::gappa::{self, Bound};
use mufasa_theorems::prove::Decision as Found;

use super::theorems;
use crate::prove::claim::{Claim, EngineAnswer};

const ENGINE: &str = "gappa";

pub(super) fn claims() -> Vec<Claim> {
    let claim = |bound: &Bound| {
        let parts = [bound.id, bound.statement, bound.domain];
        Claim::new(parts, EngineAnswer::not_run(ENGINE, "no Gappa here"))
    };
    gappa::BOUNDS.iter().map(claim).collect()
}

pub(super) fn judge(claims: Vec<Claim>, bar: &ProgressBar) -> io::Result<Vec<Claim>> {
    if gappa::version().is_none() {
        return Ok(claims);
    }
    let judged = |line: Claim| {
        bar.inc(1);
        let Some(bound) = gappa::BOUNDS.iter().find(|bound| bound.id == line.id) else {
            return Ok(line);
        };
        let (found, time) = bound.judge()?;
        let reason =
            (found != Found::Proved).then(|| String::from("no proof, or one of less, too"));
        let answer = EngineAnswer::given(ENGINE, theorems::status(&found), time.as_secs_f64());
        Ok(line.answered(vec![EngineAnswer { reason, ..answer }]))
    };
    claims.into_iter().map(judged).collect()
}
