//! The line protocol of `mufasa oracle` (`spec/5-interfaces.md#programs-under-test`).

use std::io::{self, BufRead, ErrorKind, Write};

use crate::json::answer::Answer;
use crate::json::{self, LineError};

/// Longest line that is read; the largest grid takes about 6 MB.
pub const MAX_LINE_BYTES: usize = 64 << 20;

/// Answers every line of `input` on one line of `output`, in order, each as soon as it is decided,
/// until the end of the input. Errors are those of reading and writing alone; a line that is no
/// record is answered.
pub fn run(mut input: impl BufRead, mut output: impl Write) -> io::Result<()> {
    let mut line = Vec::new();
    let mut number = 0;
    while let Some(length) = read_line(&mut input, &mut line)? {
        number += 1;
        let answer = match length {
            Length::Fits => json::answer(&line, number),
            Length::TooLong => Answer::Error(
                LineError::whole(number, format!("is longer than {MAX_LINE_BYTES} bytes")).into(),
            ),
        };
        serde_json::to_writer(&mut output, &answer)?;
        output.write_all(b"\n")?;
        output.flush()?;
    }
    Ok(())
}

enum Length {
    Fits,
    TooLong,
}

/// Reads a line without its newline; what is beyond the limit is read over. `None` at the end.
fn read_line(input: &mut impl BufRead, line: &mut Vec<u8>) -> io::Result<Option<Length>> {
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
        } else if matches!(length, Length::Fits) {
            line.extend_from_slice(part);
        }
        let used = end.map_or(chunk.len(), |end| end + 1);
        input.consume(used);
        if end.is_some() {
            return Ok(Some(length));
        }
    }
}
