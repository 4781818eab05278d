//! The line protocol of `mufasa oracle` (`spec/5-interfaces.md#programs-under-test`).

pub mod implementation;

use std::io::{self, BufRead, Write};

use serde_json::Value;

use mufasa_records::answer::Answer;
use mufasa_records::lines::{self, Length, read_line};
use mufasa_records::{self as json};

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
            Length::TooLong => {
                serde_json::to_string(&Answer::Error(lines::too_long(number).into()))?
            }
        };
        output.write_all(answer.as_bytes())?;
        output.write_all(b"\n")?;
        output.flush()?;
    }
    Ok(())
}
