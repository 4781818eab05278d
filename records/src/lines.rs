//! Lines of an input of any length, one in memory at a time.

use std::io::{self, BufRead, ErrorKind};

use crate::LineError;

/// Longest line that is read; the largest grid takes about 6 MB.
pub const MAX_LINE_BYTES: usize = 64 << 20;

/// Whether a line was read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Length {
    /// It was.
    Fits,
    /// It is longer than [`MAX_LINE_BYTES`], and was passed over.
    TooLong,
}

/// Reads a line without its newline; one beyond the limit is passed over, and `line` is empty then. `None` at the
/// end. Errors are those of reading.
pub fn read_line(input: &mut impl BufRead, line: &mut Vec<u8>) -> io::Result<Option<Length>> {
    line.clear();
    let (mut any, mut length) = (false, Length::Fits);
    loop {
        let chunk = match input.fill_buf() {
            Err(error) if error.kind() == ErrorKind::Interrupted => continue,
            chunk => chunk?,
        };
        if chunk.is_empty() {
            return Ok(any.then_some(length));
        }
        any = true;
        let end = chunk.iter().position(|byte| *byte == b'\n');
        let part = &chunk[..end.unwrap_or(chunk.len())];
        if line.len() + part.len() > MAX_LINE_BYTES {
            length = Length::TooLong;
            *line = Vec::new();
        } else if length == Length::Fits {
            line.extend_from_slice(part);
        }
        let used = end.map_or(chunk.len(), |end| end + 1);
        input.consume(used);
        if end.is_some() {
            return Ok(Some(length));
        }
    }
}

/// What is said of line number `number` (from 1) when it is too long.
pub fn too_long(number: usize) -> LineError {
    LineError::whole(number, format!("is longer than {MAX_LINE_BYTES} bytes"))
}
