//! Lines that are needed again, kept outside of memory: of a pipe and of a packed file they come once.

use std::fs::File;
use std::io::{self, Read, Seek, SeekFrom, Write};
use std::sync::{Mutex, MutexGuard, PoisonError};

/// Temporary files of lines and of their places, which nobody else sees and which are gone with the process. There
/// are none before the first line.
#[derive(Default)]
pub(crate) struct Spool(Mutex<Option<Kept>>);

struct Kept {
    lines: File,
    /// Bytes of the lines.
    length: u64,
    /// Of each line number, begin and length, 8 bytes each.
    places: File,
    count: u64,
}

/// Bytes of a place.
const PLACE: usize = 24;

impl Spool {
    /// How many lines are kept.
    pub(crate) fn count(&self) -> u64 {
        self.kept().as_ref().map_or(0, |kept| kept.count)
    }

    /// Keeps a line and its number. Errors: there is no place for it.
    pub(crate) fn keep(&self, number: usize, line: &[u8]) -> io::Result<()> {
        let mut kept = self.kept();
        let Kept { lines, length, places, count } = match &mut *kept {
            Some(kept) => kept,
            none => {
                let [lines, places] = [tempfile::tempfile()?, tempfile::tempfile()?];
                none.insert(Kept { lines, length: 0, places, count: 0 })
            }
        };
        lines.seek(SeekFrom::Start(*length))?;
        lines.write_all(line)?;
        let place = [number as u64, *length, line.len() as u64].map(u64::to_le_bytes);
        places.seek(SeekFrom::Start(*count * PLACE as u64))?;
        places.write_all(place.as_flattened())?;
        *length += line.len() as u64;
        *count += 1;
        Ok(())
    }

    /// The line kept as that one, from 0, and its number. Errors: the disk fails.
    pub(crate) fn line(&self, index: u64) -> io::Result<(usize, Vec<u8>)> {
        let mut kept = self.kept();
        let Some(Kept { lines, places, .. }) = &mut *kept else {
            return Err(io::ErrorKind::NotFound.into());
        };
        let mut place = [[0; 8]; PLACE / 8];
        places.seek(SeekFrom::Start(index * PLACE as u64))?;
        places.read_exact(place.as_flattened_mut())?;
        let [number, start, length] = place.map(u64::from_le_bytes);
        let size = |it| usize::try_from(it).map_err(io::Error::other);
        let mut line = vec![0; size(length)?];
        lines.seek(SeekFrom::Start(start))?;
        lines.read_exact(&mut line)?;
        Ok((size(number)?, line))
    }

    fn kept(&self) -> MutexGuard<'_, Option<Kept>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Loses what is kept, as a disk may.
    #[cfg(test)]
    pub(crate) fn empty(&self) {
        for kept in self.kept().iter() {
            kept.lines.set_len(0).unwrap();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_come_back_in_any_order() {
        let spool = Spool::default();
        assert!(spool.line(0).is_err());
        for (number, line) in [(1, "one"), (2, ""), (7, "three")] {
            spool.keep(number, line.as_bytes()).unwrap();
        }
        let again = |index: u64| {
            let (number, line) = spool.line(index).unwrap();
            (number, String::from_utf8(line).unwrap())
        };
        let expected = [(7, "three"), (1, "one"), (2, ""), (7, "three")];
        assert_eq!([2, 0, 1, 2].map(again), expected.map(|(n, line)| (n, line.to_owned())));
        spool.keep(9, b"four").unwrap();
        assert_eq!((spool.line(3).unwrap(), spool.count()), ((9, b"four".to_vec()), 4));
        assert!(spool.line(4).is_err());
    }
}
