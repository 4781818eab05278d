//! Records on one line, without the newline (`spec/5-interfaces.md`).

use std::io::{self, Write};

use mufasa_model::input::cycle::Cycle;
use mufasa_model::services::orchestrator::Task;
use serde::Serialize;
use serde_json::Serializer;
use serde_json::ser::Formatter;

use crate::record::monitor::Sequence;
use crate::record::offloading::Trace;
use crate::record::{Recorded, composition, cycle, monitor, offloading};

/// The record of a cycle. Doubles are shortest decimals that read back to themselves, or `"nan"`,
/// `"inf"`, `"-inf"`; parameters at their default are left out. Reading the line gives the same
/// cycle again, bit for bit except for the payload of NaN.
pub fn cycle_to_line(id: &str, cycle: &Cycle) -> String {
    line(&cycle::Cycle { id: id.to_owned(), ..Recorded::of_model(cycle) })
}

/// The record of a trace; parameters at their default are left out.
pub fn trace_to_line(id: &str, trace: &Trace) -> String {
    line(&offloading::Offloading { id: id.to_owned(), ..Recorded::of_model(trace) })
}

/// The record of a task.
pub fn task_to_line(id: &str, task: &Task) -> String {
    line(&composition::Composition { id: id.to_owned(), ..Recorded::of_model(task) })
}

/// The record of a sequence; parameters at their default are left out.
pub fn sequence_to_line(id: &str, sequence: &Sequence) -> String {
    line(&monitor::Monitor { id: id.to_owned(), ..Recorded::of_model(sequence) })
}

fn line(record: &impl Serialize) -> String {
    let mut text = Vec::new();
    // Memory can be written, and no key of a record is anything but a string.
    let _ = record.serialize(&mut Serializer::with_formatter(&mut text, OneLine));
    String::from_utf8(text).unwrap_or_default()
}

/// JSON on one line with spaces after commas and colons, and doubles without `.0`.
struct OneLine;

impl Formatter for OneLine {
    fn write_f64<W: Write + ?Sized>(&mut self, out: &mut W, value: f64) -> io::Result<()> {
        // `Debug` changes to exponents where `Display` would write hundreds of digits.
        let shortest = format!("{value:?}");
        out.write_all(shortest.strip_suffix(".0").unwrap_or(&shortest).as_bytes())
    }

    fn begin_array_value<W: Write + ?Sized>(&mut self, out: &mut W, first: bool) -> io::Result<()> {
        out.write_all(if first { b"" } else { b", " })
    }

    fn begin_object_key<W: Write + ?Sized>(&mut self, out: &mut W, first: bool) -> io::Result<()> {
        out.write_all(if first { b"" } else { b", " })
    }

    fn begin_object_value<W: Write + ?Sized>(&mut self, out: &mut W) -> io::Result<()> {
        out.write_all(b": ")
    }
}
