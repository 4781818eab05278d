//! Experiments in a closed loop (`docs/evaluation.md`): tables, and JSON and CSV of all runs.

pub mod arguments;
mod falsify;
mod replay;
pub mod tables;
mod text;

use std::io::{self, Write};
use std::path::Path;

use indicatif::ProgressBar;
use mufasa_drives::check::complain;
use mufasa_drives::progress;
use mufasa_records::files;
use mufasa_sim::cav::guard::Variant;
use mufasa_sim::experiment::{attacks, availability, failures, stages};
use mufasa_sim::map::Town;
use mufasa_sim::map::streets::town;
use serde::Serialize;

use self::arguments::{EvaluateArguments, Experiment, SizeArguments};
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
    let (size, made) = match &arguments.experiment {
        Some(Experiment::Replay(it)) => return replay::run(it, out, err),
        Some(Experiment::Falsify(it)) => return falsify::run(it, out, err),
        None => (&arguments.size, in_threads(&arguments.size, failures)),
        Some(Experiment::Failures(size)) => (size, in_threads(size, failures)),
        Some(Experiment::Stages(size)) => (size, in_threads(size, stages)),
        Some(Experiment::Attacks(size)) => (size, in_threads(size, attacks)),
        Some(Experiment::Availability(size)) => (size, in_threads(size, availability)),
    };
    let results = match made {
        Ok(results) => results,
        Err(message) => {
            complain(err, &message);
            return Ok(BAD_INPUT);
        }
    };
    write!(out, "{}", results.table.text())?;
    let into = size.into.iter().map(|file| (file, put(file, &results).map(|()| Vec::new())));
    let written = size.out.iter().map(|folder| (folder, write_files(folder, &results)));
    for (place, done) in written.chain(into).collect::<Vec<_>>() {
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

/// In a pool of so many threads, after a look whether files can be written.
fn in_threads(size: &SizeArguments, experiment: fn(&SizeArguments, &Town) -> Made) -> Made {
    if let Some(folder) = &size.out {
        let say = |error| format!("{}: cannot be written to: {error}", folder.display());
        files::prepare(folder).map_err(say)?;
    }
    let threads = usize::from(size.threads.unwrap_or(0));
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
    let results = pool.map_err(said)?.install(|| experiment(size, &town()))?;
    if results.runs == 0 {
        let only = size.only.as_deref().unwrap_or_default();
        return Err(format!(
            "{only}: no run of {} has such an id; one is its experiment, variant, what is special, route \
             and scenario, such as failures/paper/tracks-empty/0/3",
            results.name
        ));
    }
    Ok(results)
}

fn failures(size: &SizeArguments, town: &Town) -> Made {
    let options = size.options(failures::OPTIONS);
    let bar = bar(failures::NAME);
    let made = failures::experiment(town, options, size.only.as_deref(), |of| step(&bar, of));
    bar.finish_and_clear();
    let made = made.map_err(said)?;
    let is_hit = |row: &failures::Row| row.variant == Variant::Hardened && row.failures > 0;
    let code = if made.rows.iter().any(is_hit) { FAILED } else { 0 };
    let results = results(failures::NAME, tables::failures(&made), &made, &made.rows, &made.runs)?;
    Ok(Results { code, ..results })
}

fn stages(size: &SizeArguments, town: &Town) -> Made {
    let options = size.options(stages::OPTIONS);
    let bar = bar(stages::NAME);
    let made = stages::experiment(town, options, size.only.as_deref(), |of| step(&bar, of));
    bar.finish_and_clear();
    let made = made.map_err(said)?;
    results(stages::NAME, tables::stages(&made), &made, &made.rows, &made.runs)
}

fn attacks(size: &SizeArguments, town: &Town) -> Made {
    let options = size.options(attacks::OPTIONS);
    let bar = bar(attacks::NAME);
    let made = attacks::experiment(town, options, size.only.as_deref(), |of| step(&bar, of));
    bar.finish_and_clear();
    let made = made.map_err(said)?;
    results(attacks::NAME, tables::attacks(&made), &made, &made.rows, &made.runs)
}

fn availability(size: &SizeArguments, town: &Town) -> Made {
    let options = size.options(availability::OPTIONS);
    let bar = bar(availability::NAME);
    let made = availability::experiment(town, options, size.only.as_deref(), |of| step(&bar, of));
    bar.finish_and_clear();
    let made = made.map_err(said)?;
    results(availability::NAME, tables::availability(&made), &made, &made.rows, &made.runs)
}

fn results<A: Serialize, B: Serialize>(
    name: &'static str,
    table: Rows,
    all: &impl Serialize,
    rows: &[A],
    runs: &[B],
) -> Made {
    let json = serde_json::to_string_pretty(all).map_err(said)? + "\n";
    Ok(Results { name, table, runs: runs.len(), json, csv: [csv(rows)?, csv(runs)?], code: 0 })
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
