//! Threads that read and write the pipes of the program under test.

use std::io::{BufRead, BufReader, Read, Write};
use std::process::ChildStdin;
use std::sync::mpsc::{Receiver, SyncSender};
use std::sync::{Mutex, PoisonError};

/// Longest answer that is read; traces of thousands of events take a few MB.
pub const MAX_ANSWER_BYTES: usize = 16 << 20;

/// What is kept of the program's last words on standard error.
const STDERR_BYTES: usize = 2000;

/// What comes from the program.
#[derive(Debug)]
pub enum Heard {
    /// A line, without its end.
    Line(Vec<u8>),
    /// One that is longer than any answer.
    TooLong,
    /// No more.
    End,
}

/// Reads lines until the end.
pub fn read(output: impl Read, say: &SyncSender<Heard>) {
    let mut output = BufReader::new(output);
    loop {
        let mut line = Vec::new();
        let limit = MAX_ANSWER_BYTES as u64 + 1;
        let heard = match output.by_ref().take(limit).read_until(b'\n', &mut line) {
            Ok(0) | Err(_) => Heard::End,
            Ok(_) if line.len() > MAX_ANSWER_BYTES => Heard::TooLong,
            Ok(_) => {
                if line.last() == Some(&b'\n') {
                    line.pop();
                }
                Heard::Line(line)
            }
        };
        let is_line = matches!(heard, Heard::Line(_));
        if say.send(heard).is_err() || !is_line {
            return;
        }
    }
}

/// Writes the lines that come.
pub fn write(mut input: ChildStdin, lines: &Receiver<Vec<u8>>) {
    while let Ok(line) = lines.recv() {
        if input.write_all(&line).and_then(|()| input.flush()).is_err() {
            return;
        }
    }
}

/// Keeps the end of what comes.
pub fn keep_last(mut errors: impl Read, kept: &Mutex<Vec<u8>>) {
    let mut chunk = [0; 1024];
    while let Ok(count) = errors.read(&mut chunk) {
        if count == 0 {
            return;
        }
        let mut kept = kept.lock().unwrap_or_else(PoisonError::into_inner);
        kept.extend_from_slice(&chunk[..count]);
        let surplus = kept.len().saturating_sub(STDERR_BYTES);
        kept.drain(..surplus);
    }
}
