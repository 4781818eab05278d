//! The vectors that people wrote: `lab/conform/data/vectors`, one file per file of vectors.
//!
//! Each has a name, the requirement it is about, a note, an input and what its author expects from
//! the text of `spec/`, before the model is asked:
//!
//! * `cycle`: what differs from `base.json`, by pointer (RFC 6901). Fields of points and objects
//!   may be left out ([`DEFAULTS`]), [`Shape`] abbreviates long lists;
//! * `trace` and `task`: records without kind and id; `sequence`: one of the monitor, see `sequences.rs`;
//! * `replace`: a part of the written cycle, and what stands there instead so that it is refused;
//! * `line`: a text, or one of `records/` with `old` replaced by `new`;
//! * `edge`: the number for which `"?"` stands in the cycle is put on both sides of this threshold.

use std::borrow::Cow;
use std::collections::BTreeMap;
use std::fmt::Display;

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use mufasa_records::{self as json, Record};
use serde::de::Error as _;
use serde::{Deserialize, Deserializer};
use serde_json::value::{RawValue, to_raw_value};
use serde_json::{Value, from_str};

use crate::vectors::book::{Asked, Book, Topic};
use crate::vectors::expected::Expected;
use crate::vectors::sequences;

/// The vectors, by the name of the file that they are published in.
const FILES: &[(&str, &str)] = include!(concat!(env!("OUT_DIR"), "/authored.rs"));

/// The cycle of which a vector changes something: a straight road along x, 3 m to each side; the CAV
/// of 4 m by 2 m at the origin, 10 m/s; points 1 m and 0.1 s apart; a car 60 m ahead, tracked and
/// detected; a free grid of 10 m cells. Safe in every configuration of both profiles.
const BASE: &str = include_str!("../../data/vectors/base.json");

/// Records of which a line changes something.
const RECORDS: [(&str, &str); 3] = [
    ("cycle", include_str!("../../data/vectors/records/cycle.json")),
    ("offloading", include_str!("../../data/vectors/records/offloading.json")),
    ("composition", include_str!("../../data/vectors/records/composition.json")),
];

/// Fields that may be left out in lists at a pointer that ends so: an object of 4 m by 2 m that
/// stands and looks along x.
const DEFAULTS: [(&str, &str); 4] = [
    ("detections/items", r#"{"cos": 1, "sin": 0, "length": 4, "width": 2}"#),
    ("tracks/items", r#"{"cos": 1, "sin": 0, "vx": 0, "vy": 0, "length": 4, "width": 2}"#),
    ("trajectory/points", r#"{"y": 0, "cos": 1, "sin": 0}"#),
    ("", "{}"),
];

/// Time of the decision in [`BASE`], and the time from point to point, ns.
const NOW: i64 = 1_000_000_000;
const TENTH: i64 = 100_000_000;

/// How far from the threshold the outer vectors of an edge are; every margin delta is smaller.
const CLEAR: f64 = 1e-3;

type Changes<'a> = BTreeMap<String, &'a RawValue>;
type Facts = BTreeMap<String, Value>;
type Raw = Box<RawValue>;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Authored {
    name: String,
    requirement: &'static str,
    read_as: Option<&'static str>,
    note: String,
    #[serde(borrow)]
    cycle: Option<Changes<'static>>,
    replace: Option<[String; 2]>,
    #[serde(borrow)]
    trace: Option<&'static RawValue>,
    #[serde(borrow)]
    task: Option<&'static RawValue>,
    #[serde(borrow)]
    sequence: Option<&'static RawValue>,
    line: Option<Line>,
    expect: Option<Facts>,
    edge: Option<Edge>,
    accepted: Option<Facts>,
    rejected: Option<Facts>,
}

#[derive(Deserialize)]
#[serde(untagged)]
enum Line {
    Text(String),
    Changed { of: String, old: String, new: String },
}

/// A threshold: numbers above, from, up to, or below it are rejected.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Edge {
    above: Option<Exact>,
    from: Option<Exact>,
    up_to: Option<Exact>,
    below: Option<Exact>,
    clear: Option<Exact>,
}

/// A list that is not written out.
#[derive(Deserialize)]
#[serde(rename_all = "snake_case")]
enum Shape {
    /// Points along x, by default from now on, 1 m and 0.1 s apart; at most `to`.
    Straight {
        count: u32,
        step: Option<Exact>,
        from: Option<Exact>,
        to: Option<Exact>,
        start_ns: Option<i64>,
        every_ns: Option<i64>,
        y: Option<Exact>,
        cos: Option<Exact>,
        sin: Option<Exact>,
    },
    /// So many tracks side by side, id and y counted on from those of the first.
    Row(u32, Facts),
    /// Earlier lists of detections, by their age.
    Lists(Vec<Earlier>),
    /// The bitmap of a grid of this width and height with these cells (column, row) set.
    Bitmap { cells: [usize; 2], set: Vec<[usize; 2]> },
}

/// A list of the detection history.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Earlier {
    age_ns: i64,
    #[serde(default)]
    items: Vec<BTreeMap<String, Raw>>,
}

/// The double nearest to the number that is written, which `serde_json` does not promise.
#[derive(Clone, Copy)]
struct Exact(f64);

impl<'de> Deserialize<'de> for Exact {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        let text = <&RawValue>::deserialize(from)?.get();
        text.parse().map(Self).map_err(D::Error::custom)
    }
}

/// Adds all of them.
pub fn add(book: &mut Book) {
    for &(file, text) in FILES {
        let vectors: Vec<Authored> = match from_str(text) {
            Ok(vectors) => vectors,
            Err(error) => {
                book.refuse(file, &error);
                continue;
            }
        };
        for vector in vectors {
            let topic = Topic::new(file, vector.requirement, vector.read_as);
            if let Err(problem) = vector.add(book, topic) {
                book.refuse(&format!("{file} {}", vector.name), &problem);
            }
        }
    }
}

impl Authored {
    fn add(&self, book: &mut Book, topic: Topic) -> Result<(), String> {
        let Self { name, note, .. } = self;
        if let (Some(edge), Some(cycle)) = (&self.edge, &self.cycle) {
            let [accepted, rejected] =
                [&self.accepted, &self.rejected].map(|facts| expected(facts.as_ref(), 0));
            let (accepted, rejected) = (accepted?, rejected?);
            for (side, number, is_rejected) in edge.numbers()? {
                let record = changed(cycle, &format!("{number:?}")).map_err(text)?;
                let note = format!("{note} Here: {number:?}.");
                let expected = if is_rejected { &rejected } else { &accepted };
                self.record(book, topic, (&format!("{name}-{side}"), &note), &record, expected)?;
            }
            return Ok(());
        }
        let expect = self.expect.as_ref();
        if let Some(sequence) = self.sequence {
            let record = sequences::written_out(sequence.get(), BASE)?;
            let expect = expected(expect, events(&record)?)?;
            return self.record(book, topic, (name, note), &record, &expect);
        }
        match (&self.cycle, self.trace, self.task, &self.line) {
            (Some(cycle), None, None, None) => {
                let record = changed(cycle, "null").map_err(text)?;
                self.record(book, topic, (name, note), &record, &expected(expect, 0)?)
            }
            (None, Some(trace), None, None) => {
                let record = with_kind("offloading", trace);
                let expect = expected(expect, events(trace.get())?)?;
                self.record(book, topic, (name, note), &record, &expect)
            }
            (None, None, Some(task), None) => {
                let record = with_kind("composition", task);
                self.record(book, topic, (name, note), &record, &expected(expect, 0)?)
            }
            (None, None, None, Some(line)) => {
                book.add(topic, (name, note), Asked::Line(&line.text()?), &expected(expect, 0)?);
                Ok(())
            }
            _ => Err(String::from("needs one of cycle, trace, task, sequence, line")),
        }
    }

    fn record(
        &self,
        book: &mut Book,
        topic: Topic,
        (name, note): (&str, &str),
        record: &str,
        expected: &Expected,
    ) -> Result<(), String> {
        let record = json::parse(record.as_bytes(), 1).map_err(text)?;
        let asked = match (&record, &self.replace) {
            (Record::Cycle { cycle, .. }, Some([old, new])) => Asked::Broken(cycle, [old, new]),
            (Record::Cycle { cycle, .. }, None) => Asked::Cycle(cycle),
            (Record::Offloading { trace, .. }, _) => Asked::Trace(trace),
            (Record::Composition { task, .. }, _) => Asked::Task(task),
            (Record::Monitor { sequence, .. }, _) => Asked::Sequence(sequence),
        };
        book.add(topic, (name, note), asked, expected);
        Ok(())
    }
}

fn expected(facts: Option<&Facts>, events: usize) -> Result<Expected, String> {
    Expected::read(facts.filter(|it| !it.is_empty()).ok_or("nothing is expected")?, events)
}

/// How many events a trace or a sequence has.
fn events(record: &str) -> Result<usize, String> {
    let record: Value = from_str(record).map_err(text)?;
    Ok(record["events"].as_array().map_or(0, Vec::len))
}

fn text(error: impl Display) -> String {
    error.to_string()
}

fn with_kind(kind: &str, record: &RawValue) -> String {
    let fields = record.get().trim_start_matches('{');
    format!("{{\"kind\": \"{kind}\", \"id\": \"\", {fields}")
}

impl Line {
    fn text(&self) -> Result<Cow<'_, str>, String> {
        match self {
            Self::Text(text) => Ok(Cow::from(text)),
            Self::Changed { of, old, new } => {
                let (_, record) =
                    RECORDS.iter().find(|(name, _)| name == of).ok_or("no such record")?;
                Ok(Cow::from(record.trim_end().replacen(old, new, 1)))
            }
        }
    }
}

impl Edge {
    /// The numbers from accepted to rejected: name, number, whether it is rejected.
    fn numbers(&self) -> Result<[(&'static str, f64, bool); 5], String> {
        let (is_upper, equal, Exact(threshold)) =
            match (self.above, self.from, self.up_to, self.below) {
                (Some(above), None, None, None) => (true, false, above),
                (None, Some(from), None, None) => (true, true, from),
                (None, None, Some(up_to), None) => (false, true, up_to),
                (None, None, None, Some(below)) => (false, false, below),
                _ => return Err(String::from("needs one of above, from, up_to, below")),
            };
        let clear = self.clear.map_or(CLEAR, |Exact(clear)| clear);
        let up = [threshold.next_up(), threshold + clear];
        let down = [threshold.next_down(), threshold - clear];
        let (accepted, rejected) = if is_upper { (down, up) } else { (up, down) };
        Ok([
            ("accepted", accepted[1], false),
            ("just-accepted", accepted[0], false),
            ("equal", threshold, equal),
            ("just-rejected", rejected[0], true),
            ("rejected", rejected[1], true),
        ])
    }
}

/// The base with changes, in which `"?"` stands for a number.
fn changed(changes: &Changes<'_>, number: &str) -> serde_json::Result<String> {
    let mut record: Raw = from_str(BASE)?;
    // A pointer comes after those that it begins with.
    for (pointer, value) in changes {
        let value = RawValue::from_string(value.get().replace("\"?\"", number))?;
        let path: Vec<&str> = pointer.split('/').skip(1).collect();
        record = put(&record, &path, written_out(pointer, value)?)?;
    }
    Ok(record.get().to_owned())
}

/// A JSON text with another value at a path.
fn put(text: &RawValue, path: &[&str], value: Raw) -> serde_json::Result<Raw> {
    let Some((first, rest)) = path.split_first() else { return Ok(value) };
    if let Ok(index) = first.parse::<usize>() {
        let mut items: Vec<Raw> = from_str(text.get())?;
        let missing = || serde_json::Error::custom(format!("there is no index {index}"));
        let item = items.get_mut(index).ok_or_else(missing)?;
        *item = put(item, rest, value)?;
        return to_raw_value(&items);
    }
    let mut fields: BTreeMap<String, Raw> = from_str(text.get())?;
    let old = fields.remove(*first).map_or_else(|| to_raw_value(&Value::Null), Ok)?;
    fields.insert((*first).to_owned(), put(&old, rest, value)?);
    to_raw_value(&fields)
}

/// A value without abbreviations.
fn written_out(pointer: &str, value: Raw) -> serde_json::Result<Raw> {
    let defaults = DEFAULTS.iter().find(|(end, _)| pointer.ends_with(end)).map_or("{}", |it| it.1);
    if let Ok(items) = from_str::<Vec<BTreeMap<String, Raw>>>(value.get()) {
        let complete = |item| -> serde_json::Result<BTreeMap<String, Raw>> {
            let mut fields: BTreeMap<String, Raw> = from_str(defaults)?;
            fields.extend(item);
            Ok(fields)
        };
        return to_raw_value(&items.into_iter().map(complete).collect::<Result<Vec<_>, _>>()?);
    }
    let text = match from_str(value.get()) {
        Ok(Shape::Straight { count, step, from, to, start_ns, every_ns, y, cos, sin }) => {
            let number = |given: Option<Exact>, default| given.map_or(default, |it| it.0);
            let x = |i: u32| number(from, 0.0) + number(step, 1.0) * f64::from(i);
            let point = |i: u32| {
                let t_ns = NOW + start_ns.unwrap_or(0) + i64::from(i) * every_ns.unwrap_or(TENTH);
                let x = x(i).min(number(to, f64::INFINITY));
                let [y, cos, sin] = [number(y, 0.0), number(cos, 1.0), number(sin, 0.0)];
                format!(
                    r#"{{"t_ns": {t_ns}, "x": {x:?}, "y": {y:?}, "cos": {cos:?}, "sin": {sin:?}}}"#
                )
            };
            format!("[{}]", (0..count).map(point).collect::<Vec<_>>().join(", "))
        }
        Ok(Shape::Row(count, track)) => {
            let [id, y] =
                ["id", "y"].map(|key| track.get(key).and_then(Value::as_i64).unwrap_or(0));
            let mut fields: Facts = from_str(defaults)?;
            fields.extend(track);
            let mut tracks = Vec::new();
            for i in 0..i64::from(count) {
                fields
                    .extend([("id", id + i), ("y", y + i)].map(|(k, v)| (k.to_owned(), v.into())));
                tracks.push(fields.clone());
            }
            return to_raw_value(&tracks);
        }
        Ok(Shape::Lists(lists)) => {
            let list = |Earlier { age_ns, items }: Earlier| -> serde_json::Result<_> {
                let items = written_out("detections/items", to_raw_value(&items)?)?;
                Ok(BTreeMap::from([("stamp_ns", to_raw_value(&(NOW - age_ns))?), ("items", items)]))
            };
            return to_raw_value(&lists.into_iter().map(list).collect::<Result<Vec<_>, _>>()?);
        }
        Ok(Shape::Bitmap { cells: [width, height], set }) => {
            let mut bitmap = vec![0_u8; (width * height).div_ceil(8)];
            for bit in set.iter().map(|[column, row]| row * width + column) {
                let beyond = || serde_json::Error::custom("a cell is beyond the bitmap");
                *bitmap.get_mut(bit / 8).ok_or_else(beyond)? |= 1 << (bit % 8);
            }
            format!("\"{}\"", STANDARD.encode(bitmap))
        }
        Err(_) => return Ok(value),
    };
    RawValue::from_string(text)
}
