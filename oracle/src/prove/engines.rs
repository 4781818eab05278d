//! The engines: each turns what it can say into lines.

use std::collections::BTreeMap;
use std::fs;
use std::io::{self, ErrorKind};
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Duration;

use indicatif::ProgressBar;
use mufasa_model::cycle::Profile;
use mufasa_proofs::explore::bounds::{Bounds, World};
use mufasa_proofs::explore::run;
use mufasa_theorems::prove::{self as solve, Judgement, Verdict as Found};
use mufasa_theorems::theorem::{self, Theorem};
use mufasa_theorems::{gappa, solver};
use serde::Deserialize;

use super::Settings;
use super::line::{Line, Verdict};

/// Worlds of the exploration that take seconds; `mufasa explore` does all.
const QUICK_WORLDS: [&str; 2] = ["choice", "honest"];
/// The harnesses for Kani and CBMC.
const HARNESSES: &str = include_str!("../../../proofs/expected.toml");

/// Something that proves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Engine {
    /// Theorems over the reals about the model's source.
    Theorems,
    /// Rounding errors.
    Gappa,
    /// Every reachable state of the protocol within small bounds.
    Exploration,
    /// Harnesses on compiled code.
    Cbmc,
}

impl Engine {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::Theorems, Self::Gappa, Self::Exploration, Self::Cbmc];

    /// Its name.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Theorems => "z3",
            Self::Gappa => "gappa",
            Self::Exploration => "exploration",
            Self::Cbmc => "cbmc-wasm",
        }
    }

    /// Runs it. Errors are those of talking to it.
    pub fn lines(self, settings: &Settings, bar: &ProgressBar) -> io::Result<Vec<Line>> {
        let lines = match self {
            Self::Theorems => theorems(settings, bar),
            Self::Gappa => bounds(settings, bar),
            Self::Exploration => exploration(settings, bar),
            Self::Cbmc => harnesses(settings),
        };
        bar.finish_and_clear();
        lines
    }

    fn is_wanted(self, settings: &Settings, id: &str) -> bool {
        let names = &settings.names;
        names.is_empty() || names.iter().any(|name| id.contains(name) || self.name() == name)
    }
}

fn theorems(settings: &Settings, bar: &ProgressBar) -> io::Result<Vec<Line>> {
    let engine = Engine::Theorems;
    let wanted: Vec<&Theorem> =
        theorem::all().filter(|theorem| engine.is_wanted(settings, theorem.id)).collect();
    bar.set_length(u64::try_from(wanted.len()).unwrap_or(u64::MAX));
    let line = |theorem: &Theorem| {
        let parts = [theorem.id, theorem.statement, theorem.domain];
        let mutant = &theorem.mutant;
        let mutant = format!("{}: `{}` becomes `{}`", mutant.file, mutant.from, mutant.to);
        Line { mutant: Some(mutant), ..Line::not_run(engine.name(), parts, "no z3 4.8 or newer") }
    };
    if !solver::is_new_enough() {
        return Ok(wanted.into_iter().map(line).collect());
    }
    let judgements = side_by_side(&wanted, |theorem| {
        let judgement = solve::judge(theorem);
        bar.inc(1);
        bar.set_message(theorem.id);
        judgement
    });
    wanted
        .iter()
        .zip(judgements)
        .map(|(theorem, judgement)| Ok(judged(line(theorem), theorem, &judgement?)))
        .collect()
}

fn judged(line: Line, theorem: &Theorem, judgement: &Judgement) -> Line {
    let Judgement { proof, control } = judgement;
    let reason = match (&proof.verdict, &control.verdict) {
        (Found::Refuted(values), _) => Some(format!("by {}", values_in_words(values))),
        (Found::Unknown, _) => Some(String::from("no answer in time")),
        (Found::Proved, Found::Refuted(_)) => None,
        (Found::Proved, _) => Some(String::from("its wrong variant was not refuted")),
    };
    Line {
        verdict: verdict(judgement.verdict()),
        seconds: Some((proof.time + control.time).as_secs_f64()),
        paths: Some(proof.paths),
        refuted_variant: Some(theorem.wrong.statement.to_owned()),
        reason,
        ..line
    }
}

fn verdict(found: &Found) -> Verdict {
    match found {
        Found::Proved => Verdict::Proved,
        Found::Refuted(_) => Verdict::Refuted,
        Found::Unknown => Verdict::Unknown,
    }
}

fn values_in_words(values: &[(String, f64)]) -> String {
    let words: Vec<String> =
        values.iter().map(|(name, value)| format!("{name} = {value}")).collect();
    words.join(", ")
}

fn bounds(settings: &Settings, bar: &ProgressBar) -> io::Result<Vec<Line>> {
    let engine = Engine::Gappa;
    let is_here = gappa::version().is_some();
    let wanted = gappa::BOUNDS.iter().filter(|bound| engine.is_wanted(settings, bound.id));
    wanted
        .map(|bound| {
            bar.set_message(bound.id);
            let parts = [bound.id, bound.statement, bound.domain];
            let line = Line::not_run(engine.name(), parts, "no Gappa here");
            if !is_here {
                return Ok(line);
            }
            let (found, time) = bound.judge()?;
            let reason =
                (found != Found::Proved).then(|| String::from("no proof, or one of less, too"));
            let seconds = Some(time.as_secs_f64());
            Ok(Line { verdict: verdict(&found), seconds, reason, ..line })
        })
        .collect()
}

/// The properties that the hardened profile claims, in the worlds that take seconds.
fn exploration(settings: &Settings, bar: &ProgressBar) -> io::Result<Vec<Line>> {
    let engine = Engine::Exploration;
    let worlds = Bounds::Small.worlds().iter();
    let mut lines = Vec::new();
    for world in worlds.filter(|world| QUICK_WORLDS.contains(&world.name)) {
        if !engine.is_wanted(settings, world.name) {
            continue;
        }
        bar.set_message(world.name);
        let outcome = run::run(world, Profile::Hardened, 0, |_| bar.tick())
            .map_err(|difference| io::Error::other(difference.to_string()))?;
        lines.extend(found_in(world, &outcome));
    }
    Ok(lines)
}

fn found_in(world: &World, outcome: &run::Outcome) -> Vec<Line> {
    let domain = format!(
        "hardened, world {}: {} requesters, {} stations; all {} states",
        world.name,
        world.requesters,
        world.stations.len(),
        outcome.states
    );
    let claimed = outcome.results.iter().filter(|it| it.law.is_claimed(Profile::Hardened));
    let share = outcome.time / u32::try_from(outcome.results.len().max(1)).unwrap_or(u32::MAX);
    claimed
        .map(|finding| {
            let id = format!("{} ({})", finding.law.name(), world.name);
            let parts = [id.as_str(), finding.law.requirement(), &domain];
            let moves = finding.counterexample.as_ref().map(|it| it.trace.len() + it.circle.len());
            Line {
                verdict: if moves.is_some() { Verdict::Refuted } else { Verdict::Proved },
                seconds: Some(Duration::as_secs_f64(&share)),
                reason: moves.map(|moves| format!("after {moves} moves")),
                ..Line::not_run(Engine::Exploration.name(), parts, "")
            }
        })
        .collect()
}

/// What `scripts/prove-wasm` wrote; the harnesses it did not write about are not run.
fn harnesses(settings: &Settings) -> io::Result<Vec<Line>> {
    #[derive(Deserialize)]
    struct Expected {
        harness: Vec<Harness>,
    }
    #[derive(Deserialize)]
    struct Harness {
        id: String,
        statement: String,
        domain: String,
    }
    let engine = Engine::Cbmc;
    let expected: Expected = toml::from_str(HARNESSES).map_err(io::Error::other)?;
    let text = match fs::read_to_string(&settings.cbmc) {
        Ok(text) => text,
        Err(error) if error.kind() == ErrorKind::NotFound => String::new(),
        Err(error) => return Err(error),
    };
    let written: Result<Vec<Line>, _> = text.lines().map(serde_json::from_str).collect();
    let mut written: BTreeMap<String, Line> =
        written?.into_iter().map(|line| (line.id.clone(), line)).collect();
    let wanted = expected.harness.iter().filter(|one| engine.is_wanted(settings, &one.id));
    let lines = wanted.map(|one| {
        let parts = [one.id.as_str(), &one.statement, &one.domain];
        let reason = "scripts/prove-wasm did not run it";
        written.remove(&one.id).unwrap_or_else(|| Line::not_run(engine.name(), parts, reason))
    });
    Ok(lines.collect())
}

/// Applies `f` to every item, in as many threads as there are processors; results in order.
fn side_by_side<T: Sync, R: Send>(items: &[T], f: impl Fn(&T) -> R + Sync) -> Vec<R> {
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    let (next, results) = (AtomicUsize::new(0), Mutex::new(BTreeMap::new()));
    std::thread::scope(|scope| {
        for _ in 0..threads {
            scope.spawn(|| {
                while let Some((place, item)) = {
                    let place = next.fetch_add(1, Ordering::Relaxed);
                    items.get(place).map(|item| (place, item))
                } {
                    let result = f(item);
                    results.lock().expect("no thread panics with the lock").insert(place, result);
                }
            });
        }
    });
    results.into_inner().expect("no thread panics with the lock").into_values().collect()
}
