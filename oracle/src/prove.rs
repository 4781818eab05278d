//! What is proved, by which engine, of which inputs: all engines that are here are run, the others
//! are listed as not run.

pub mod claim;
pub mod engines;
pub mod settings;
pub mod sources;
pub mod tables;

use std::io::{self, Write};
use std::path::Path;

use indicatif::ProgressBar;

use crate::document;
use claim::{Claim, Status};
use engines::ClaimSource;
use mufasa_drives::check::complain;
use mufasa_records::files;
pub use settings::Settings;

/// Name of the table in a document.
pub const TABLE_NAME: &str = "mufasa prove";

/// What stands before the number of the sources (`sources::hash_of_all`) below the table in a document.
pub const SOURCES: &str = "Number of the sources: `";

/// How it ended; the worst that applies.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub enum End {
    /// Whatever was run is proved, or tested where no engine proves it.
    #[default]
    Proved,
    /// Something that should hold is refuted or not known.
    NotProved,
    /// No line has such a name, a file could not be read or written, or an engine broke down.
    BadInput,
}

impl End {
    /// The exit code.
    pub fn code(self) -> u8 {
        self as u8
    }
}

/// Runs the engines, writes the table to `out` and what is wrong to `err`. Errors are those of
/// writing to `out`.
pub fn run(settings: &Settings, out: &mut impl Write, err: &mut impl Write) -> io::Result<End> {
    let mut lines = Vec::new();
    let mut end = End::default();
    for source in ClaimSource::ALL {
        match source.lines(settings, &bar(source)) {
            Ok(more) => lines.extend(more),
            Err(problem) => {
                complain(err, &format!("{}: {problem}", source.name()));
                end = End::BadInput;
            }
        }
    }
    if lines.is_empty() {
        complain(err, &format!("{}: nothing has such a name", settings.names.join(", ")));
        return Ok(End::BadInput);
    }
    if lines.iter().any(|line| matches!(line.answer.status, Status::Refuted | Status::Unknown)) {
        end = end.max(End::NotProved);
    }
    let table = if settings.markdown { tables::markdown(&lines) } else { tables::text(&lines) };
    write!(out, "{table}")?;
    if let Some(path) = &settings.into
        && let Err(error) = write_document(path, settings, &lines)
    {
        complain(err, &format!("{}: cannot be written: {error}", path.display()));
        end = End::BadInput;
    }
    if let Err(error) = write_lines(settings, &lines) {
        complain(err, &format!("{}: cannot be written: {error}", settings.out.display()));
        end = End::BadInput;
    }
    Ok(end)
}

/// All claims, of which nothing was asked. Errors are those of reading the lists of them.
pub fn claims() -> io::Result<Vec<Claim>> {
    let claims: io::Result<Vec<_>> =
        ClaimSource::ALL.into_iter().map(ClaimSource::claims).collect();
    Ok(claims?.into_iter().flatten().collect())
}

/// The table, and of which sources it is.
fn write_document(path: &Path, settings: &Settings, lines: &[Claim]) -> io::Result<()> {
    let sources = sources::hash_of_all(&settings.sources)?;
    let table = format!("{}\n{}{sources}`.\n", tables::markdown(lines), SOURCES);
    document::write(path, TABLE_NAME, &table)
}

fn write_lines(settings: &Settings, lines: &[Claim]) -> io::Result<()> {
    let mut text = String::new();
    for line in lines {
        text.push_str(&serde_json::to_string(line)?);
        text.push('\n');
    }
    if let Some(folder) = settings.out.parent() {
        std::fs::create_dir_all(folder)?;
    }
    files::write(&settings.out, &text)
}

fn bar(source: ClaimSource) -> ProgressBar {
    let bar = mufasa_drives::progress::bar(0, "{prefix} {bar:30} {pos}/{len} {msg}");
    bar.set_prefix(source.name());
    bar
}
