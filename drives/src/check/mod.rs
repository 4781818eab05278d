//! Drives checked by the model and the implementation side by side.

pub mod checked;
pub mod fallback;
pub mod judge;
pub mod pictures;
pub mod records;
pub mod report;
mod requesters;
mod sheet;
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
use self::judge::in_order;
use self::records::Records;
use self::report::Report;
use self::tally::Tally;
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

/// What a run found.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Findings {
    /// Drives checked.
    pub drives: usize,
    /// Drives that could not be read, or pictures that could not be written.
    pub unreadable: usize,
    /// The model's counts over all drives.
    pub tally: Tally,
    /// Breaches of conformance.
    pub disagreements: usize,
    /// Fallbacks that the model's requester started.
    pub fallbacks: usize,
    /// Cycles whose remote data the model's requester used.
    pub offloaded: usize,
    /// Elements too late and silences that ended offloading without an unsafe cycle.
    pub lost: usize,
    /// Pictures written.
    pub pictures: usize,
    /// What limits of the quality of service the first drive that lost offloading exceeds.
    pub note: Option<String>,
    /// How many drives exceed one.
    pub noted: usize,
}

impl Findings {
    /// 0 all safe, 1 some cycle unsafe or offloading lost to late data or silence, 2 bad input,
    /// 3 model and implementation disagree; the highest that applies.
    pub fn exit_code(&self) -> u8 {
        if self.disagreements > 0 {
            3
        } else if self.unreadable > 0 || self.tally.errors > 0 {
            2
        } else {
            u8::from(self.tally.unsafe_cycles() > 0 || self.lost > 0)
        }
    }

    /// Adds what was found on a drive.
    pub fn add(&mut self, checked: &Checked) {
        self.drives += 1;
        self.tally.merge(&checked.tallies[0]);
        self.disagreements += checked.disagreements();
        let run = &checked.requesters[0];
        self.fallbacks += run.fallbacks;
        self.offloaded += run.offloaded;
        self.lost += checked.lost();
        if let Some(note) = checked.notes.first() {
            self.noted += 1;
            self.note.get_or_insert_with(|| format!("{}: {note}", checked.drive.name));
        }
    }

    /// One sentence over the run.
    pub fn summary(&self) -> String {
        let Self {
            drives,
            unreadable,
            tally,
            disagreements,
            fallbacks,
            offloaded,
            lost,
            pictures,
            ..
        } = self;
        let agreement = match disagreements {
            // Of nothing there is nothing to agree on.
            0 if tally.cycles == 0 => String::new(),
            0 => "; model and implementation agree".to_owned(),
            count => format!("; model and implementation DISAGREE {}", counted(*count, "time")),
        };
        let mut text = format!(
            "{}, {}: {} safe, {} unsafe, {}, {offloaded} offloaded{agreement}",
            counted(*drives, "drive"),
            counted(tally.cycles, "cycle"),
            tally.safe,
            tally.unsafe_cycles(),
            counted(*fallbacks, "fallback"),
        );
        for (count, what) in [
            (*lost, "time tracking or planning went back to local for late data or silence"),
            (tally.errors, "cycle with invalid local input"),
            (*unreadable, "file that could not be read or written"),
            (*pictures, "picture"),
        ] {
            if count > 0 {
                text.push_str("; ");
                text.push_str(&counted(count, what));
            }
        }
        text
    }
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
    let _ = writeln!(err, "mufasa: {message}");
}

/// A bar over so many cycles.
pub fn progress(cycles: usize) -> ProgressBar {
    let steps = u64::try_from(cycles).unwrap_or(u64::MAX);
    crate::progress::bar(steps, "{bar:40} {pos}/{len} cycles, {left} left")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_worst_finding_decides_the_exit_code() {
        let mut findings = Findings::default();
        assert_eq!(findings.exit_code(), 0);
        (findings.tally.cycles, findings.tally.safe) = (3, 2);
        assert_eq!(findings.exit_code(), 1);
        (findings.tally.safe, findings.lost) = (3, 1);
        assert_eq!(findings.exit_code(), 1);
        findings.unreadable = 1;
        assert_eq!(findings.exit_code(), 2);
        findings.unreadable = 0;
        (findings.tally.errors, findings.tally.cycles) = (1, 4);
        assert_eq!(findings.exit_code(), 2);
        findings.disagreements = 1;
        assert_eq!(findings.exit_code(), 3);
    }

    #[test]
    fn the_summary_counts() {
        let findings = Findings { drives: 1, unreadable: 2, ..Findings::default() };
        let text = findings.summary();
        assert!(
            text.starts_with("1 drive, 0 cycles: 0 safe, 0 unsafe, 0 fallbacks, 0 offloaded; "),
            "{text}"
        );
        assert!(text.ends_with("offloaded; 2 files that could not be read or written"), "{text}");
    }
}
