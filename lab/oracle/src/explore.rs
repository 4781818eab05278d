//! The offloading protocol explored state by state, with tables, and vectors of what was found
//! (`spec/2-offloading.md#properties-of-the-whole-protocol`).

pub mod evidence;
pub mod findings;
pub mod monitor;
pub mod report;
pub mod vector;

use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::time::Instant;

use clap::Args;
use clap::builder::TypedValueParser;
use mufasa_exploration::bounds::{Bounds, World};
use mufasa_exploration::properties::Property;
use mufasa_exploration::run::{self, WorldOutcome};
use mufasa_exploration::search::Progress;
use mufasa_model::input::cycle::Profile;

use self::report::ExplorationReport;
use crate::document;
use crate::ended::{Stopped, cannot, complain, say};
use crate::limits::{one_of, profile};
use mufasa_records::files;
use mufasa_records::names;

/// Width of a table, characters.
const WIDTH: u16 = 118;

/// Name of the tables in a document.
pub fn table_name(bounds: Bounds) -> String {
    format!("mufasa explore --bounds {}", bounds.name())
}

/// What is explored.
#[derive(Args, Clone, Debug)]
#[command(after_help = "\
Exit codes: 0 all properties that the profile claims hold, 1 one fails, 2 bad input, 3 model and
implementation disagree, or the two engines do.")]
pub struct Settings {
    /// Profile; by default both.
    #[arg(long, value_parser = profile(), ignore_case = true)]
    pub profile: Option<Profile>,
    /// How much: small takes minutes, large hours.
    #[arg(long, default_value = "small", value_parser = bounds(), ignore_case = true)]
    pub bounds: Bounds,
    /// Only this world.
    #[arg(long, value_name = "NAME")]
    pub world: Option<String>,
    /// Put the tables into a document, between the lines that mark their place.
    #[arg(long, value_name = "FILE", conflicts_with_all = ["world", "profile"])]
    pub into: Option<PathBuf>,
    /// Folder for the tables as JSON and Markdown, and the vectors of what fails [default: exploration].
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
}

fn bounds() -> impl TypedValueParser<Value = Bounds> {
    one_of([Bounds::Small, Bounds::Large], Bounds::name)
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

/// Explores, writes tables to `out`, and into the folder vectors of what fails, `exploration.json` and
/// `exploration.md`. Errors: those of writing to `out`, and what makes exploring of no use.
pub fn run(settings: &Settings, folder: &Path, out: &mut impl Write) -> Result<End, Stopped> {
    let worlds = worlds(settings.bounds, settings.world.as_deref())?;
    document::has_place(settings.into.as_deref(), &table_name(settings.bounds))?;
    let stamp = document::stamp(settings.into.as_deref())?;
    files::prepare(folder).map_err(cannot(folder, "written to"))?;
    let (mut end, mut reports) = (End::default(), Vec::new());
    let both = [Profile::PAPER, Profile::HARDENED];
    for profile in settings.profile.as_ref().map_or(&both[..], std::slice::from_ref) {
        let mut outcomes = Vec::new();
        for world in &worlds {
            match explore(world, *profile) {
                Ok(outcome) => outcomes.push(outcome),
                Err(difference) => {
                    complain(&format!("{}: {difference}", title(world, *profile)));
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
            end = end.max(look_for_unseen(*profile, &outcomes));
        }
        reports.push(report);
        match findings::stories(*profile, &outcomes) {
            Ok(stories) => {
                let written = findings::write(folder, &stories);
                end = end.max(say_written(written, out)?);
            }
            Err(error) => {
                complain(&format!("a counterexample cannot be walked: {error}"));
                end = end.max(End::Disagree);
            }
        }
        out.flush()?;
    }
    end = end.max(say_written(write(folder, &reports), out)?);
    if let Some(path) = &settings.into {
        let tables: String = reports.iter().map(ExplorationReport::markdown).collect();
        let written = document::write(path, &table_name(settings.bounds), &(stamp + &tables));
        let written = written.map(|()| vec![path.clone()]).map_err(|error| (path.clone(), error));
        end = end.max(say_written(written, out)?);
    }
    Ok(end)
}

type Written = Result<Vec<PathBuf>, (PathBuf, io::Error)>;

/// Names the files written, or the one that cannot be.
fn say_written(written: Written, out: &mut impl Write) -> io::Result<End> {
    match written {
        Ok(files) => say(&files, out).map(|()| End::Holds),
        Err((file, error)) => {
            complain(&cannot(&file, "written")(error));
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

/// The worlds asked for. Errors: there is none of that name.
fn worlds(bounds: Bounds, name: Option<&str>) -> Result<Vec<&'static World>, String> {
    let all = bounds.worlds();
    let found: Vec<_> =
        all.iter().filter(|world| name.is_none_or(|name| name == world.name)).collect();
    if found.is_empty() && name != Some(monitor::NAME) {
        let names: Vec<_> = all.iter().map(|world| world.name).chain([monitor::NAME]).collect();
        let (name, names) = (name.unwrap_or_default(), names.join(", "));
        return Err(format!("{name}: no such world; there are {names}"));
    }
    Ok(found)
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
fn look_for_unseen(profile: Profile, outcomes: &[WorldOutcome]) -> End {
    let mut end = End::default();
    for property in Property::ALL {
        for sight in evidence::unseen(property, profile, outcomes) {
            let (profile, property) = (names::profile(profile), property.name());
            complain(&format!("{profile}: {property}: not seen: {}", sight.name()));
            end = End::Fails;
        }
    }
    end
}

/// Profile and world.
fn title(world: &World, profile: Profile) -> String {
    format!("{} {}", names::profile(profile), world.name)
}
