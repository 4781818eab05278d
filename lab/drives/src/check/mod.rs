//! Drives checked by the model and the implementation side by side.

pub mod checked;
pub mod fallback;
pub mod findings;
pub mod judge;
pub mod pictures;
pub mod records;
pub mod report;
mod requesters;
pub mod sides;
pub mod steps;
pub mod table;
pub mod tally;
pub mod words;

use std::io::{self, Write};
use std::path::{Path, PathBuf};

use indicatif::ProgressBar;
use mufasa_model::offloading::requester::Parameters;

use self::checked::{Checked, Seen};
use self::findings::Findings;
use self::judge::in_order;
use self::records::Records;
use self::report::Report;
use crate::{ReadError, Stream, counted};

/// What a check writes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// A report of every drive, and the table over all drives when there are several.
    Text,
    /// The table over all drives.
    Summary,
    /// JSON Lines.
    Json,
}

/// How drives are checked.
#[derive(Clone, Debug, PartialEq)]
pub struct Settings {
    /// Parameters of the requester.
    pub requester: Parameters,
    /// What is written.
    pub format: Format,
    /// Where the pictures go, if anywhere; the folder must exist.
    pub pictures: Option<PathBuf>,
}

/// Checks the drives, several at a time, and writes in their order what is found to `out`, what
/// is wrong with the input to `err`. Errors are those of writing to `out`.
pub fn run(
    drives: &[Result<Stream, ReadError>],
    settings: &Settings,
    out: &mut impl Write,
    err: &mut impl Write,
) -> io::Result<Findings> {
    let mut findings = Findings::default();
    let mut lines = Vec::new();
    let progress = progress(drives.iter().flatten().map(Stream::count).sum());
    let judge = |index: usize| {
        let drive = drives[index].as_ref().map_err(Clone::clone)?;
        Judgement::new(drive.clone(), settings, || progress.inc(1))
    };
    in_order(drives.len(), judge, |judged: Result<Judgement, ReadError>| {
        match judged {
            Ok(judged) => {
                judged.note(&mut findings, err);
                lines.push(report::line(&judged.checked));
                progress.suspend(|| judged.write(out))?;
            }
            Err(error) => {
                findings.unreadable += 1;
                complain(err, &error.to_string());
            }
        }
        io::Result::Ok(())
    })?;
    progress.finish_and_clear();
    match settings.format {
        Format::Text if lines.len() > 1 => writeln!(out, "{}", table::by_drive(&lines))?,
        Format::Summary if !lines.is_empty() => writeln!(out, "{}", table::by_drive(&lines))?,
        Format::Text | Format::Summary => {}
        Format::Json => {
            writeln!(out, "{}", records::last(&findings)?)?;
            return Ok(findings);
        }
    }
    if let (Format::Summary, Some(note)) = (settings.format, &findings.note) {
        let more = match findings.noted - 1 {
            0 => String::new(),
            more => format!(" ({} alike)", counted(more, "more drive")),
        };
        writeln!(out, "note: {note}{more}")?;
    }
    writeln!(out, "{}", findings.summary())?;
    Ok(findings)
}

/// A drive, judged, with what is to be written of it.
struct Judgement {
    checked: Checked,
    written: Written,
    pictures: usize,
    /// Which picture could not be written, and why; none is tried after it.
    refusal: Option<(PathBuf, io::Error)>,
}

/// What is to be written of a drive, by the format.
enum Written {
    Text(Report),
    Summary,
    Json(Records),
}

impl Judgement {
    /// Judges a drive. Errors: a cycle cannot be read again, or there is no place for what is to be written.
    fn new(drive: Stream, settings: &Settings, done: impl Fn()) -> Result<Self, ReadError> {
        let mut written = match settings.format {
            Format::Text => Written::Text(Report::default()),
            Format::Summary => Written::Summary,
            Format::Json => Written::Json(Records::default()),
        };
        let (mut pictures, mut refusal) = (0, None);
        let (name, source) = (drive.name.clone(), drive.source.clone());
        let each = |seen: &Seen<'_>| {
            let taken = match &mut written {
                Written::Text(report) => report.take(seen),
                Written::Summary => Ok(()),
                Written::Json(records) => records.take(&name, seen),
            };
            taken.map_err(|error| ReadError::file(Path::new(&source), error.to_string()))?;
            if let (Some(folder), None) = (&settings.pictures, &refusal) {
                match pictures::write(folder, &name, seen) {
                    Ok(file) => pictures += usize::from(file.is_some()),
                    Err(problem) => refusal = Some(problem),
                }
            }
            done();
            Ok(())
        };
        let readings = settings.format == Format::Json;
        let checked = Checked::new(drive, &settings.requester, readings, each)?;
        Ok(Self { checked, written, pictures, refusal })
    }

    /// Adds the drive to the findings and names its errors.
    fn note(&self, findings: &mut Findings, err: &mut impl Write) {
        findings.add(&self.checked);
        findings.pictures += self.pictures;
        let source = &self.checked.drive.source;
        for (id, problem) in &self.checked.errors {
            complain(err, &format!("{source}: cycle {id}: {}", words::invalid(problem)));
        }
        if let Some((file, error)) = &self.refusal {
            findings.unreadable += 1;
            complain(err, &format!("{}: cannot be written: {error}", file.display()));
        }
    }

    fn write(self, out: &mut impl Write) -> io::Result<()> {
        match self.written {
            Written::Text(report) => report.write(out, &self.checked)?,
            Written::Summary => {}
            Written::Json(records) => records.write(out, &self.checked)?,
        }
        out.flush()
    }
}

/// Says what is wrong. A closed standard error is no reason to stop.
pub fn complain(err: &mut impl Write, message: &str) {
    for line in message.lines() {
        let _ = writeln!(err, "mufasa: {line}");
    }
}

/// A bar over so many cycles.
pub fn progress(cycles: usize) -> ProgressBar {
    let steps = u64::try_from(cycles).unwrap_or(u64::MAX);
    crate::progress::bar(steps, "{bar:40} {pos}/{len} cycles, {left} left")
}
