//! The line protocol of `mufasa oracle` (`spec/5-interfaces.md#programs-under-test`).

pub mod implementation;

use std::io::{self, BufRead, ErrorKind, Write};

use serde_json::Value;

use mufasa_records::answer::Answer;
use mufasa_records::{self as json, LineError};

/// Longest line that is read; the largest grid takes about 6 MB.
pub const MAX_LINE_BYTES: usize = 64 << 20;

/// The answer to a line, given without its newline, and its number from 1.
pub type Answering = fn(&[u8], usize) -> serde_json::Result<String>;

/// Answers with the exact model. Errors: none, as answers always become JSON.
pub fn by_model(line: &[u8], number: usize) -> serde_json::Result<String> {
    serde_json::to_string(&json::answer(line, number))
}

/// Answers with the implementation. Errors: none, as answers always become JSON.
pub fn by_implementation(line: &[u8], number: usize) -> serde_json::Result<String> {
    let answer: Value = implementation::answer(line, number);
    serde_json::to_string(&answer)
}

/// Answers every line of `input` on one line of `output`, in order, each as soon as it is decided,
/// until the end of the input. Errors are those of reading and writing alone; a line that is no
/// record is answered.
pub fn run(mut input: impl BufRead, mut output: impl Write, answer: Answering) -> io::Result<()> {
    let mut line = Vec::new();
    let mut number = 0;
    while let Some(length) = read_line(&mut input, &mut line)? {
        number += 1;
        let answer = match length {
            Length::Fits => answer(&line, number)?,
            Length::TooLong => serde_json::to_string(&Answer::Error(
                LineError::whole(number, format!("is longer than {MAX_LINE_BYTES} bytes")).into(),
            ))?,
        };
        output.write_all(answer.as_bytes())?;
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
