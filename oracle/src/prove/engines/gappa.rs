//! Gappa on the rounding errors of the distances.

use std::io;

use indicatif::ProgressBar;
use mufasa_theorems::gappa::{self, Bound};
use mufasa_theorems::prove::Decision as Found;

use super::theorems;
use crate::prove::line::{Answer, Line};

const ENGINE: &str = "gappa";

pub(super) fn claims() -> Vec<Line> {
    let claim = |bound: &Bound| {
        let parts = [bound.id, bound.statement, bound.domain];
        Line::new(parts, Answer::not_run(ENGINE, "no Gappa here"))
    };
    gappa::BOUNDS.iter().map(claim).collect()
}

pub(super) fn judge(claims: Vec<Line>, bar: &ProgressBar) -> io::Result<Vec<Line>> {
    if gappa::version().is_none() {
        return Ok(claims);
    }
    let judged = |line: Line| {
        bar.inc(1);
        let Some(bound) = gappa::BOUNDS.iter().find(|bound| bound.id == line.id) else {
            return Ok(line);
        };
        let (found, time) = bound.judge()?;
        let reason =
            (found != Found::Proved).then(|| String::from("no proof, or one of less, too"));
        let answer = Answer::given(ENGINE, theorems::status(&found), time.as_secs_f64());
        Ok(line.answered(vec![Answer { reason, ..answer }]))
    };
    claims.into_iter().map(judged).collect()
}
