//! A search for cycles that take many instructions: random changes, of which the slowest are changed again
//! (`docs/speed.md`).

mod count;
mod moves;

use std::io::Write;
use std::path::{Path, PathBuf};

use clap::Args;
use clap::builder::TypedValueParser;
use mufasa::cycle::steps::{Counts, most_steps};
use mufasa::input::profile::Profile;
use mufasa::report::Stage;
use mufasa::services::configuration::Configuration;
use mufasa_benches::workload::{SIZES, Variant, Workload};
use mufasa_model::input::cycle::Cycle;
use mufasa_model::input::parameters::Parameters;
use mufasa_props::bridge;
use mufasa_records::{cycle_to_line, files, names};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use self::count::What;
use crate::document;
use crate::ended::{Ended, Stopped, cannot, say};
use crate::limits::one_of;
use crate::rows::{Rows, number, text};

/// Name of the table in a document.
const TABLE: &str = "mufasa slow";
/// Cycles of a round.
const ROUND: usize = 24;
/// Of these the next round's are made.
const KEPT: usize = 6;
/// Of a round, from W1 anew.
const FRESH: usize = 4;
/// Most changes between a cycle and the one that it is made of.
const STEPS: usize = 6;

/// What is searched for, and how long.
#[derive(Args, Clone, Debug)]
#[command(after_help = "\
Vehicle, route and grid are those of W1 (docs/speed.md); tracks, points and detections are changed, at most as many
as docs/configuration.md recommends. Needs valgrind. Run it with `cargo run --release`: other builds count other
instructions.
Exit codes: 0 done, 2 bad input, or valgrind is missing.")]
pub struct Settings {
    /// A stage or the whole cycle; by default each of them.
    #[arg(long, value_parser = what(), ignore_case = true)]
    of: Option<What>,
    /// Rounds of 24 cycles for each row.
    #[arg(long, default_value_t = 40)]
    rounds: u32,
    /// Of the random changes.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Folder for the table and the slowest cycles, as records [default: target/slow].
    #[arg(long, value_name = "DIR", default_value = "target/slow", hide_default_value = true)]
    out: PathBuf,
    /// Put the table into a document, between the lines that mark its place.
    #[arg(long, value_name = "FILE")]
    into: Option<PathBuf>,
    /// Run the cycles of this file once each, for valgrind.
    #[arg(long, value_name = "FILE", hide = true, requires = "of")]
    measure: Option<PathBuf>,
}

fn what() -> impl TypedValueParser<Value = What> {
    one_of(What::ALL, What::name)
}

/// The slowest cycle that was found.
struct Slowest {
    what: What,
    cycle: Cycle,
    instructions: u64,
    /// Of W1 as it is.
    start: u64,
    /// In which it was found, from 1; 0 is W1 as it is.
    round: u32,
}

/// Searches, and writes a table to `out` and with the cycles into the folder.
pub fn run(settings: &Settings, out: &mut impl Write) -> Ended {
    if let (Some(file), Some(what)) = (&settings.measure, settings.of) {
        count::run_each(file, what)?;
        return Ok(0);
    }
    document::has_place(settings.into.as_deref(), TABLE)?;
    let folder = &settings.out;
    files::prepare(folder).map_err(cannot(folder, "written to"))?;
    let searched = settings.of.as_ref().map_or(&What::ALL[..], std::slice::from_ref);
    let bar = mufasa_drives::progress::bar(
        u64::from(settings.rounds) * 2 * searched.len() as u64,
        "{bar:30} {pos}/{len} rounds, {msg}, {left} left",
    );
    let mut found = Vec::new();
    for profile in [Profile::PAPER, Profile::HARDENED] {
        for what in searched {
            found.push(search(*what, profile, settings, &bar)?);
        }
    }
    bar.finish_and_clear();
    let rows = table(&found);
    write!(out, "{}", rows.text(None))?;
    let records: String =
        found.iter().map(|it| cycle_to_line(&it.name(), &it.cycle) + "\n").collect();
    let written = [("slow.md", rows.markdown()), ("slow.jsonl", records)];
    for (name, content) in &written {
        let file = folder.join(name);
        files::write(&file, content).map_err(cannot(&file, "written"))?;
    }
    say(&written.map(|(name, _)| folder.join(name)), out)?;
    if let Some(path) = &settings.into {
        let measured = format!(
            "{}\nSeed {}, {} rounds of {ROUND}, {}.",
            rows.markdown(),
            settings.seed,
            settings.rounds,
            env!("MUFASA_VERSION"),
        );
        document::write(path, TABLE, &measured).map_err(cannot(path, "written"))?;
    }
    Ok(0)
}

/// Hill climbing with a pool of [`KEPT`].
fn search(
    what: What,
    profile: Profile,
    settings: &Settings,
    bar: &indicatif::ProgressBar,
) -> Result<Slowest, Stopped> {
    let random = &mut ChaCha8Rng::seed_from_u64(settings.seed);
    let workload = Workload::new(&SIZES[0], Variant::Pass);
    let mut w1 = bridge::from_impl(&workload.cycle(profile, Configuration::AllRemote));
    // That of a vehicle, not of the race with libraries.
    w1.parameters.work_limit = Parameters::default().work_limit;
    let start = instructions(std::slice::from_ref(&w1), what, &settings.out)?[0];
    let mut pool = vec![(start, 0, w1.clone())];
    for round in 1..=settings.rounds {
        let changed = |index: usize| {
            let fresh = index < FRESH;
            let mut cycle = if fresh { w1.clone() } else { pool[index % pool.len()].2.clone() };
            for _ in 0..random.random_range(1..=STEPS) {
                moves::change(&mut cycle, random);
            }
            cycle
        };
        let cycles: Vec<_> = (0..ROUND).map(changed).collect();
        let counts = instructions(&cycles, what, &settings.out)?;
        pool.extend(counts.into_iter().zip(cycles).map(|(count, cycle)| (count, round, cycle)));
        pool.sort_by_key(|(count, ..)| std::cmp::Reverse(*count));
        pool.dedup_by_key(|(count, ..)| *count);
        pool.truncate(KEPT);
        bar.set_message(format!("{} {}: {}", name_of(profile), what.name(), pool[0].0));
        bar.inc(1);
    }
    let (instructions, round, cycle) = pool.swap_remove(0);
    Ok(Slowest { what, cycle, instructions, start, round })
}

fn instructions(cycles: &[Cycle], what: What, folder: &Path) -> Result<Vec<u64>, Stopped> {
    let lines: Vec<_> = cycles.iter().map(|cycle| cycle_to_line("slow", cycle)).collect();
    count::instructions(&lines, what, folder)
}

fn name_of(profile: Profile) -> &'static str {
    names::profile(bridge::profile_from_impl(profile))
}

impl Slowest {
    /// That it may take (`spec/4-arithmetic.md#steps`).
    fn steps(&self) -> u64 {
        bridge::with_impl(&self.cycle, |cycle, _| {
            let most = most_steps(&Counts::of(cycle), &cycle.parameters);
            match self.what {
                What::Cycle => most.total(),
                What::Stage(Stage::Iv) if cycle.profile != Profile::PAPER => {
                    most.stages[3] + most.fail_safe
                }
                What::Stage(stage) => most.stages[stage as usize],
            }
        })
    }

    fn instructions_a_step(&self) -> String {
        let tenths = 10 * self.instructions / self.steps().max(1);
        format!("{}.{}", tenths / 10, tenths % 10)
    }

    fn name(&self) -> String {
        format!("{} {}", names::profile(self.cycle.profile), self.what.name())
    }

    /// Tracks, points, detections and earlier lists.
    fn sizes(&self) -> String {
        let cycle = &self.cycle;
        let tracks = cycle.tracks.as_ref().map_or(0, |list| list.items.len());
        let points = cycle.trajectory.as_ref().map_or(0, |list| list.points.len());
        let detections = cycle.detections.as_ref().map_or(0, |list| list.items.len());
        format!("{tracks}, {points}, {detections}, {}", cycle.detection_history.len())
    }
}

fn table(found: &[Slowest]) -> Rows {
    Rows::new(
        found,
        &[
            text("profile, stage", Slowest::name),
            text("tracks, points, detections, earlier lists", Slowest::sizes),
            number("instructions of W1", |it| it.start.to_string()),
            number("of the slowest", |it| it.instructions.to_string()),
            number("steps at most", |it| it.steps().to_string()),
            number("instructions a step", Slowest::instructions_a_step),
            number("found in round", |it| it.round.to_string()),
        ],
    )
}
