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
use mufasa_records::record::offloading::Offloading;
use mufasa_records::{self as json, Answer, Trace, cycle_to_line};

/// What is added to the note of a cycle that an implementation may answer either way.
pub const STAYS: &str = "Stays, though an implementation may answer otherwise here (the strict \
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
            serde_json::to_string(&self.expect).map_err(|_| fmt::Error)?
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

impl Book {
    /// A cycle.
    pub fn cycle(
        &mut self,
        topic: Topic,
        name: &str,
        note: &str,
        cycle: &Cycle,
        expected: &Expected,
    ) {
        let id = topic.id(name);
        let readings = [Reading::Exact, Reading::Strict]
            .map(|reading| check(cycle, reading).map(|report| report.failed_stage));
        let note =
            if readings[0] == readings[1] { note.to_owned() } else { format!("{note} {STAYS}") };
        let flag = topic.flag(flag::of_cycle(cycle));
        let input = Input::Record(cycle_to_line(&id, cycle));
        self.add(topic, flag, (id, note), input, expected);
    }

    /// A cycle in whose text something is replaced so that it is refused, whatever the profile.
    pub fn broken(
        &mut self,
        topic: Topic,
        (name, note): (&str, &str),
        cycle: &Cycle,
        [old, new]: [&str; 2],
        expected: &Expected,
    ) {
        let id = topic.id(name);
        let input = Input::Record(cycle_to_line(&id, cycle).replacen(old, new, 1));
        self.add(topic, topic.flag(flag::ALIKE), (id, note.to_owned()), input, expected);
    }

    /// An offloading trace.
    pub fn trace(
        &mut self,
        topic: Topic,
        name: &str,
        note: &str,
        trace: &Trace,
        expected: &Expected,
    ) {
        let id = topic.id(name);
        let flag = topic.flag(flag::of_trace(trace));
        match serde_json::to_string(&Offloading::whole(&id, trace)) {
            Ok(text) => {
                self.add(topic, flag, (id, note.to_owned()), Input::Record(text), expected);
            }
            Err(error) => self.refused.push(Refused { id, problem: error.to_string() }),
        }
    }

    /// A composition.
    pub fn composition(
        &mut self,
        topic: Topic,
        name: &str,
        note: &str,
        task: &Task,
        expected: &Expected,
    ) {
        let id = topic.id(name);
        let flag = topic.flag(flag::ALIKE);
        let record = Composition { id: id.clone(), ..Recorded::of_model(task) };
        match serde_json::to_string(&record) {
            Ok(text) => {
                self.add(topic, flag, (id, note.to_owned()), Input::Record(text), expected);
            }
            Err(error) => self.refused.push(Refused { id, problem: error.to_string() }),
        }
    }

    /// A line that is refused, whatever the profile.
    pub fn line(&mut self, topic: Topic, name: &str, note: &str, line: &str, expected: &Expected) {
        let id = topic.id(name);
        let input = Input::Line(line.to_owned());
        self.add(topic, topic.flag(flag::ALIKE), (id, note.to_owned()), input, expected);
    }

    /// A place of the data that cannot be read.
    pub fn refuse(&mut self, place: &str, problem: &impl fmt::Display) {
        self.refused.push(Refused { id: place.to_owned(), problem: problem.to_string() });
    }

    /// The vectors of every file, or everything that is wrong with them.
    pub fn finish(self) -> Result<BTreeMap<&'static str, Vec<Vector>>, Vec<Refused>> {
        if self.refused.is_empty() { Ok(self.files) } else { Err(self.refused) }
    }

    fn add(
        &mut self,
        topic: Topic,
        flag: Flag,
        (id, note): (String, String),
        input: Input,
        expected: &Expected,
    ) {
        let expect = json::answer(input.text().as_bytes(), 1);
        let problem = match serde_json::to_value(&expect) {
            Ok(answer) => expected.broken_by(&answer),
            Err(error) => Some(error.to_string()),
        };
        if let Some(problem) = problem {
            self.refused.push(Refused { id: id.clone(), problem });
        }
        if !self.ids.insert(id.clone()) {
            let problem = String::from("the id is taken");
            self.refused.push(Refused { id: id.clone(), problem });
        }
        let requirement = topic.requirement;
        let vector = Vector { id, requirement, flag, note, input, expect };
        self.files.entry(topic.file).or_default().push(vector);
    }
}
