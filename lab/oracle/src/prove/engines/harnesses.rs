//! The harnesses: what CBMC said of them compiled, and what the stand-in for Kani sees now.
//! Kani itself is not run.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::io::{self, ErrorKind};
use std::time::Instant;

use indicatif::ProgressBar;
use mufasa_proofs::harness::ALL;
use mufasa_proofs::kani::{Evidence as Found, Run, judge_harness as run};
use rayon::prelude::*;
use serde::Deserialize;

use crate::prove::claim::{Claim, EngineAnswer, Status};
use crate::prove::settings::Settings;
use crate::prove::sources;

/// Every value of a finite domain is run.
const EXHAUSTION: &str = "exhaustion";
/// Some values of an infinite domain are run, which is testing.
const SAMPLING: &str = "sampling";
/// Who judged the compiled code, by the name that `scripts/prove-wasm` writes.
pub(super) const COMPILED: &str = "cbmc-wasm";
/// Where it comes from.
pub(super) const PACKAGE: &str =
    "scripts/install-provers (Debian's rustc, wabt, cbmc, kissat), then scripts/prove-wasm";

const EXPECTED: &str = include_str!("../../../../../proofs/expected.toml");

#[derive(Deserialize)]
struct Expected {
    harness: Vec<Harness>,
}

#[derive(Deserialize)]
struct Harness {
    id: String,
    statement: String,
    domain: String,
    not_covered: String,
    covers: BTreeSet<String>,
    stand_in: String,
    cbmc: String,
}

/// A line of what `scripts/prove-wasm` wrote.
#[derive(Deserialize)]
struct Compiled {
    id: String,
    engine: String,
    verdict: Status,
    seconds: Option<f64>,
    reason: Option<String>,
    /// `sources::hash` of what was compiled.
    #[serde(default)]
    sources: String,
}

pub(super) fn claims() -> io::Result<Vec<Claim>> {
    let claim = |one: &Harness| {
        let domain = format!("{} Not covered: {}", one.domain, one.not_covered);
        let parts = [one.id.as_str(), &one.statement, &domain];
        Claim::new(parts, EngineAnswer::not_run(one.engine(), ""))
    };
    Ok(expected()?.iter().map(claim).collect())
}

fn expected() -> io::Result<Vec<Harness>> {
    let expected: Expected = toml::from_str(EXPECTED).map_err(io::Error::other)?;
    Ok(expected.harness)
}

impl Harness {
    fn engine(&self) -> &'static str {
        if self.stand_in == "every" { EXHAUSTION } else { SAMPLING }
    }
}

pub(super) fn judge(
    claims: Vec<Claim>,
    settings: &Settings,
    bar: &ProgressBar,
) -> io::Result<Vec<Claim>> {
    let expected = expected()?;
    let mut compiled = compiled(settings)?;
    let seen = claims.par_iter().with_max_len(1).map(|line| {
        let one = expected.iter().find(|one| one.id == line.id);
        let seen = one.map(stand_in);
        bar.inc(1);
        bar.set_message(line.id.clone());
        seen
    });
    let seen: Vec<_> = seen.collect();
    let lines = claims.into_iter().zip(seen).map(|(line, seen)| {
        let missing = || EngineAnswer::not_run(COMPILED, "scripts/prove-wasm did not run it");
        let compiled = compiled.remove(&line.id).unwrap_or_else(missing);
        // Of two proofs that of the compiled code counts: it is first.
        line.answered([compiled].into_iter().chain(seen).collect())
    });
    Ok(lines.collect())
}

/// How many of these claims nothing but CBMC proves, which did not run on these sources.
pub(super) fn not_compiled(claims: &[Claim], settings: &Settings) -> io::Result<usize> {
    let (expected, compiled) = (expected()?, compiled(settings)?);
    let is_run = |id: &str| compiled.get(id).is_some_and(|answer| answer.status != Status::NotRun);
    let is_left = |one: &&Harness| {
        let alone = one.cbmc != "no" && one.engine() == SAMPLING;
        alone && !is_run(&one.id) && claims.iter().any(|line| line.id == one.id)
    };
    Ok(expected.iter().filter(is_left).count())
}

/// What the stand-in sees. What it was not expected to see, such as a domain that is not finite any
/// more, is not known.
fn stand_in(one: &Harness) -> EngineAnswer {
    let covers: BTreeSet<&str> = one.covers.iter().map(String::as_str).collect();
    let Some((_, harness)) = ALL.iter().find(|(id, _)| *id == one.id) else {
        return EngineAnswer::not_run(one.engine(), "there is no such harness");
    };
    let start = Instant::now();
    let found = run(*harness, &covers);
    let ran = |run: &Run| {
        let (held, tried) = (run.held, run.tried);
        let few = held < tried;
        let of = if few { format!(" of {tried}") } else { String::new() };
        let kind = if run.exhaustive { "cases" } else { "random cases" };
        let domain = if few { " in the domain" } else { "" };
        format!("{held}{of} {kind}{domain}")
    };
    let (status, ran, reason) = match found {
        Found::Every(run) if one.engine() == EXHAUSTION => (Status::Proved, Some(ran(&run)), None),
        Found::Some(run) if one.engine() == SAMPLING => (Status::Tested, Some(ran(&run)), None),
        Found::Every(run) | Found::Some(run) => {
            let reason = Some(format!("expected.toml says {}", one.stand_in));
            (Status::Unknown, Some(ran(&run)), reason)
        }
        Found::Vacuous(reason) => (Status::Unknown, None, Some(reason)),
        Found::Refuted(reason) => (Status::Refuted, None, Some(reason)),
    };
    let seconds = start.elapsed().as_secs_f64();
    EngineAnswer { ran, reason, ..EngineAnswer::given(one.engine(), status, seconds) }
}

/// What was said of the compiled sources that are here, by harness.
fn compiled(settings: &Settings) -> io::Result<BTreeMap<String, EngineAnswer>> {
    let text = match fs::read_to_string(&settings.cbmc) {
        Ok(text) => text,
        Err(error) if error.kind() == ErrorKind::NotFound => return Ok(BTreeMap::new()),
        Err(error) => return Err(error),
    };
    let here = sources::hash(&settings.sources)?;
    let answer = |line: &str| {
        let one: Compiled = serde_json::from_str(line)?;
        let answer = match one.seconds {
            _ if one.sources != here => {
                EngineAnswer::not_run(COMPILED, "what is here is of other sources")
            }
            _ if one.engine != COMPILED => {
                return Err(io::Error::other(format!("no engine {}", one.engine)));
            }
            Some(seconds) => EngineAnswer {
                reason: one.reason,
                ..EngineAnswer::given(COMPILED, one.verdict, seconds)
            },
            None => EngineAnswer::not_run(COMPILED, one.reason.as_deref().unwrap_or_default()),
        };
        Ok((one.id, answer))
    };
    text.lines().map(answer).collect()
}
