//! `mufasa conform`: a program of others, held against the exact model
//! (`spec/5-interfaces.md#programs-under-test`).
//!
//! A campaign asks cases one by one, each from its own number and the seed alone, so that shards
//! are disjoint and any case can be had again. At its end the classes of disagreements are made small, those
//! to mend first before the others, as far as there is time: the program is asked about every smaller record.

mod cases;
mod error;
mod judge;
pub mod reference;
mod results;
mod runner;
mod settings;
mod shrink;
mod subject;
pub mod vectors;

use std::fs;
use std::io::Write;
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

pub use cases::source::CASES;
pub use error::ConformError;
pub use judge::class::{Breach, Class, Kind, Scale};
pub use judge::explain::{Numbers, Told};
pub use results::found::{Found, NotShrunk};
pub use results::junit::xml_text;
pub use results::summary::{Campaign, CaseCount, Summary};
pub use settings::Settings;

use cases::source::Source;
use cases::vectors::fitting;
use results::report::Files;
use runner::Runner;
use subject::Subject;

/// No disagreement.
const CONFORMS: u8 = 0;
/// Some disagreement.
const DISAGREES: u8 = 1;
/// Bad input, or nothing was compared.
const BAD_INPUT: u8 = 2;
/// Ended before its end, as a shell says it of a program that Ctrl-C ends.
pub const INTERRUPTED: u8 = 130;

/// Runs a campaign or a shard of it: names to `out` what is found as it is found, and writes the
/// report and the files at the end, which comes early when `stop` is set. Returns the exit code: 0 without a
/// disagreement, 1 with one, 2 when some file could not be read or nothing was compared, 130 when
/// it was interrupted. Errors: bad usage.
pub fn run(
    settings: &Settings,
    stop: &Arc<AtomicBool>,
    out: &mut impl Write,
    err: &mut impl Write,
) -> Result<u8, ConformError> {
    let (source, unreadable) = Source::new(settings, err)?;
    let vectors = fitting(settings)?;
    // First, so that nothing of an earlier run is left when the program cannot be started.
    let files = Files::prepare(&settings.out, settings.shard)?;
    let started = Subject::start(&settings.command, settings.time_limit, stop);
    // A folder that is empty looks like a result of nothing.
    let subject = started.inspect_err(|_| drop(fs::remove_dir(&settings.out)))?;
    let mut runner = Runner::new(settings, &source, &vectors, subject);
    let said = match runner.run(out) {
        Err(gone @ ConformError::Output(_)) => {
            // Nobody listens any more: what is known is in the files.
            runner.interrupt();
            Err(gone)
        }
        said => {
            said?;
            Ok(())
        }
    };
    let summary = runner.summary()?;
    files.write(&summary)?;
    said?;
    results::report::end(&summary, out)?;
    writeln!(out, "{}, {}", files.summary.display(), files.junit.display())?;
    if !summary.classes.is_empty() {
        writeln!(
            out,
            "{}: the records, shrunk where that was possible",
            files.reproducers.display()
        )?;
        writeln!(out, "what each rule means: docs/conformance.md, section 3")?;
    }
    if summary.interrupted {
        return Ok(INTERRUPTED);
    }
    Ok(match (summary.classes.is_empty(), unreadable || summary.is_empty()) {
        (false, _) => DISAGREES,
        (true, true) => BAD_INPUT,
        (true, false) => CONFORMS,
    })
}

/// Joins the summaries of shards, prints the result, and writes it to a folder if one is given.
/// Returns the exit code: 0 and 1 as above, 2 when shards are missing or were interrupted. Errors:
/// summaries that do not belong together.
pub fn merge(
    inputs: &[PathBuf],
    folder: Option<&PathBuf>,
    out: &mut impl Write,
) -> Result<u8, ConformError> {
    let summary = Summary::merge(inputs)?;
    results::report::end(&summary, out)?;
    if let Some(folder) = folder {
        Files::prepare(folder, None)?.write(&summary)?;
    }
    let missing: Vec<String> = summary.missing().iter().map(u64::to_string).collect();
    if summary.interrupted {
        writeln!(out, "INCOMPLETE: a shard was interrupted")?;
    }
    if !missing.is_empty() {
        writeln!(out, "INCOMPLETE: shard {} missing", missing.join(", "))?;
    }
    Ok(match (summary.classes.is_empty(), summary.is_complete() && !summary.is_empty()) {
        (false, _) => DISAGREES,
        (true, true) => CONFORMS,
        (true, false) => BAD_INPUT,
    })
}
