//! The search for collisions (`mufasa_sim::experiment::falsify`).

use std::collections::BTreeMap;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use clap::Args;
use indicatif::ProgressBar;
use mufasa_drives::progress;
use mufasa_sim::attack::Kind;
use mufasa_sim::cav::guard::Variant;
use mufasa_sim::experiment::checks::Checks;
pub(super) use mufasa_sim::experiment::falsify::NAME;
use mufasa_sim::experiment::falsify::found::Found;
use mufasa_sim::experiment::falsify::genome::KINDS;
use mufasa_sim::experiment::falsify::{
    Caller, Falsified, Options, Progress, Round, experiment, part,
};
use mufasa_sim::experiment::select::{Part, Shard};
use mufasa_sim::map::Town;
use mufasa_sim::replay::Replay;
use mufasa_sim::run::{End, RunError};
use serde::Deserialize;

use super::merge::MergeArguments;
use super::parts::{self, shard};
use super::replay::{kind, variant};
use super::report::{FailedRun, Leaves, Section};
use super::text::{csv, json};
use super::work::{pool, prepared};
use super::{maps, tables};
use crate::ended::{Ended, FAILED, INTERRUPTED, said, say};
use crate::limits::whole;

/// Runs if nothing is said.
const RUNS: u64 = 400;
/// The folder of collisions.
const FOUND: &str = "found";

/// What is searched, and for how long.
#[derive(Args, Clone, Debug)]
#[command(after_help = "\
An attack is a point of a cube; random points come first, then CMA-ES goes on from the best. What is sought
is little time left to react. Counted is every collision that the same run does not have without the attacks;
shrunk and kept is one of each explanation: one that has all kinds of attacks of a kept one, offered the same, is
only counted. `mufasa evaluate replay FILE` draws a kept one.

An interrupt ends the search: what was found until then is written and called interrupted. A second one ends it at
once.

Exit codes: 0 done, 1 a collision was found in the hardened profile, 2 bad input or a file
cannot be written, 130 interrupted.")]
pub struct FalsifyArguments {
    /// Runs with attacks [default: 400, without --minutes]. The same seed gives the same then.
    #[arg(long, value_name = "N", value_parser = whole(1_u64, 100_000_000), allow_negative_numbers = true)]
    pub runs: Option<u64>,
    /// Goes on for so long.
    #[arg(long, value_name = "M", conflicts_with = "runs", value_parser = whole(1_u32, 100_000), allow_negative_numbers = true)]
    pub minutes: Option<u32>,
    /// Whole rounds, each of at most 376 runs: what can be made in parts.
    #[arg(long, value_name = "N", conflicts_with_all = ["runs", "minutes"], value_parser = whole(1_u64, 1_000_000), allow_negative_numbers = true)]
    pub rounds: Option<u64>,
    /// Only one of N parts of the rounds, such as 2/8, for other machines to make the others; `mufasa merge` puts
    /// the parts together.
    #[arg(long, value_name = "I/N", value_parser = shard, requires_all = ["out", "rounds"])]
    pub shard: Option<Shard>,
    /// What is checked of remote data.
    #[arg(long, value_name = "VARIANT", default_value = "hardened", value_parser = variant())]
    pub profile: Variant,
    /// Only attacks of this kind; may be given several times [default: all but flood and slow].
    #[arg(long, value_name = "KIND", value_parser = kind())]
    pub attack: Vec<Kind>,
    /// Drive on the map in this folder, not in the town: that of uulm-mrm/tpl's `data`, Ulm-Lehr.
    #[arg(long, value_name = "FOLDER")]
    pub map: Option<PathBuf>,
    /// Other vehicles in the town.
    #[arg(long, value_name = "N", default_value = "15", value_parser = whole(0_u16, 200), allow_negative_numbers = true)]
    pub vehicles: u16,
    /// Of the scenarios and of what is drawn.
    #[arg(long, value_name = "SEED", default_value = "0", value_parser = whole(0_u64, 1_000_000_000), allow_negative_numbers = true)]
    pub seed: u64,
    /// Threads [default: all processors]. With --runs the results do not depend on it.
    #[arg(long, value_name = "N", value_parser = whole(1_u16, 1024), allow_negative_numbers = true)]
    pub threads: Option<u16>,
    /// Write table and collisions as JSON and CSV into this folder, all of it into report.html, and
    /// each collision into its folder found.
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
}

/// Shows how far it is, and says when the time is over.
struct Bar<'a> {
    shown: ProgressBar,
    until: Option<Instant>,
    stop: &'a AtomicBool,
}

impl Caller for Bar<'_> {
    fn tell(&self, progress: Progress) {
        match progress {
            Progress::Run => self.shown.inc(1),
            Progress::Looked(least, collisions) => {
                let text = format!("least time left {least:.1} s, {collisions} collisions");
                self.shown.set_message(text);
            }
        }
    }

    fn goes_on(&self) -> bool {
        self.until.is_none_or(|until| Instant::now() < until)
    }

    fn is_interrupted(&self) -> bool {
        self.stop.load(Ordering::Relaxed)
    }
}

/// Searches until `stop` is set at the latest, writes the table to `out`, and files. The exit code.
pub fn run(arguments: &FalsifyArguments, stop: &AtomicBool, out: &mut impl Write) -> Ended {
    if let Some(shard) = arguments.shard {
        let (_, options, made) = search(arguments, stop, |town, options, caller| {
            let rounds = part(town, options, shard, caller)?;
            Ok((rounds, caller.is_interrupted()))
        })?;
        return write_part(arguments, options, shard, &made, out);
    }
    let (town, _, made) =
        search(arguments, stop, |town, options, caller| experiment(town, options.clone(), caller))?;
    ended(&town, &made, arguments.out.as_deref(), out)
}

/// Puts parts together: what comes out is, byte for byte, what one run of all rounds would write. What was found is
/// shrunk here, as one run shrinks what no round before it had found. Its exit code.
pub(super) fn merge(arguments: &MergeArguments, out: &mut impl Write) -> Ended {
    let folder = arguments.out.as_deref();
    let whole: Part<Options> = parts::read(&arguments.parts)?;
    prepared(folder, FOUND)?;
    let town = maps::same(arguments.map.as_deref(), whole.options.map, "the parts")?;
    let mut made = Falsified::nothing(whole.options);
    for number in 0..made.options.rounds.unwrap_or(0) {
        let id = id(number);
        let round = whole.runs.get(&id).ok_or_else(|| format!("{id} is in none of the parts"))?;
        let round = Round::deserialize(round)
            .map_err(|error| format!("{id}: {error}; write the part anew"))?;
        made.add(&town, round, &()).map_err(said)?;
    }
    ended(&town, &made, folder, out)
}

/// Writes the table, the collisions and the files. The exit code.
fn ended(town: &Town, made: &Falsified, folder: Option<&Path>, out: &mut impl Write) -> Ended {
    let files = leaves(town, made, folder.is_some())?.write(folder)?;
    tables::write(&tables::falsified(made), out)?;
    writeln!(
        out,
        "{} runs in {} rounds, {} collided, {} of them at random; {} runs to shrink {} collisions",
        made.runs,
        made.rounds,
        made.collided,
        made.collided_at_random,
        made.shrinking_runs,
        made.found.len()
    )?;
    if made.interrupted {
        writeln!(
            out,
            "INTERRUPTED: this is what was found until then, perhaps not shrunk to its end"
        )?;
    }
    for found in &made.found {
        let Found { case, t_s, with, speed_mps, last_use } = found;
        let name = case.name();
        let last = match last_use {
            None => "no remote result was ever used".to_owned(),
            Some(it) => {
                let after = if found.is_after() { "; it could have stood" } else { "" };
                format!("last remote result used at {:.2} s{after}", it.t_s)
            }
        };
        writeln!(out, "{name}: with {with} at {t_s:.2} s, CAV at {speed_mps:.1} m/s; {last}")?;
    }
    say(&files, out)?;
    if made.interrupted {
        return Ok(INTERRUPTED);
    }
    let is_hardened = made.options.variant == Variant::Hardened;
    Ok(if is_hardened && !made.found.is_empty() { FAILED } else { 0 })
}

/// What the search makes in a pool of threads, with its map and its options.
fn search<M: Send>(
    arguments: &FalsifyArguments,
    stop: &AtomicBool,
    make: impl FnOnce(&Town, &Options, &Bar<'_>) -> Result<M, RunError> + Send,
) -> Result<(Town, Options, M), String> {
    let &FalsifyArguments { profile, vehicles, seed, minutes, rounds, .. } = arguments;
    prepared(arguments.out.as_deref(), FOUND)?;
    let town = maps::of(arguments.map.as_deref())?;
    let map = town.id;
    let is_bounded = minutes.is_some() || rounds.is_some();
    let runs = if is_bounded { None } else { Some(arguments.runs.unwrap_or(RUNS)) };
    let vehicles = vehicles.into();
    let kinds = if arguments.attack.is_empty() { KINDS.to_vec() } else { arguments.attack.clone() };
    let options = Options { variant: profile, kinds, runs, rounds, vehicles, seed, map };
    let template = match runs {
        Some(_) => "{prefix} {bar:30} {pos}/{len} runs, {left} left; {msg}",
        None => "{prefix} {pos} runs in {elapsed}; {msg}",
    };
    let bar = progress::bar(runs.unwrap_or(0), template);
    bar.set_prefix(NAME);
    let until = minutes.map(|it| Instant::now() + Duration::from_secs(60 * u64::from(it)));
    let caller = Bar { shown: bar, until, stop };
    let made = pool(arguments.threads)?.install(|| make(&town, &options, &caller)).map_err(said);
    caller.shown.finish_and_clear();
    Ok((town, options, made?))
}

/// The name of a round in a part.
fn id(round: u64) -> String {
    format!("{NAME}/{round}")
}

fn write_part(
    arguments: &FalsifyArguments,
    options: Options,
    shard: Shard,
    (rounds, interrupted): &(BTreeMap<u64, Round>, bool),
    out: &mut impl Write,
) -> Ended {
    let value = |(number, round): (&u64, &Round)| Ok((id(*number), serde_json::to_value(round)?));
    let runs = rounds.iter().map(value).collect::<Result<_, serde_json::Error>>();
    let (experiment, runs) = (NAME.to_owned(), runs.map_err(said)?);
    let (interrupted, checks) = (*interrupted, Checks::default());
    let version = parts::version();
    let part = Part { version, experiment, options, shard, interrupted, runs, checks };
    let folder = arguments.out.as_deref().unwrap_or(Path::new("."));
    let code = parts::write(folder, &part, "rounds", out)?;
    if !interrupted || code != 0 {
        return Ok(code);
    }
    writeln!(
        out,
        "INTERRUPTED: what was found until then is there, and merge refuses it as a part"
    )?;
    Ok(INTERRUPTED)
}

/// What a search leaves; with `draws` the files of a folder, too.
fn leaves(town: &Town, made: &Falsified, draws: bool) -> Result<Leaves<'static>, String> {
    let table = tables::falsified(made);
    let mut files = Vec::new();
    if draws {
        files.push((PathBuf::from(format!("{NAME}.csv")), csv(&made.rows)?));
        files.push((PathBuf::from(format!("{NAME}.json")), json(made)?));
        for found in &made.found {
            files.push((file_of(found, "json"), json(found)?));
            let (job, mut replay) = (found.case.job(), Replay::default());
            let outcome = job.run(town, &mut replay).map_err(said)?;
            let page = replay.page(town, &job.id, job.route, &outcome);
            files.push((file_of(found, "html"), page));
        }
    }
    Ok(Leaves { table, files, section: Some(section(made)) })
}

/// The file of a collision in the folder of the search: all about it, or its page.
fn file_of(found: &Found, ending: &str) -> PathBuf {
    let after = if found.is_after() { "-after" } else { "" };
    Path::new(FOUND).join(format!("{}{after}.{ending}", found.case.name()))
}

/// The command, but for how long and from which seed.
fn command(options: &Options) -> String {
    let profile = match options.variant {
        Variant::Hardened => String::new(),
        other => format!(" --profile {}", other.name()),
    };
    let on = maps::option(options.map);
    format!("mufasa evaluate {NAME}{on}{profile}")
}

fn section(made: &Falsified) -> Section<'static> {
    let Options { kinds, rounds, vehicles, seed, map, .. } = &made.options;
    let named: &[Kind] = if kinds[..] == KINDS { &[] } else { kinds };
    let kinds = named.iter().map(|kind| format!(" --attack {}", kind.name()));
    let kinds = kinds.collect::<Vec<_>>().concat();
    let end = rounds.map_or(format!("--runs {}", made.runs), |it| format!("--rounds {it}"));
    let size = format!("{end} --vehicles {vehicles} --seed {seed}");
    let failed = |found: &Found| {
        let [json, page] = ["json", "html"].map(|it| file_of(found, it).display().to_string());
        let command = format!("mufasa evaluate replay {json}{}", maps::option(*map));
        FailedRun { id: found.case.name(), end: End::Collided, page: Some(page), command }
    };
    Section {
        name: NAME,
        command: format!("{}{kinds} {size}", command(&made.options)),
        settings: vec![
            ("Other vehicles", vehicles.to_string()),
            ("seed", seed.to_string()),
            ("map", map.to_string()),
            ("interrupted", String::from(if made.interrupted { "yes" } else { "no" })),
            ("runs with attacks", made.runs.to_string()),
            ("of them collided", made.collided.to_string()),
            ("collided at random", made.collided_at_random.to_string()),
            ("mufasa", env!("CARGO_PKG_VERSION").to_owned()),
        ],
        failed: made.found.iter().map(failed).collect(),
        checks: None,
    }
}
