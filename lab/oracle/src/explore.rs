//! The offloading protocol explored state by state, with tables, vectors and charts of what was
//! found (`spec/2-offloading.md#properties-of-the-whole-protocol`).

pub mod chart;
pub mod evidence;
pub mod findings;
pub mod monitor;
pub mod report;
pub mod vector;

use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::time::Instant;

use mufasa_exploration::bounds::{Bounds, World};
use mufasa_exploration::properties::Property;
use mufasa_exploration::run::{self, WorldOutcome};
use mufasa_exploration::search::Progress;
use mufasa_model::input::cycle::Profile;

use self::report::ExplorationReport;
use crate::document;
use mufasa_drives::check::complain;
use mufasa_records::files;
use mufasa_records::names;

/// Width of a table, characters.
const WIDTH: u16 = 118;

/// Name of the tables in a document.
pub fn table_name(bounds: Bounds) -> String {
    format!("mufasa explore --bounds {}", bounds.name())
}

/// What is explored.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Settings {
    /// In which profiles.
    pub profiles: Vec<Profile>,
    /// How much.
    pub bounds: Bounds,
    /// Only the world of this name.
    pub world: Option<String>,
    /// A document whose tables of these bounds are replaced.
    pub into: Option<PathBuf>,
    /// Folder for vectors and charts of what was found.
    pub folder: PathBuf,
}

/// How an exploration ended; the worst that applies.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub enum End {
    /// Every property that a profile claims holds.
    #[default]
    Holds,
    /// A property that a profile claims fails, or speaks of something that was never seen.
    Fails,
    /// No such world, or a file could not be written.
    BadInput,
    /// Model and implementation differ.
    Disagree,
}

impl End {
    /// The exit code.
    pub fn code(self) -> u8 {
        self as u8
    }
}

/// Explores, writes tables to `out`, what is wrong to `err`, and into the folder vectors and charts
/// of what fails, `exploration.json` and `exploration.md`. Errors are those of writing to `out`.
pub fn run(settings: &Settings, out: &mut impl Write, err: &mut impl Write) -> io::Result<End> {
    let Some(worlds) = worlds(settings.bounds, settings.world.as_deref(), err) else {
        return Ok(End::BadInput);
    };
    if let Err(message) =
        document::has_place(settings.into.as_deref(), &table_name(settings.bounds))
    {
        complain(err, &message);
        return Ok(End::BadInput);
    }
    if let Err(error) = files::prepare(&settings.folder) {
        complain(err, &format!("{}: cannot be written to: {error}", settings.folder.display()));
        return Ok(End::BadInput);
    }
    let (mut end, mut reports) = (End::default(), Vec::new());
    for profile in &settings.profiles {
        let mut outcomes = Vec::new();
        for world in &worlds {
            match explore(world, *profile) {
                Ok(outcome) => outcomes.push(outcome),
                Err(difference) => {
                    complain(err, &format!("{}: {difference}", title(world, *profile)));
                    end = End::Disagree;
                }
            }
        }
        writeln!(out, "{}, {} bounds", names::profile(*profile), settings.bounds.name())?;
        let asks_monitor = settings.world.as_deref().is_none_or(|it| it == monitor::NAME);
        let laws = if asks_monitor { monitor::laws(*profile) } else { Vec::new() };
        if laws.iter().any(|it| !it.holds) {
            end = end.max(End::Fails);
        }
        let report = ExplorationReport::new(*profile, settings.bounds, &outcomes, laws);
        if !worlds.is_empty() {
            writeln!(out, "{}", report.worlds().text(None))?;
            writeln!(out, "{}", report.properties().text(Some(WIDTH)))?;
        }
        if asks_monitor {
            writeln!(out, "{}", monitor::table(&report.monitor).text(Some(WIDTH)))?;
        }
        end = end.max(judge(*profile, &outcomes));
        if settings.world.is_none() {
            end = end.max(look_for_unseen(*profile, &outcomes, err));
        }
        reports.push(report);
        match findings::stories(*profile, &outcomes) {
            Ok(stories) => {
                let written = findings::write(&settings.folder, &stories);
                end = end.max(say_written(written, out, err)?);
            }
            Err(error) => {
                complain(err, &format!("a counterexample cannot be walked: {error}"));
                end = end.max(End::Disagree);
            }
        }
        out.flush()?;
    }
    end = end.max(say_written(write(&settings.folder, &reports), out, err)?);
    if let Some(path) = &settings.into {
        let tables: String = reports.iter().map(ExplorationReport::markdown).collect();
        let written = document::write(path, &table_name(settings.bounds), &tables);
        let written = written.map(|()| vec![path.clone()]).map_err(|error| (path.clone(), error));
        end = end.max(say_written(written, out, err)?);
    }
    Ok(end)
}

type Written = Result<Vec<PathBuf>, (PathBuf, io::Error)>;

/// Names the files written, or the one that cannot be.
fn say_written(written: Written, out: &mut impl Write, err: &mut impl Write) -> io::Result<End> {
    match written {
        Ok(files) => {
            files.iter().try_for_each(|file| writeln!(out, "{}", file.display()))?;
            Ok(End::Holds)
        }
        Err((file, error)) => {
            complain(err, &format!("{}: cannot be written: {error}", file.display()));
            Ok(End::BadInput)
        }
    }
}

/// Writes all tables, for programs and for documents.
fn write(folder: &Path, reports: &[ExplorationReport]) -> Written {
    let json = serde_json::to_string_pretty(reports).map_err(io::Error::from);
    let markdown = Ok(reports.iter().map(ExplorationReport::markdown).collect());
    let mut written = Vec::new();
    for (name, content) in [("exploration.json", json), ("exploration.md", markdown)] {
        let file = folder.join(name);
        let done = content.and_then(|content: String| files::write(&file, &content));
        done.map_err(|error| (file.clone(), error))?;
        written.push(file);
    }
    Ok(written)
}

/// The worlds asked for; says so when there is none of that name.
fn worlds(bounds: Bounds, name: Option<&str>, err: &mut impl Write) -> Option<Vec<&'static World>> {
    let all = bounds.worlds();
    let found: Vec<_> =
        all.iter().filter(|world| name.is_none_or(|name| name == world.name)).collect();
    if found.is_empty() && name != Some(monitor::NAME) {
        let names: Vec<_> = all.iter().map(|world| world.name).chain([monitor::NAME]).collect();
        complain(
            err,
            &format!("{}: no such world; there are {}", name.unwrap_or_default(), names.join(", ")),
        );
        return None;
    }
    Some(found)
}

fn explore(
    world: &'static World,
    profile: Profile,
) -> Result<WorldOutcome, Box<mufasa_props::refine::Difference>> {
    let bar = mufasa_drives::progress::bar(0, "{spinner} {prefix}: {msg}");
    bar.set_prefix(title(world, profile));
    bar.set_message("the parts");
    bar.tick();
    let start = Instant::now();
    let outcome = run::explore(world, profile, |progress| {
        bar.set_message(words(progress, start));
        bar.tick();
    });
    bar.finish_and_clear();
    outcome
}

fn words(progress: Progress, start: Instant) -> String {
    let Progress { states, done, depth, transitions } = progress;
    let seconds = start.elapsed().as_secs_f64().max(1e-3);
    // A number of states is far below 2^53.
    #[expect(clippy::cast_precision_loss, reason = "shown with few digits")]
    let rate = done as f64 / seconds;
    format!(
        "{} states, {} to do, depth {depth}, {} moves, {rate:.0} states/s",
        evidence::grouped(evidence::wide(states)),
        evidence::grouped(evidence::wide(states - done)),
        evidence::grouped(transitions),
    )
}

fn judge(profile: Profile, outcomes: &[WorldOutcome]) -> End {
    let mut findings = outcomes.iter().flat_map(|outcome| &outcome.results);
    let fails = findings.any(|it| it.counterexample.is_some() && it.property.is_claimed(profile));
    if fails { End::Fails } else { End::Holds }
}

/// All worlds together have to show what the properties speak of: a property of nothing holds.
fn look_for_unseen(profile: Profile, outcomes: &[WorldOutcome], err: &mut impl Write) -> End {
    let mut end = End::default();
    for property in Property::ALL {
        for sight in evidence::unseen(property, profile, outcomes) {
            let (profile, property) = (names::profile(profile), property.name());
            complain(err, &format!("{profile}: {property}: not seen: {}", sight.name()));
            end = End::Fails;
        }
    }
    end
}

/// Profile and world.
pub fn title(world: &World, profile: Profile) -> String {
    format!("{} {}", names::profile(profile), world.name)
}
