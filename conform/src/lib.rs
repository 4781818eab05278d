//! `mufasa conform`: a program of others, held against the exact model
//! (`spec/5-interfaces.md#programs-under-test`).
//!
//! A campaign asks cases one by one, each from its own number and the seed alone, so that shards
//! are disjoint and any case can be had again. The first disagreement of every class is shrunk
//! while the program is asked about every smaller record.

mod answer;
mod class;
mod course;
mod damage;
mod drives;
mod error;
mod examine;
mod explain;
mod generate;
mod junit;
mod minimise;
mod question;
pub mod reference;
mod report;
mod shrink;
mod source;
mod subject;
mod summary;
pub mod vectors;

use std::ffi::OsString;
use std::io::Write;
use std::path::PathBuf;
use std::time::Duration;

use mufasa_model::input::cycle::Profile;

pub use class::{Breach, Class, Kind, Scale};
pub use error::ConformError;
pub use explain::{Numbers, Told};
pub use source::CASES;
pub use summary::{Campaign, Found, Group, Summary};

use course::Course;
use report::Files;
use source::Source;
use subject::Subject;

/// No disagreement.
const CONFORMS: u8 = 0;
/// Some disagreement.
const DISAGREES: u8 = 1;
/// Bad input, or nothing was compared.
const BAD_INPUT: u8 = 2;

/// What is to be done.
#[derive(Clone, Debug, PartialEq)]
pub struct Settings {
    /// The program under test and its arguments.
    pub command: Vec<OsString>,
    /// Profile of generated cases and of recorded drives.
    pub profile: Profile,
    /// Cases of all shards; by default 10,000, or all that the drives give.
    pub cases: Option<u64>,
    /// Seed of the cases.
    pub seed: u64,
    /// How long an answer may take.
    pub time_limit: Duration,
    /// Kinds of generated records.
    pub kinds: Vec<Kind>,
    /// Only the cases whose number leaves the first when divided by the second.
    pub shard: Option<(u64, u64)>,
    /// Files of drives that give the cases instead.
    pub drives: Vec<PathBuf>,
    /// Margin within which a disagreement is none, m.
    pub tolerance: Option<f64>,
    /// Where summary, JUnit and reproducers go.
    pub out: PathBuf,
}

/// Runs a campaign or a shard of it: writes what is found to `out` as it is found, and the files
/// at the end. Returns the exit code: 0 without a disagreement, 1 with one, 2 when some file could
/// not be read or nothing was compared. Errors: bad usage.
pub fn run(
    settings: &Settings,
    out: &mut impl Write,
    err: &mut impl Write,
) -> Result<u8, ConformError> {
    let (source, unreadable) = Source::new(settings, err)?;
    // First, so that nothing of an earlier run is left when the program cannot be started.
    let files = Files::prepare(&settings.out, settings.shard)?;
    let subject = Subject::start(&settings.command, settings.time_limit)?;
    let mut course = Course::new(settings, &source, subject);
    course.run(out)?;
    let summary = course.summary();
    files.write(&summary)?;
    report::end(&summary, out)?;
    writeln!(out, "{}, {}", files.summary.display(), files.junit.display())?;
    if !summary.classes.is_empty() {
        writeln!(
            out,
            "{}: the records, shrunk where that was possible",
            files.reproducers.display()
        )?;
    }
    Ok(match (summary.classes.is_empty(), unreadable || summary.asked == 0) {
        (false, _) => DISAGREES,
        (true, true) => BAD_INPUT,
        (true, false) => CONFORMS,
    })
}

/// Joins the summaries of shards, prints the result, and writes it to a folder if one is given.
/// Returns the exit code: 0 and 1 as above, 2 when shards are missing. Errors: summaries that do
/// not belong together.
pub fn merge(
    inputs: &[PathBuf],
    folder: Option<&PathBuf>,
    out: &mut impl Write,
) -> Result<u8, ConformError> {
    let summary = Summary::merge(inputs)?;
    for found in &summary.classes {
        report::found(found, out)?;
    }
    report::end(&summary, out)?;
    if let Some(folder) = folder {
        Files::prepare(folder, None)?.write(&summary)?;
    }
    let missing: Vec<String> = summary.missing().iter().map(u64::to_string).collect();
    if !missing.is_empty() {
        writeln!(out, "INCOMPLETE: shard {} missing", missing.join(", "))?;
    }
    Ok(match (summary.classes.is_empty(), summary.is_complete() && summary.asked > 0) {
        (false, _) => DISAGREES,
        (true, true) => CONFORMS,
        (true, false) => BAD_INPUT,
    })
}
