//! Cycles as JSON Lines, read one at a time: what is in memory does not grow with their number.

use std::io::{self, BufRead};
use std::path::Path;
use std::sync::Arc;

use mufasa_records::lines::{Length, read_line, too_long};
use mufasa_records::{LineError, cycle_from_line};
use serde_json::Value;

use crate::counted;
use crate::drive::{DriveCycle, Stream};
use crate::options::{Options, Sensor};
use crate::readers::error::ReadError;
use crate::readers::source::stem;
use crate::spool::Spool;

/// Most bytes of a file without cycles that are looked at for being one document.
const DOCUMENT: usize = 16 << 20;
/// Bytes of a line that is no cycle and longer than what is looked at for being something else.
const KNOWN: usize = 1 << 20;
/// What to do with a line that is longer than any that is read.
const TOO_LONG: &str =
    "; a record of a cycle is shorter: if the line holds several, write each on a line of its own";
const MARK: &[u8] = b"\xef\xbb\xbf";

/// The cycles of JSON Lines as one drive, after the error of the lines that are none.
pub(crate) fn drive(
    path: &Path,
    text: impl BufRead,
    spool: &Arc<Spool>,
    options: &Options,
) -> Vec<Result<Stream, ReadError>> {
    let first = spool.count();
    let mut lines = Lines { path, spool, count: 0, others: 0, wrong: None, start: Vec::new() };
    if let Err(error) = lines.read(text) {
        return vec![Err(error)];
    }
    let Lines { count, others, wrong, start, .. } = lines;
    if count == 0 && is_one_document(&start) {
        let message = "one JSON document spread over lines; JSON Lines have every record on a \
                       line of its own, as `jq -c . FILE` writes it";
        return vec![Err(ReadError::file(path, message))];
    }
    let wrong = wrong.into_iter().map(Err);
    let drive = (count > 0).then(|| {
        let mut drive = stream(path, first, count, Arc::clone(spool));
        if others > 0 {
            drive.notes.push(format!("{} left out, which are no cycles", counted(others, "line")));
        }
        drive.ignores_options = *options != Options::default();
        Ok(drive)
    });
    wrong.chain(drive).collect()
}

/// What was read of a file.
struct Lines<'a> {
    path: &'a Path,
    spool: &'a Spool,
    /// Lines that are cycles.
    count: usize,
    /// Lines that are none.
    others: usize,
    wrong: Option<ReadError>,
    /// The text, while it may be one document.
    start: Vec<u8>,
}

impl Lines<'_> {
    /// Errors: the text ends early, or its lines cannot be kept.
    fn read(&mut self, mut text: impl BufRead) -> Result<(), ReadError> {
        let failed = |error: &io::Error| ReadError::file(self.path, error.to_string());
        let (mut line, mut number) = (Vec::new(), 0);
        while let Some(length) = read_line(&mut text, &mut line).map_err(|e| failed(&e))? {
            number += 1;
            if number == 1 && line.starts_with(MARK) {
                line.drain(..MARK.len());
            }
            let read = match length {
                Length::Fits => cycle_from_line(&line, number),
                Length::TooLong => {
                    let LineError { message, .. } = too_long(number);
                    Err(LineError::whole(number, message + TOO_LONG))
                }
            };
            if let Err(error) = read {
                self.is_none(error, &line);
                continue;
            }
            let kept = self.spool.keep(number, &line);
            kept.map_err(|error| failed(&error))?;
            self.count += 1;
        }
        Ok(())
    }

    /// Notes a line that is no cycle.
    fn is_none(&mut self, error: LineError, line: &[u8]) {
        self.others += 1;
        if self.count == 0 && self.start.len() + line.len() < DOCUMENT {
            self.start.extend_from_slice(line);
            self.start.push(b'\n');
        }
        let element = error.id.map_or_else(String::new, |id| format!("cycle {id}"));
        let number = u32::try_from(error.line).unwrap_or(u32::MAX);
        let message = format!("{}{}", error.message, advice(line));
        let mut read = ReadError::file(self.path, message).line(number);
        read = read.at(element, error.field);
        read.index = error.index;
        ReadError::join(&mut self.wrong, read);
    }
}

/// What to do with a line of another kind of record, or of something else that mufasa writes; empty where it is
/// neither, or too long to be one.
fn advice(line: &[u8]) -> &'static str {
    let short = line.get(..KNOWN).is_none();
    let Some(Ok(Value::Object(object))) = short.then(|| serde_json::from_slice(line)) else {
        return "";
    };
    match object.get("kind").and_then(Value::as_str) {
        Some("offloading" | "composition") => {
            "; `mufasa oracle` answers such records, here cycles are judged"
        }
        Some("checked_cycle" | "checked_drive" | "checked") => {
            "; this is what `mufasa check --json` writes, not what it reads"
        }
        None if object.contains_key("input") && object.contains_key("expect") => {
            "; a vector has its record in `input`: `jq -c .input FILE` writes the records"
        }
        Some(_) | None => "",
    }
}

/// The drive of the lines of the spool from that one on.
fn stream(path: &Path, first: usize, count: usize, spool: Arc<Spool>) -> Stream {
    let cycles = counted(count, "cycle");
    let own = "each with its own profile, configuration and parameters";
    let notes = vec![format!("{cycles} as recorded, {own}")];
    let file = path.to_owned();
    let make = move |index: usize| {
        let read = spool.line(first + index).and_then(|(number, line)| {
            cycle_from_line(&line, number).map_err(|error| Spool::lost(&error.message))
        });
        let (id, cycle) = read.map_err(|error| ReadError::file(&file, error.to_string()))?;
        Ok(DriveCycle { id, cycle })
    };
    let mut drive = Stream::fallible(stem(path), path.display().to_string(), count, make);
    (drive.lead_range_m, drive.notes) = (Sensor::default().lead_range_m, notes);
    drive
}

/// Whether a text of several lines is JSON as a whole.
fn is_one_document(text: &[u8]) -> bool {
    let is_json = |text: &[u8]| serde_json::from_slice::<serde::de::IgnoredAny>(text).is_ok();
    text.trim_ascii().contains(&b'\n') && is_json(text)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_of_something_else_that_mufasa_writes_are_told_what_they_are() {
        for (line, said) in [
            (&br#"{"kind": "offloading", "id": "o"}"#[..], "`mufasa oracle` answers"),
            (br#"{"kind": "composition", "id": "s"}"#, "`mufasa oracle` answers"),
            (br#"{"id": "v", "input": {}, "expect": {}}"#, "`jq -c .input FILE`"),
            (br#"{"kind": "checked", "drives": 1}"#, "what `mufasa check --json` writes"),
            (br#"{"kind": "other"}"#, "kind must be cycle"),
            (br#"{"input": {}}"#, "kind is missing"),
        ] {
            let mut drives = drive(Path::new("f"), line, &Arc::default(), &Options::default());
            let error = drives.remove(0).unwrap_err().to_string();
            assert!(error.contains(said), "{error}");
            assert_eq!(said.contains('`'), error.contains('`'), "{error}");
        }
    }

    /// As where the disk fails, or somebody empties the file, between reading and judging.
    #[test]
    fn a_line_that_cannot_be_read_again_is_an_error_of_its_file() {
        let line = b"{\"kind\": \"cycle\", \"id\": \"c\", \"now_ns\": 0, \"configuration\": \"Local\", \
            \"ego\": {\"x\": 0, \"y\": 0, \"cos\": 1, \"sin\": 0, \"speed\": 0, \"length\": 4, \"width\": 2, \
            \"center_offset\": 0}, \"route\": {\"closed\": false, \"stations\": []}}\n";
        let spool = Arc::new(Spool::default());
        let mut drives =
            drive(Path::new("c.jsonl"), &line.repeat(2)[..], &spool, &Options::default());
        let drive = drives.remove(0).unwrap();
        assert!(drive.cycle(1).is_ok());
        spool.empty();
        let error = drive.cycle(1).unwrap_err().to_string();
        assert!(
            error.starts_with("c.jsonl: ") && error.contains("cannot be read again"),
            "{error}"
        );
        assert!(error.contains("TMPDIR"), "{error}");
        assert!(drive.collect().is_err());
    }
}
