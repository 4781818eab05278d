//! Cycles as JSON Lines, read one at a time: what is in memory does not grow with their number but for
//! their places.

use std::io::{self, BufRead};
use std::path::Path;
use std::sync::Arc;

use mufasa_records::lines::{Length, read_line, too_long};
use mufasa_records::{LineError, cycle_from_line};

use crate::counted;
use crate::drive::{DriveCycle, Stream};
use crate::options::Sensor;
use crate::readers::error::ReadError;
use crate::readers::source::stem;
use crate::readers::spool::{Place, Spool};

/// Most bytes of a file without cycles that are looked at for being one document.
const DOCUMENT: usize = 16 << 20;
const MARK: &[u8] = b"\xef\xbb\xbf";

/// The cycles of JSON Lines as one drive, after the error of the lines that are none.
pub(crate) fn drive(
    path: &Path,
    text: impl BufRead,
    spool: &Arc<Spool>,
) -> Vec<Result<Stream, ReadError>> {
    let mut lines = Lines { path, spool, places: Vec::new(), wrong: None, start: Vec::new() };
    if let Err(error) = lines.read(text) {
        return vec![Err(error)];
    }
    let Lines { places, wrong, start, .. } = lines;
    if places.is_empty() && is_one_document(&start) {
        let message = "one JSON document spread over lines; JSON Lines have every record on a \
                       line of its own, as `jq -c . FILE` writes it";
        return vec![Err(ReadError::file(path, message))];
    }
    let wrong = wrong.into_iter().map(Err);
    let drive = (!places.is_empty()).then(|| Ok(stream(path, places, Arc::clone(spool))));
    wrong.chain(drive).collect()
}

/// What was read of a file.
struct Lines<'a> {
    path: &'a Path,
    spool: &'a Spool,
    /// Numbers and places of the lines that are cycles.
    places: Vec<(usize, Place)>,
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
                Length::TooLong => Err(too_long(number)),
            };
            if let Err(error) = read {
                self.is_none(error, &line);
                continue;
            }
            let kept = self.spool.keep(&line);
            let place = kept.map_err(|e| ReadError::file(self.path, Spool::refusal(&e)))?;
            self.places.push((number, place));
        }
        Ok(())
    }

    /// Notes a line that is no cycle.
    fn is_none(&mut self, error: LineError, line: &[u8]) {
        if self.places.is_empty() && self.start.len() + line.len() < DOCUMENT {
            self.start.extend_from_slice(line);
            self.start.push(b'\n');
        }
        let element = error.id.map_or_else(String::new, |id| format!("cycle {id}"));
        let number = u32::try_from(error.line).unwrap_or(u32::MAX);
        let mut read = ReadError::file(self.path, error.message).line(number);
        read = read.at(element, error.field);
        read.index = error.index;
        ReadError::join(&mut self.wrong, read);
    }
}

fn stream(path: &Path, places: Vec<(usize, Place)>, spool: Arc<Spool>) -> Stream {
    let notes = vec![format!("{} as recorded", counted(places.len(), "cycle"))];
    let count = places.len();
    let make = move |index: usize| {
        let (number, place) = places[index];
        let line = spool.line(place).unwrap_or_else(|error| panic!("{}", Spool::refusal(&error)));
        match cycle_from_line(&line, number) {
            Ok((id, cycle)) => DriveCycle { id, cycle },
            Err(error) => unreachable!("line {number} was a cycle: {}", error.message),
        }
    };
    let mut drive = Stream::new(stem(path), path.display().to_string(), count, make);
    (drive.lead_range_m, drive.notes) = (Sensor::default().lead_range_m, notes);
    drive
}

/// Whether a text of several lines is JSON as a whole.
fn is_one_document(text: &[u8]) -> bool {
    let is_json = |text: &[u8]| serde_json::from_slice::<serde::de::IgnoredAny>(text).is_ok();
    text.trim_ascii().contains(&b'\n') && is_json(text)
}
