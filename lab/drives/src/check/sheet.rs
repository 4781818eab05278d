//! What is written of a drive, kept until its turn comes: a little in memory, more in a temporary file.

use std::io::{self, BufRead, BufReader, Read, Seek, Write};

use tempfile::{SpooledTempFile, spooled_tempfile};

use crate::temporary::{lost, unkept};

/// Bytes that are kept in memory.
const IN_MEMORY: usize = 1 << 16;

/// Lines that are written one by one and read once.
pub(super) struct Sheet(SpooledTempFile);

impl Default for Sheet {
    fn default() -> Self {
        Self(spooled_tempfile(IN_MEMORY))
    }
}

impl Sheet {
    /// Writes a line. Errors: there is no place for it.
    pub(super) fn line(&mut self, text: &str) -> io::Result<()> {
        let written = self.0.write_all(text.as_bytes()).and_then(|()| self.0.write_all(b"\n"));
        written.map_err(|error| io::Error::new(error.kind(), unkept(&error)))
    }

    /// Copies all lines. Errors: they cannot be read again, or not be written.
    pub(super) fn copy(&mut self, out: &mut impl Write) -> io::Result<()> {
        io::copy(&mut self.again()?, out).map(|_| ())
    }

    /// The lines. Errors: they cannot be read again.
    pub(super) fn lines(&mut self) -> io::Result<impl Iterator<Item = io::Result<String>>> {
        Ok(self.again()?.lines())
    }

    fn again(&mut self) -> io::Result<impl BufRead> {
        self.0.rewind().map_err(|error| gone(&error))?;
        Ok(BufReader::new(Again(&mut self.0)))
    }
}

/// Reads, and says of errors what they mean.
struct Again<'a>(&'a mut SpooledTempFile);

impl Read for Again<'_> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        self.0.read(buffer).map_err(|error| gone(&error))
    }
}

fn gone(error: &io::Error) -> io::Error {
    io::Error::new(error.kind(), lost(error))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_come_back_from_memory_and_from_the_disk() {
        for count in [0, 3, 30_000] {
            let mut sheet = Sheet::default();
            let lines: Vec<_> = (0..count).map(|i| format!("line {i}")).collect();
            lines.iter().for_each(|line| sheet.line(line).unwrap());
            assert_eq!(sheet.0.is_rolled(), count > 3);
            let read: io::Result<Vec<_>> = sheet.lines().unwrap().collect();
            assert_eq!(read.unwrap(), lines);
            let mut copy = Vec::new();
            sheet.copy(&mut copy).unwrap();
            assert_eq!(copy.lines().count(), count);
        }
    }
}
