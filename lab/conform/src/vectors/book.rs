//! Collects vectors and refuses those on which author and model differ.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt;

use mufasa_model::cycle::check;
use mufasa_model::input::cycle::Cycle;
use mufasa_model::report::Reading;
use mufasa_model::services::orchestrator::Task;
use serde_json::Value;

use crate::vectors::expected::Expected;
use crate::vectors::flag::{self, Flag};
use mufasa_records::record::Recorded;
use mufasa_records::record::composition::Composition;
use mufasa_records::record::monitor::Monitor;
use mufasa_records::record::offloading::Offloading;
use mufasa_records::{self as json, Answer, Sequence, Trace, cycle_to_line};

/// What is added to the note of a cycle that an implementation may answer either way.
const STAYS: &str = "Stays, though an implementation may answer otherwise here (the strict \
                         model fails earlier): it is the exact answer at the threshold.";

/// A record with the answer that it must get (`spec/5-interfaces.md#vectors`).
#[derive(Clone, Debug)]
pub struct Vector {
    /// Never changes.
    pub id: String,
    /// A requirement or heading of `spec/`, a rule or a finding.
    pub requirement: &'static str,
    /// Whom it binds.
    pub flag: Flag,
    /// What it shows.
    pub note: String,
    /// The line to be answered.
    pub input: Input,
    /// The answer of the oracle.
    pub expect: Answer,
}

/// The line of a vector.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Input {
    /// The text of a record.
    Record(String),
    /// A line that is no record.
    Line(String),
}

impl Input {
    /// The line itself.
    pub fn text(&self) -> &str {
        let (Self::Record(text) | Self::Line(text)) = self;
        text
    }
}

impl fmt::Display for Vector {
    /// The vector on one line.
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let text = |text: &str| Value::from(text).to_string();
        let input = match &self.input {
            Input::Record(record) => record.clone(),
            Input::Line(line) => text(line),
        };
        write!(
            out,
            "{{\"id\": {}, \"requirement\": {}, \"flag\": {}, \"note\": {}, \"input\": {input}, \
             \"expect\": {}}}",
            text(&self.id),
            text(self.requirement),
            text(&self.flag.to_string()),
            text(&self.note),
            serde_json::to_string(&self.expect).unwrap_or_default()
        )
    }
}

/// A vector that cannot be: author and model differ, or its id is taken.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Refused {
    /// Id of the vector.
    pub id: String,
    /// What is wrong.
    pub problem: String,
}

impl fmt::Display for Refused {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(out, "vector {}: {}", self.id, self.problem)
    }
}

impl std::error::Error for Refused {}

/// A place in the book: the file, the requirement, and the interpretation if there is one.
#[derive(Clone, Copy, Debug)]
pub struct Topic {
    file: &'static str,
    requirement: &'static str,
    interpretation: Option<&'static str>,
}

impl Topic {
    /// Vectors of `requirement` in the file `file`, such as `stages/schedule`; `interpretation` if
    /// they bind only who reads the paper so.
    pub const fn new(
        file: &'static str,
        requirement: &'static str,
        interpretation: Option<&'static str>,
    ) -> Self {
        Self { file, requirement, interpretation }
    }

    /// The id of a vector: the name of the file and a name of its own.
    fn id(&self, name: &str) -> String {
        let stem = self.file.rsplit('/').next().unwrap_or(self.file);
        format!("{stem}-{name}")
    }

    fn flag(&self, otherwise: Flag) -> Flag {
        self.interpretation.map_or(otherwise, Flag::Interpretation)
    }
}

/// All vectors by file.
#[derive(Clone, Debug, Default)]
pub struct Book {
    files: BTreeMap<&'static str, Vec<Vector>>,
    ids: BTreeSet<String>,
    refused: Vec<Refused>,
}

/// What a vector asks.
#[derive(Clone, Copy, Debug)]
pub enum Asked<'a> {
    /// A cycle.
    Cycle(&'a Cycle),
    /// A cycle in whose text something is replaced so that it is refused, whatever the profile.
    Broken(&'a Cycle, [&'a str; 2]),
    /// An offloading trace.
    Trace(&'a Trace),
    /// A composition.
    Task(&'a Task),
    /// A sequence of the monitor.
    Sequence(&'a Sequence),
    /// A line that is refused, whatever the profile.
    Line(&'a str),
}

impl Asked<'_> {
    /// Whom it binds, and the line under this id.
    fn input(self, id: &str) -> (Flag, Input) {
        // Records are plain data: they always become JSON.
        let text = |record: serde_json::Result<String>| Input::Record(record.unwrap_or_default());
        match self {
            Self::Cycle(cycle) => (flag::of_cycle(cycle), Input::Record(cycle_to_line(id, cycle))),
            Self::Broken(cycle, [old, new]) => {
                (Flag::Must, Input::Record(cycle_to_line(id, cycle).replacen(old, new, 1)))
            }
            Self::Trace(trace) => {
                (flag::of_trace(trace), text(serde_json::to_string(&Offloading::whole(id, trace))))
            }
            Self::Task(task) => {
                let record = Composition { id: id.to_owned(), ..Recorded::of_model(task) };
                (Flag::Must, text(serde_json::to_string(&record)))
            }
            Self::Sequence(sequence) => (
                flag::of_sequence(sequence),
                text(serde_json::to_string(&Monitor::whole(id, sequence))),
            ),
            Self::Line(line) => (Flag::Must, Input::Line(line.to_owned())),
        }
    }

    /// Whether exact and strict model differ.
    fn may_be_answered_otherwise(self) -> bool {
        let readings = [Reading::Exact, Reading::Strict];
        match self {
            Self::Cycle(cycle) => {
                let [exact, strict] =
                    readings.map(|reading| check(cycle, reading).map(|report| report.failed_stage));
                exact != strict
            }
            Self::Sequence(sequence) => {
                let [exact, strict] = readings.map(|reading| flag::decisions(sequence, reading));
                exact != strict
            }
            Self::Broken(..) | Self::Trace(_) | Self::Task(_) | Self::Line(_) => false,
        }
    }
}

impl Book {
    /// A vector; refused when the oracle's answer is not what its author expects.
    pub fn add(
        &mut self,
        topic: Topic,
        (name, note): (&str, &str),
        asked: Asked<'_>,
        expected: &Expected,
    ) {
        let id = topic.id(name);
        let stays =
            if asked.may_be_answered_otherwise() { format!(" {STAYS}") } else { String::new() };
        let (flag, input) = asked.input(&id);
        let expect = json::answer(input.text().as_bytes(), 1);
        let problem = match serde_json::to_value(&expect) {
            Ok(answer) => expected.broken_by(&answer),
            Err(error) => Some(error.to_string()),
        };
        if let Some(problem) = problem {
            self.refuse(&id, &problem);
        }
        if !self.ids.insert(id.clone()) {
            self.refuse(&id, &"the id is taken");
        }
        let (requirement, flag) = (topic.requirement, topic.flag(flag));
        let vector =
            Vector { id, requirement, flag, note: format!("{note}{stays}"), input, expect };
        self.files.entry(topic.file).or_default().push(vector);
    }

    /// A place of the data that cannot be read, or a vector that is wrong.
    pub fn refuse(&mut self, place: &str, problem: &impl fmt::Display) {
        self.refused.push(Refused { id: place.to_owned(), problem: problem.to_string() });
    }

    /// The vectors of every file, or everything that is wrong with them.
    pub fn finish(self) -> Result<BTreeMap<&'static str, Vec<Vector>>, Vec<Refused>> {
        if self.refused.is_empty() { Ok(self.files) } else { Err(self.refused) }
    }
}
