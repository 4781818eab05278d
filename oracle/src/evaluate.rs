//! Experiments in a closed loop (`docs/evaluation.md`): tables, and JSON and CSV of all runs.

pub mod arguments;
mod falsify;
pub mod merge;
mod parts;
mod replay;
pub mod shards;
pub mod tables;
mod text;

use std::io::{self, Write};
use std::path::Path;

use indicatif::ProgressBar;
use mufasa_drives::check::complain;
use mufasa_drives::progress;
use mufasa_records::files;
use mufasa_sim::cav::guard::Variant;
use mufasa_sim::experiment::job::Options;
use mufasa_sim::experiment::select::Select;
use mufasa_sim::experiment::{attacks, availability, cpu, failures, stages};
use mufasa_sim::map::Town;
use mufasa_sim::map::streets::town;
use serde::Serialize;

use self::arguments::{EvaluateArguments, Experiment};
use self::tables::Rows;
use self::text::{csv, said};
use crate::document;

/// The hardened profile let something happen.
const FAILED: u8 = 1;
/// Bad input, or a file that cannot be written.
const BAD_INPUT: u8 = 2;

/// What an experiment leaves.
struct Results {
    name: &'static str,
    table: Rows,
    options: Options,
    runs: usize,
    json: String,
    /// The rows of the table, and the runs, as CSV.
    csv: [String; 2],
    code: u8,
}

/// Makes an experiment, writes its table to `out` and its files into the folder, if one is given. Its exit
/// code. Errors: those of writing to `out`.
pub fn run(
    arguments: &EvaluateArguments,
    out: &mut impl Write,
    err: &mut impl Write,
) -> io::Result<u8> {
    let (size, make) = match &arguments.experiment {
        Some(Experiment::Replay(it)) => return replay::run(it, out, err),
        Some(Experiment::Falsify(it)) => return falsify::run(it, out, err),
        None => (&arguments.size, failures as Make),
        Some(Experiment::Failures(size)) => (size, failures as Make),
        Some(Experiment::Stages(size)) => (size, stages as Make),
        Some(Experiment::Attacks(size)) => (size, attacks as Make),
        Some(Experiment::Availability(size)) => (size, availability as Make),
        Some(Experiment::Cpu(size)) => (size, cpu as Make),
    };
    let select = Select { shard: size.shard, ..Select::only(size.only.as_deref()) };
    let task = Task { sized: &|defaults| size.options(defaults), select: &select };
    let made = prepared(size.out.as_deref()).and_then(|()| in_threads(size.threads, &task, make));
    match (made, size.shard, &size.out) {
        (Ok(results), Some(shard), Some(folder)) => {
            shards::write(folder, shard, &results, select, out, err)
        }
        (made, ..) => ended(made, size.out.as_deref(), size.into.as_deref(), out, err),
    }
}

/// Writes what was made: the table, and files and a document where they are asked for.
fn ended(
    made: Made,
    folder: Option<&Path>,
    document: Option<&Path>,
    out: &mut impl Write,
    err: &mut impl Write,
) -> io::Result<u8> {
    let results = match made {
        Ok(results) => results,
        Err(message) => {
            complain(err, &message);
            return Ok(BAD_INPUT);
        }
    };
    write!(out, "{}", results.table.text())?;
    let into = document.map(|file| (file, put(file, &results).map(|()| Vec::new())));
    let written = folder.map(|folder| (folder, write_files(folder, &results)));
    for (place, done) in written.into_iter().chain(into) {
        match done {
            Ok(names) => {
                let mut names = names.iter();
                names.try_for_each(|name| writeln!(out, "{}", place.join(name).display()))?;
            }
            Err(error) => {
                complain(err, &format!("{}: cannot be written: {error}", place.display()));
                return Ok(BAD_INPUT);
            }
        }
    }
    Ok(results.code)
}

type Made = Result<Results, String>;

/// How large an experiment is when its defaults are these, and which of its runs are made.
struct Task<'t> {
    sized: &'t (dyn Fn(Options) -> Options + Sync),
    select: &'t Select<'t>,
}

type Make = fn(&Task<'_>, &Town) -> Made;

/// The experiments by their names.
const EXPERIMENTS: [(&str, Make); 5] = [
    (failures::NAME, failures),
    (stages::NAME, stages),
    (attacks::NAME, attacks),
    (availability::NAME, availability),
    (cpu::NAME, cpu),
];

/// Whether files can be written into the folder.
fn prepared(folder: Option<&Path>) -> Result<(), String> {
    let Some(folder) = folder else { return Ok(()) };
    let say = |error| format!("{}: cannot be written to: {error}", folder.display());
    files::prepare(folder).map_err(say)
}

/// In a pool of so many threads.
fn in_threads(threads: Option<u16>, task: &Task<'_>, make: Make) -> Made {
    let threads = usize::from(threads.unwrap_or(0));
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
    let results = pool.map_err(said)?.install(|| make(task, &town()))?;
    if let (0, Some(only)) = (results.runs, task.select.only) {
        return Err(format!(
            "{only}: no run of {} has such an id; one is its experiment, variant, what is special, route \
             and scenario, such as failures/paper/tracks-empty/0/3",
            results.name
        ));
    }
    Ok(results)
}

fn failures(task: &Task<'_>, town: &Town) -> Made {
    let options = (task.sized)(failures::OPTIONS);
    let bar = bar(failures::NAME);
    let made = failures::experiment(town, options, task.select, |of| step(&bar, of));
    bar.finish_and_clear();
    let made = made.map_err(said)?;
    let is_hit = |row: &failures::Row| row.variant == Variant::Hardened && row.failures > 0;
    let code = if made.rows.iter().any(is_hit) { FAILED } else { 0 };
    let results =
        results((failures::NAME, options), tables::failures(&made), &made, &made.rows, &made.runs)?;
    Ok(Results { code, ..results })
}

fn stages(task: &Task<'_>, town: &Town) -> Made {
    let options = (task.sized)(stages::OPTIONS);
    let bar = bar(stages::NAME);
    let made = stages::experiment(town, options, task.select, |of| step(&bar, of));
    bar.finish_and_clear();
    let made = made.map_err(said)?;
    results((stages::NAME, options), tables::stages(&made), &made, &made.rows, &made.runs)
}

fn attacks(task: &Task<'_>, town: &Town) -> Made {
    let options = (task.sized)(attacks::OPTIONS);
    let bar = bar(attacks::NAME);
    let made = attacks::experiment(town, options, task.select, |of| step(&bar, of));
    bar.finish_and_clear();
    let made = made.map_err(said)?;
    results((attacks::NAME, options), tables::attacks(&made), &made, &made.rows, &made.runs)
}

fn availability(task: &Task<'_>, town: &Town) -> Made {
    let options = (task.sized)(availability::OPTIONS);
    let bar = bar(availability::NAME);
    let made = availability::experiment(town, options, task.select, |of| step(&bar, of));
    bar.finish_and_clear();
    let made = made.map_err(said)?;
    results(
        (availability::NAME, options),
        tables::availability(&made),
        &made,
        &made.rows,
        &made.runs,
    )
}

fn cpu(task: &Task<'_>, town: &Town) -> Made {
    let options = (task.sized)(cpu::OPTIONS);
    let bar = bar(cpu::NAME);
    let made = cpu::experiment(town, options, task.select, |of| step(&bar, of));
    bar.finish_and_clear();
    let made = made.map_err(said)?;
    results((cpu::NAME, options), tables::cpu(&made), &made, &made.rows, &made.runs)
}

fn results<A: Serialize, B: Serialize>(
    (name, options): (&'static str, Options),
    table: Rows,
    all: &impl Serialize,
    rows: &[A],
    runs: &[B],
) -> Made {
    let json = serde_json::to_string_pretty(all).map_err(said)? + "\n";
    Ok(Results {
        name,
        table,
        options,
        runs: runs.len(),
        json,
        csv: [csv(rows)?, csv(runs)?],
        code: 0,
    })
}

/// The names of the files, each there completely or not at all.
fn write_files(folder: &Path, results: &Results) -> io::Result<Vec<String>> {
    let name = results.name;
    let [rows, runs] = &results.csv;
    let files = [
        (format!("{name}.csv"), rows),
        (format!("{name}-runs.csv"), runs),
        (format!("{name}.json"), &results.json),
    ];
    files.iter().try_for_each(|(name, text)| files::write(&folder.join(name), text))?;
    Ok(files.map(|(name, _)| name).to_vec())
}

fn put(file: &Path, results: &Results) -> io::Result<()> {
    document::write(file, &format!("mufasa evaluate {}", results.name), &results.table.markdown())
}

fn bar(name: &str) -> ProgressBar {
    let bar = progress::bar(0, "{prefix} {bar:30} {pos}/{len} runs, {left} left");
    bar.set_prefix(name.to_owned());
    bar
}

fn step(bar: &ProgressBar, of: usize) {
    bar.set_length(u64::try_from(of).unwrap_or(u64::MAX));
    bar.inc(1);
}
