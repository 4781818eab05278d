//! `spec/5-interfaces.md#programs-under-test`: one answer per line, in order, at once.

use std::io::{self, BufReader, Cursor, Read, Write};
use std::sync::mpsc;

use mufasa_conform::reference as oracle;
use mufasa_records::lines::MAX_LINE_BYTES;
use serde_json::Value;

use crate::oracle::common::{COMPOSITION, CYCLE, TRACE, answers};

#[test]
fn an_empty_input_has_no_answer() {
    assert!(answers(b"").is_empty());
}

/// CYCLE-07, CYCLE-08
#[test]
fn every_line_is_answered_in_order_and_errors_name_their_line() {
    let answers = answers(format!("{CYCLE}\nnothing\n{TRACE}\r\n\n{COMPOSITION}\n").as_bytes());
    let ids: Vec<&Value> = answers.iter().map(|answer| &answer["id"]).collect();
    assert_eq!(ids, ["c".into(), Value::Null, "o".into(), Value::Null, "s".into()].each_ref());
    for (index, line) in [(1, 2), (3, 4)] {
        assert_eq!(answers[index]["error"]["line"], line);
        let message = answers[index]["error"]["message"].as_str().unwrap();
        assert!(message.starts_with(&format!("line {line}: ")), "{message}");
    }
}

#[test]
fn the_last_line_may_lack_its_newline() {
    assert_eq!(answers(CYCLE.as_bytes()).len(), 1);
    assert_eq!(answers(format!("{CYCLE}\n").as_bytes()).len(), 1);
    assert_eq!(answers(format!("{CYCLE}\n\n").as_bytes()).len(), 2);
}

#[test]
fn bytes_that_are_not_utf_8_are_an_error() {
    let answers = answers(b"\xff\xfe\n{\"id\": \"\xc3\"}\n\0\n");
    assert_eq!(answers.len(), 3);
    assert!(answers.iter().all(|answer| answer["verdict"] == "error" && answer["id"].is_null()));
}

#[test]
fn deep_nesting_is_an_error() {
    for open in ["[", "{\"a\":", "{\"kind\": \"cycle\", \"id\": \"deep\", \"ego\": ["] {
        let deep = open.repeat(300_000);
        let closed = format!("{}{}", "[".repeat(1_000_000), "]".repeat(1_000_000));
        let field = format!(
            "{{\"kind\": \"composition\", \"id\": \"deep\", \"services\": {closed}, \"goal\": \"x\"}}"
        );
        let answers = answers(format!("{deep}\n{closed}\n{field}").as_bytes());
        assert_eq!(answers.len(), 3);
        assert!(answers.iter().all(|answer| answer["verdict"] == "error"));
        assert_eq!(answers[2]["id"], "deep");
        assert_eq!(answers[2]["error"]["field"], "services");
    }
}

#[test]
fn a_line_beyond_the_limit_is_an_error_and_the_next_one_is_answered() {
    let limit = u64::try_from(MAX_LINE_BYTES).unwrap();
    let long = io::repeat(b' ').take(limit + 1).chain(Cursor::new(format!("\n{CYCLE}\n")));
    let longest = io::repeat(b' ').take(limit - 1).chain(Cursor::new("x\n"));
    let mut output = Vec::new();
    oracle::run(BufReader::new(long.chain(longest)), &mut output, oracle::by_model).unwrap();
    let lines: Vec<Value> = String::from_utf8(output)
        .unwrap()
        .lines()
        .map(|line| serde_json::from_str(line).unwrap())
        .collect();
    assert_eq!(lines.len(), 3);
    assert!(lines[0]["error"]["message"].as_str().unwrap().contains("longer than"));
    assert_eq!(lines[1]["id"], "c");
    // A line at the limit is read: it fails for what is in it.
    assert!(lines[2]["error"]["message"].as_str().unwrap().contains("JSON"));
    assert_eq!(lines[2]["error"]["line"], 3);
}

/// A client that waits for each answer before it writes the next line.
#[test]
fn each_answer_is_flushed_before_the_next_line_is_read() {
    struct Client {
        lines: Vec<&'static str>,
        answered: mpsc::Receiver<()>,
        open: bool,
    }
    impl Read for Client {
        fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
            if self.open {
                // Nothing has been flushed: a client would wait for ever.
                self.answered.try_recv().map_err(|_| io::Error::other("no answer came"))?;
            }
            self.open = true;
            let Some(line) = self.lines.pop() else { return Ok(0) };
            buffer[..line.len()].copy_from_slice(line.as_bytes());
            Ok(line.len())
        }
    }
    struct Flushed(mpsc::Sender<()>, usize);
    impl Write for Flushed {
        fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
            self.1 += bytes.len();
            Ok(bytes.len())
        }
        fn flush(&mut self) -> io::Result<()> {
            assert!(self.1 > 0);
            self.0.send(()).map_err(io::Error::other)
        }
    }
    let (sender, answered) = mpsc::channel();
    let client = Client { lines: vec!["1\n", "2\n", "{}\n"], answered, open: false };
    oracle::run(BufReader::new(client), Flushed(sender, 0), oracle::by_model).unwrap();
}

#[test]
fn an_output_that_cannot_be_written_ends_the_program_with_its_error() {
    struct Closed;
    impl Write for Closed {
        fn write(&mut self, _: &[u8]) -> io::Result<usize> {
            Err(io::ErrorKind::BrokenPipe.into())
        }
        fn flush(&mut self) -> io::Result<()> {
            Ok(())
        }
    }
    let error = oracle::run(&b"{}\n"[..], Closed, oracle::by_model).unwrap_err();
    assert_eq!(error.kind(), io::ErrorKind::BrokenPipe);
}
