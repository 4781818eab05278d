//! Lines that are needed again, kept outside of memory where they are many: of a pipe and of a packed file they come
//! once, and what is written of a drive waits for its turn.

use std::env;
use std::fmt::Display;
use std::io::{self, Read, Seek, SeekFrom, Write};
use std::sync::{Mutex, MutexGuard, PoisonError};

use tempfile::{SpooledTempFile, spooled_tempfile};

/// Bytes of lines that are kept in memory.
const IN_MEMORY: usize = 1 << 16;

/// Lines in memory, or in a temporary file, which nobody else sees and which is gone with the process; and their
/// places.
pub(crate) struct Spool(Mutex<Kept>);

struct Kept {
    lines: SpooledTempFile,
    /// Bytes of the lines.
    length: u64,
    places: Vec<Place>,
}

struct Place {
    number: usize,
    start: u64,
    length: usize,
}

impl Default for Spool {
    fn default() -> Self {
        let lines = spooled_tempfile(IN_MEMORY);
        Self(Mutex::new(Kept { lines, length: 0, places: Vec::new() }))
    }
}

impl Spool {
    /// How many lines are kept.
    pub(crate) fn count(&self) -> usize {
        self.kept().places.len()
    }

    /// Keeps a line and its number. Errors: there is no place for it.
    pub(crate) fn keep(&self, number: usize, line: &[u8]) -> io::Result<()> {
        let mut kept = self.kept();
        let Kept { lines, length: start, places } = &mut *kept;
        let written = lines.seek(SeekFrom::Start(*start)).and_then(|_| lines.write_all(line));
        written.map_err(|error| told("kept", &error))?;
        places.push(Place { number, start: *start, length: line.len() });
        *start += line.len() as u64;
        Ok(())
    }

    /// The line kept as that one, from 0, and its number. Errors: the disk fails, or there is no such line.
    pub(crate) fn line(&self, index: usize) -> io::Result<(usize, Vec<u8>)> {
        let mut kept = self.kept();
        let Kept { lines, places, .. } = &mut *kept;
        let Some(Place { number, start, length }) = places.get(index) else {
            return Err(Self::lost(&"there is no such line"));
        };
        let mut line = vec![0; *length];
        let read = lines.seek(SeekFrom::Start(*start)).and_then(|_| lines.read_exact(&mut line));
        read.map(|()| (*number, line)).map_err(|error| Self::lost(&error))
    }

    /// All lines, each with its end. Errors: as of [`Self::line`], or of writing.
    pub(crate) fn copy(&self, out: &mut impl Write) -> io::Result<()> {
        (0..self.count()).try_for_each(|index| {
            let (_, line) = self.line(index)?;
            out.write_all(&line).and_then(|()| out.write_all(b"\n"))
        })
    }

    /// What is said where a line that was kept is gone.
    pub(crate) fn lost(why: &impl Display) -> io::Error {
        told("read again", why)
    }

    fn kept(&self) -> MutexGuard<'_, Kept> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Loses what is kept, as a disk may.
    #[cfg(test)]
    pub(crate) fn empty(&self) {
        self.kept().lines.set_len(0).unwrap();
    }
}

fn told(what: &str, why: &impl Display) -> io::Error {
    let folder = env::temp_dir();
    let folder = folder.display();
    io::Error::other(format!(
        "lines that are needed again cannot be {what} in {folder}: {why}; name another folder by TMPDIR"
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_come_back_in_any_order_from_memory_and_from_the_disk() {
        for count in [3, 30_000] {
            let spool = Spool::default();
            assert!(spool.line(0).is_err());
            let line = |at: usize| format!("line {at}").repeat(at % 3);
            (0..count).for_each(|at| spool.keep(2 * at, line(at).as_bytes()).unwrap());
            assert_eq!(spool.kept().lines.is_rolled(), count > 3);
            for at in [2, 0, 1, count - 1] {
                assert_eq!(spool.line(at).unwrap(), (2 * at, line(at).into_bytes()));
            }
            assert!(spool.line(count).is_err());
            let mut copy = Vec::new();
            spool.copy(&mut copy).unwrap();
            let copy = String::from_utf8(copy).unwrap();
            assert!(copy.lines().eq((0..count).map(line)));
        }
    }
}
