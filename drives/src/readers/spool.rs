//! Lines that are needed again, kept outside of memory: of a pipe and of a packed file they come once.

use std::env;
use std::fs::File;
use std::io::{self, Read, Seek, SeekFrom, Write};
use std::sync::{Mutex, PoisonError};

/// A temporary file of lines, which nobody else sees and which is gone with the process. There is none before the first
/// line.
#[derive(Default)]
pub(crate) struct Spool(Mutex<Option<Kept>>);

struct Kept {
    file: File,
    length: u64,
}

/// Where a line is.
#[derive(Clone, Copy)]
pub(crate) struct Place {
    start: u64,
    length: usize,
}

impl Spool {
    /// Keeps a line. Errors: there is no place for it.
    pub(crate) fn keep(&self, line: &[u8]) -> io::Result<Place> {
        let mut kept = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let Kept { file, length } = match &mut *kept {
            Some(kept) => kept,
            none => none.insert(Kept { file: tempfile::tempfile()?, length: 0 }),
        };
        let place = Place { start: *length, length: line.len() };
        file.seek(SeekFrom::Start(place.start))?;
        file.write_all(line)?;
        *length += line.len() as u64;
        Ok(place)
    }

    /// A line that was kept. Errors: the disk fails.
    pub(crate) fn line(&self, place: Place) -> io::Result<Vec<u8>> {
        let mut kept = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let Some(Kept { file, .. }) = &mut *kept else {
            return Err(io::ErrorKind::NotFound.into());
        };
        let mut line = vec![0; place.length];
        file.seek(SeekFrom::Start(place.start))?;
        file.read_exact(&mut line)?;
        Ok(line)
    }

    /// What is said where lines cannot be kept.
    pub(crate) fn refusal(error: &io::Error) -> String {
        let folder = env::temp_dir();
        format!(
            "its lines cannot be kept in {} while they are needed: {error}; name a folder with more \
             place by TMPDIR",
            folder.display()
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_come_back_in_any_order() {
        let spool = Spool::default();
        let places = ["one", "", "three"].map(|line| spool.keep(line.as_bytes()).unwrap());
        let again = |i: usize| String::from_utf8(spool.line(places[i]).unwrap()).unwrap();
        assert_eq!([2, 0, 1, 2].map(again), ["three", "one", "", "three"]);
        let last = spool.keep(b"four").unwrap();
        assert_eq!(spool.line(last).unwrap(), b"four");
    }
}
