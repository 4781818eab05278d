//! The laws of the implementation over complete finite domains.

use std::collections::BTreeMap;
use std::io;
use std::time::Instant;

use indicatif::ProgressBar;
use mufasa_proofs::exhaust::{Run, TOPICS};
use serde::Deserialize;

use crate::prove::claim::{Claim, EngineAnswer, Status};

/// Every value of a finite domain is run.
pub(super) const ENGINE: &str = "exhaustion";
const LAWS: &str = include_str!("../../../../../proofs/laws.toml");

#[derive(Deserialize)]
struct List {
    law: Vec<Law>,
}

#[derive(Deserialize)]
struct Law {
    id: String,
    statement: String,
}

pub(super) fn claims() -> io::Result<Vec<Claim>> {
    let list: List = toml::from_str(LAWS).map_err(io::Error::other)?;
    let claim = |law: Law| {
        let topic = TOPICS.iter().find(|topic| law.id.starts_with(topic.name));
        let domain = topic.map_or("", |topic| topic.domain);
        let id = format!("law::{}", law.id);
        let parts = [id.as_str(), &law.statement, domain];
        Claim::new(parts, EngineAnswer::not_run(ENGINE, ""))
    };
    Ok(list.law.into_iter().map(claim).collect())
}

pub(super) fn judge(claims: Vec<Claim>, bar: &ProgressBar) -> Vec<Claim> {
    let mut answers: BTreeMap<String, EngineAnswer> = BTreeMap::new();
    for topic in TOPICS {
        let id = |law: &str| format!("law::{}::{law}", topic.name);
        if !topic.laws().any(|law| claims.iter().any(|line| line.id == id(law))) {
            continue;
        }
        bar.set_message(topic.name);
        let start = Instant::now();
        let run = topic.run();
        let count = u32::try_from(topic.laws().count().max(1)).unwrap_or(u32::MAX);
        let seconds = (start.elapsed() / count).as_secs_f64();
        for law in topic.laws() {
            answers.insert(id(law), answer(&run, law, seconds));
            bar.inc(1);
        }
    }
    let judged = |line: Claim| {
        let answer = answers.remove(&line.id);
        line.answered(answer.into_iter().collect())
    };
    claims.into_iter().map(judged).collect()
}

fn answer(run: &Result<Run, String>, law: &str, seconds: f64) -> EngineAnswer {
    let (status, reason, ran) = match run {
        Err(panic) => (Status::Unknown, Some(format!("the run ended: {panic}")), None),
        Ok(run) => {
            let (status, reason) = match run.laws.get(law) {
                Some(Some(case)) => (Status::Refuted, Some(format!("by {case}"))),
                Some(None) if run.missed().is_empty() => (Status::Proved, None),
                Some(None) => {
                    let missed = format!("never reached: {}", run.missed().join(", "));
                    (Status::Unknown, Some(missed))
                }
                None => (Status::Unknown, Some(String::from("not asked"))),
            };
            (status, reason, Some(format!("{} cases", run.cases)))
        }
    };
    EngineAnswer { ran, reason, ..EngineAnswer::given(ENGINE, status, seconds) }
}
