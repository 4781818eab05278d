//! Experiments in a closed loop (`docs/evaluation.md`): tables, and JSON and CSV of all runs.

pub mod arguments;
mod falsify;
mod maps;
pub mod margins;
pub mod merge;
mod parts;
mod replay;
mod report;
mod scenes;
pub mod shards;
pub mod tables;
mod text;
mod work;

use std::collections::BTreeMap;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::PoisonError;
use std::sync::atomic::AtomicBool;

use indicatif::ProgressBar;
use mufasa_drives::progress;
use mufasa_records::files;
use mufasa_sim::cav::guard::Variant;
use mufasa_sim::experiment::checks::Checks;
use mufasa_sim::experiment::job::Job;
use mufasa_sim::experiment::kept::Run;
use mufasa_sim::experiment::left_out::LEFT_OUT;
use mufasa_sim::experiment::made::{Campaign, Experiment};
use mufasa_sim::experiment::row::Row;
use mufasa_sim::experiment::select::{Options, Select};
use mufasa_sim::map::Town;

use self::arguments::{Asked, EvaluateArguments};
use self::report::{FailedRun, Leaves, REPLAYS, Section};
use self::tables::named;
use self::text::{csv, json};
use self::work::{pool, prepared};
use crate::ended::{DISAGREES, Ended, FAILED, complain, said, say};
use crate::rows::{Column, Rows};

/// One cycle of so many is checked by the model if not all are.
const CHECKED_EVERY: u64 = 100;

/// What an experiment leaves.
struct Results {
    name: &'static str,
    table: Rows,
    options: Options,
    runs: usize,
    json: String,
    /// The rows of the table, and the runs, as CSV.
    csv: [String; 2],
    failed: Vec<Run>,
}

/// Makes an experiment, writes its table to `out` and its files into the folder, if one is given. A search ends when
/// `stop` is set, and says so; nothing else looks at it. Its exit code.
pub fn run(arguments: &EvaluateArguments, stop: &AtomicBool, out: &mut impl Write) -> Ended {
    let (size, name) = match &arguments.experiment {
        Some(Asked::Replay(it)) => return replay::run(it, jobs, out),
        Some(Asked::Falsify(it)) => return falsify::run(it, stop, out),
        Some(Asked::Scenes(it)) => return scenes::run(it, out),
        Some(Asked::Margins(it)) => return margins::run(it, out),
        None => (&arguments.size, "failures"),
        Some(Asked::Failures(size)) => (size, "failures"),
        Some(Asked::Readings(size)) => (size, "readings"),
        Some(Asked::Stages(size)) => (size, "stages"),
        Some(Asked::Attacks(size)) => (size, "attacks"),
        Some(Asked::Combinations(size)) => (size, "combinations"),
        Some(Asked::Availability(size)) => (size, "availability"),
        Some(Asked::LeftOut(size)) => (size, "left-out"),
    };
    let select = Select {
        shard: size.shard,
        checked_every: if size.check_all { 1 } else { CHECKED_EVERY },
        draws: size.out.is_some(),
        ..Select::only(size.only.as_deref())
    };
    let task = Task { sized: &|defaults| size.options(defaults), select: &select };
    prepared(size.out.as_deref(), "")?;
    let town = maps::of(size.map.as_deref())?;
    let shown = named(name).ok_or_else(|| format!("{name}: no experiment"))?;
    let results = in_threads(size.threads, &town, &task, shown)?;
    match (size.shard, &size.out) {
        (Some(shard), Some(folder)) => shards::write(folder, shard, &results, select, out),
        _ => ended(results, select, size.out.as_deref(), out),
    }
}

/// Writes what was made: the table, and files where they are asked for.
fn ended(
    results: Results,
    select: Select<'_>,
    folder: Option<&Path>,
    out: &mut impl Write,
) -> Ended {
    let checks = select.checks.into_inner().unwrap_or_else(PoisonError::into_inner);
    let drawn = select.drawn.into_inner().unwrap_or_else(PoisonError::into_inner);
    tables::write(&results.table, out)?;
    tell(&checks, out)?;
    let code = code(&results, &checks);
    say(&leaves(results, &checks, drawn, folder).write(folder)?, out)?;
    Ok(code)
}

/// Says what the model was asked, and names where it disagrees.
fn tell(checks: &Checks, out: &mut impl Write) -> io::Result<()> {
    for it in &checks.disagreements {
        complain(&format!("{} at {} ns: {}", it.id, it.t_ns, it.why));
    }
    if checks.checked == 0 {
        return Ok(());
    }
    writeln!(out, "{}", report::checked(checks))
}

fn code(results: &Results, checks: &Checks) -> u8 {
    if !checks.disagreements.is_empty() {
        return DISAGREES;
    }
    let is_hardened = |run: &Run| run.variant == Variant::Hardened;
    if results.failed.iter().any(is_hardened) { FAILED } else { 0 }
}

type Made = Result<Results, String>;

/// An experiment, and the columns of its table.
type Shown = (Experiment, &'static [Column<Row>]);

/// How large an experiment is when its defaults are these, and which of its runs are made.
struct Task<'t> {
    sized: &'t (dyn Fn(Options) -> Options + Sync),
    select: &'t Select<'t>,
}

/// The runs of an experiment; none, if there is no such one.
fn jobs(name: &str, sized: &dyn Fn(Options) -> Options, town: &Town) -> Vec<Job> {
    let on = |options| Options { map: town.id, ..sized(options) };
    named(name)
        .map_or_else(Vec::new, |(experiment, _)| experiment.jobs(town, on(experiment.options)))
}

/// In a pool of so many threads.
fn in_threads(threads: Option<u16>, town: &Town, task: &Task<'_>, shown: Shown) -> Made {
    let results = pool(threads)?.install(|| made(shown, task, town))?;
    if let (0, Some(only)) = (results.runs, task.select.only) {
        return Err(format!(
            "{only}: no run of {} has such an id; one is its experiment, variant, what is special, route \
             and scenario, such as failures/paper/empty-tracks/{}/3",
            results.name,
            town.id.route(0)
        ));
    }
    Ok(results)
}

fn made((experiment, columns): Shown, task: &Task<'_>, town: &Town) -> Made {
    let options = Options { map: town.id, ..(task.sized)(experiment.options) };
    let bar = bar(experiment.name);
    let done = |of| step(&bar, of);
    let made = experiment.make(&Campaign { town, options, select: task.select, done: &done });
    bar.finish_and_clear();
    let made = made.map_err(said)?;
    // Where something is left out a run that fails is no failure of the profile.
    let names_failures = experiment.name != LEFT_OUT.name;
    let failed = made.runs.iter().filter(|run| names_failures && run.end.is_failure());
    Ok(Results {
        name: experiment.name,
        table: Rows::new(&made.rows, columns),
        options,
        runs: made.runs.len(),
        json: json(&made)?,
        csv: [csv(&made.rows)?, csv(&made.runs)?],
        failed: failed.cloned().collect(),
    })
}

/// The names of the pages of runs that failed.
fn draw(folder: &Path, drawn: &BTreeMap<String, String>) -> io::Result<Vec<PathBuf>> {
    if !drawn.is_empty() {
        files::prepare(&folder.join(REPLAYS))?;
    }
    let write = |(id, page): (&String, &String)| {
        let name = page_of(id);
        files::write(&folder.join(&name), page)?;
        Ok(name)
    };
    drawn.iter().map(write).collect()
}

/// The file of a run's page in the folder of its experiment.
fn page_of(id: &str) -> PathBuf {
    Path::new(REPLAYS).join(format!("{}.html", id.replace('/', "-")))
}

/// Runs that failed are linked in the report where their pages are there.
fn leaves<'c>(
    results: Results,
    checks: &'c Checks,
    drawn: BTreeMap<String, String>,
    folder: Option<&Path>,
) -> Leaves<'c> {
    let Results { name, table, options, runs, json, csv: [rows_csv, runs_csv], failed } = results;
    let Options { scenarios, vehicles, seed, map, without_precheck } = options;
    let on = maps::option(map);
    let asks = if without_precheck { " --without-precheck" } else { "" };
    let size = format!("--scenarios {scenarios} --vehicles {vehicles} --seed {seed}{on}{asks}");
    let linked = |run: Run| {
        let page = page_of(&run.id);
        let is_there =
            drawn.contains_key(&run.id) || folder.is_some_and(|it| it.join(&page).exists());
        let page = is_there.then(|| page.display().to_string());
        let command = format!("mufasa evaluate replay --run {} {size}", run.id);
        FailedRun { id: run.id, end: run.end, page, command }
    };
    let section = Section {
        name,
        command: format!("mufasa evaluate {name} {size}"),
        settings: vec![
            ("Scenarios", scenarios.to_string()),
            ("other vehicles", vehicles.to_string()),
            ("seed", seed.to_string()),
            ("map", map.to_string()),
            ("runs", runs.to_string()),
            ("mufasa", env!("CARGO_PKG_VERSION").to_owned()),
        ],
        failed: failed.into_iter().map(linked).collect(),
        checks: Some(checks),
    };
    let texts = [(".csv", rows_csv), ("-runs.csv", runs_csv), (".json", json)];
    let texts = texts.map(|(end, text)| (PathBuf::from(format!("{name}{end}")), text));
    let pages = drawn.into_iter().map(|(id, page)| (page_of(&id), page));
    let files = texts.into_iter().chain(pages).collect();
    Leaves { table, files, section: Some(section) }
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
