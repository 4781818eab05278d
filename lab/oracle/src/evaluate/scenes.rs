//! The search for avoidable collisions with one other (`mufasa_sim::experiment::scenes`).

use std::io::Write;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use clap::Args;
use mufasa_drives::progress;
use mufasa_sim::cav::guard::Variant;
use mufasa_sim::experiment::scenes::{NAME, Options, Scenes};
use mufasa_sim::vehicle::TAU_S;

use super::replay::variant;
use super::report::Leaves;
use super::tables;
use super::text::{csv, json};
use super::work::{pool, prepared};
use crate::ended::{Ended, FAILED, say};
use crate::limits::{number, whole};

/// Scenes if nothing is said, and those that are made at once where a time is said.
const SCENES: u64 = 2000;
const BATCH: u64 = 500;
/// The folder of collisions.
const FOUND: &str = "collisions";

/// What is searched, and for how long.
#[derive(Args, Clone, Debug)]
#[command(after_help = "\
A CAV drives along a straight way or a bend, one other comes to where it will be, and what is remote is moved or lied.
While cycles are safe the CAV drives on; after the first unsafe one it brakes, tau after the last safe one, to a stop, and
stands. A collision is avoidable if braking from the first cycle on avoids it; who runs into a CAV that stands, and could
have stopped since it began to brake (2 s, then 3 m/s^2), is counted apart. A scene is
clean if nobody comes nearer than 1 m when nobody reacts.

Exit codes: 0 done, 1 an avoidable collision was found in the hardened profile, 2 bad input or a file cannot be
written.")]
pub struct ScenesArguments {
    /// Scenes [default: 2000, without --minutes].
    #[arg(long, value_name = "N", value_parser = whole(1_u64, 100_000_000), allow_negative_numbers = true)]
    pub scenes: Option<u64>,
    /// Goes on for so long.
    #[arg(long, value_name = "M", conflicts_with = "scenes", value_parser = whole(1_u32, 100_000), allow_negative_numbers = true)]
    pub minutes: Option<u32>,
    /// Of what is drawn.
    #[arg(long, value_name = "SEED", default_value = "0", value_parser = whole(0_u64, 1_000_000_000), allow_negative_numbers = true)]
    pub seed: u64,
    /// What is checked; sofof: nothing.
    #[arg(long, value_name = "VARIANT", default_value = "hardened", value_parser = variant())]
    pub profile: Variant,
    /// Time until the CAV brakes, s: the parameter of the cycles, and what it does.
    #[arg(long, value_name = "S", default_value_t = TAU_S, value_parser = number(0.0, 10.0), allow_negative_numbers = true)]
    pub tau: f64,
    /// Only scenes whose kinds contain this, such as all-remote/ahead or /turns; may be given several times, for all
    /// to be contained.
    #[arg(long, value_name = "TEXT")]
    pub only: Vec<String>,
    /// Threads [default: all processors]. With --scenes the results do not depend on it.
    #[arg(long, value_name = "N", value_parser = whole(1_u16, 1024), allow_negative_numbers = true)]
    pub threads: Option<u16>,
    /// Write table and scenes as JSON and CSV into this folder, and the cycles of each avoidable collision, as records
    /// for `mufasa check` and `mufasa oracle`, into its folder collisions.
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
}

/// Searches, writes the table to `out`, and files. The exit code.
pub fn run(arguments: &ScenesArguments, out: &mut impl Write) -> Ended {
    let (made, names) = search(arguments)?;
    tables::write(&tables::scenes(&made), out)?;
    say(&names, out)?;
    let is_hardened = made.options.profile == Variant::Hardened;
    Ok(if is_hardened && made.failures().next().is_some() { FAILED } else { 0 })
}

fn search(arguments: &ScenesArguments) -> Result<(Scenes, Vec<PathBuf>), String> {
    let &ScenesArguments { seed, profile, tau, .. } = arguments;
    prepared(arguments.out.as_deref(), FOUND)?;
    let only = arguments.only.clone();
    let options = Options { profile, tau_s: tau, seed, only, wrong: None };
    let scenes = arguments.scenes.unwrap_or(SCENES);
    let until =
        arguments.minutes.map(|it| Instant::now() + Duration::from_secs(60 * u64::from(it)));
    let bar = match until {
        Some(_) => progress::bar(0, "{prefix} {pos} scenes in {elapsed}"),
        None => progress::bar(scenes, "{prefix} {bar:30} {pos}/{len} scenes, {left} left"),
    };
    bar.set_prefix(NAME);
    let mut made = Scenes::nothing(options);
    pool(arguments.threads)?.install(|| {
        let done = || bar.inc(1);
        match until {
            None => made.add(scenes, &done),
            Some(until) => {
                while Instant::now() < until {
                    made.add(BATCH, &done);
                }
            }
        }
    });
    bar.finish_and_clear();
    if made.runs.is_empty() {
        return Err(format!("{}: no scene has such kinds", arguments.only.join(", ")));
    }
    let names = leaves(&made)?.write(arguments.out.as_deref())?;
    Ok((made, names))
}

/// What a search leaves.
fn leaves(made: &Scenes) -> Result<Leaves<'static>, String> {
    let texts =
        [(".csv", csv(&made.rows)?), ("-runs.csv", csv(&made.runs)?), (".json", json(made)?)];
    let texts = texts.map(|(end, text)| (PathBuf::from(format!("{NAME}{end}")), text));
    let collisions = made.failures().map(|run| {
        let file = Path::new(FOUND).join(format!("{}.jsonl", run.name()));
        (file, made.options.records(run.scene))
    });
    let files = texts.into_iter().chain(collisions).collect();
    Ok(Leaves { table: tables::scenes(made), files, section: None })
}
