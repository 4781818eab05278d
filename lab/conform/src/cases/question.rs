//! What is asked: a record of one of the four kinds, and its line.

use mufasa_model::input::cycle::Cycle;
use mufasa_model::services::orchestrator::Task;

use crate::cases::damage::Damage;
use crate::judge::class::Kind;
use mufasa_records::record::{Recorded, composition, cycle, monitor, offloading};
use mufasa_records::{
    LineError, Record, Sequence, Trace, cycle_to_line, decide, names, parse, sequence_to_line,
    task_to_line, trace_to_line,
};
use serde_json::Value;

/// So many places are tried for one where a damage makes a record unreadable.
const TRIES: usize = 50;

/// The content of a record; the id is given when it is sent.
#[derive(Clone, Debug, PartialEq)]
pub enum Question {
    /// A cycle.
    Cycle(Box<Cycle>),
    /// An offloading trace.
    Offloading(Trace),
    /// A composition.
    Composition(Task),
    /// What one monitor lives through.
    Monitor(Box<Sequence>),
    /// A line that is none of them.
    Line(Damaged),
    /// A line of a vector that is none of them, or not one that a record would be written as.
    Text(Text),
}

impl Question {
    /// Its kind.
    pub fn kind(&self) -> Kind {
        match self {
            Self::Cycle(_) => Kind::Cycle,
            Self::Offloading(_) => Kind::Offloading,
            Self::Composition(_) => Kind::Composition,
            Self::Monitor(_) => Kind::Monitor,
            Self::Line(_) | Self::Text(_) => Kind::Line,
        }
    }

    /// Profile and configuration as in the record; empty where it has none.
    pub fn setting(&self) -> (&'static str, &'static str) {
        match self {
            Self::Cycle(cycle) => {
                (names::profile(cycle.profile), names::configuration(cycle.configuration))
            }
            Self::Offloading(trace) => (names::profile(trace.profile), ""),
            Self::Monitor(sequence) => (names::profile(sequence.profile), ""),
            Self::Composition(_) | Self::Line(_) | Self::Text(_) => ("", ""),
        }
    }

    /// The record as JSON, without its id; a line that is none has none.
    pub fn record(&self) -> Option<Value> {
        match self {
            Self::Cycle(it) => serde_json::to_value(cycle::Cycle::of_model(it)).ok(),
            Self::Offloading(it) => serde_json::to_value(offloading::Offloading::of_model(it)).ok(),
            Self::Composition(it) => {
                serde_json::to_value(composition::Composition::of_model(it)).ok()
            }
            Self::Monitor(it) => serde_json::to_value(monitor::Monitor::of_model(it)).ok(),
            Self::Line(_) | Self::Text(_) => None,
        }
    }

    /// What a record asks; `None` when it is none.
    pub fn of_line(line: &str) -> Option<Self> {
        Some(match parse(line.as_bytes(), 1).ok()? {
            Record::Cycle { cycle, .. } => Self::Cycle(cycle),
            Record::Offloading { trace, .. } => Self::Offloading(trace),
            Record::Composition { task, .. } => Self::Composition(task),
            Record::Monitor { sequence, .. } => Self::Monitor(sequence),
        })
    }

    /// The record on one line, without the newline.
    pub fn line(&self, id: &str) -> String {
        match self {
            Self::Cycle(cycle) => cycle_to_line(id, cycle),
            Self::Offloading(trace) => trace_to_line(id, trace),
            Self::Composition(task) => task_to_line(id, task),
            Self::Monitor(sequence) => sequence_to_line(id, sequence),
            Self::Line(damaged) => damaged.line(id),
            Self::Text(text) => text.line.clone(),
        }
    }

    /// How much there is to read: tracks, detections, a leading vehicle and marked cells; events;
    /// services.
    pub fn objects(&self) -> usize {
        match self {
            Self::Cycle(cycle) => {
                let tracks = cycle.tracks.as_ref().map_or(0, |list| list.items.len());
                let detections = cycle.detections.as_ref().map_or(0, |list| list.items.len());
                let marked = |bytes: &[u8]| bytes.iter().map(|b| b.count_ones() as usize).sum();
                let cells: usize = cycle.grid.as_ref().map_or(0, |grid| {
                    let unknown: usize = grid.unknown.as_deref().map_or(0, marked);
                    let occupied: usize = marked(&grid.occupied);
                    occupied + unknown
                });
                tracks + detections + usize::from(cycle.lead.is_some()) + cells
            }
            Self::Offloading(trace) => trace.events.len(),
            Self::Composition(task) => task.services.len(),
            Self::Monitor(sequence) => sequence.events.len(),
            Self::Line(damaged) => damaged.record.objects(),
            Self::Text(_) => 1,
        }
    }

    /// What `objects` counts.
    pub fn unit(&self) -> &'static str {
        match self {
            Self::Cycle(_) => "object",
            Self::Offloading(_) | Self::Monitor(_) => "event",
            Self::Composition(_) => "service",
            Self::Line(damaged) => damaged.record.unit(),
            Self::Text(_) => "line",
        }
    }

    /// The id that the answer must have when it is asked under `id`.
    pub fn id<'a>(&'a self, id: &'a str) -> &'a str {
        match self {
            Self::Text(text) => text.id.as_deref().unwrap_or(id),
            _ => id,
        }
    }

    /// What is wrong with a line that is no record; empty for a record.
    pub fn wrong(&self) -> &str {
        match self {
            Self::Line(damaged) => damaged.damage.name(),
            Self::Text(text) => &text.vector,
            _ => "",
        }
    }
}

/// A line of a vector, as it stands.
#[derive(Clone, Debug, PartialEq)]
pub struct Text {
    /// The vector.
    pub vector: String,
    /// The line.
    pub line: String,
    /// The id that can be read in it.
    id: Option<String>,
}

impl Text {
    /// The line of the vector of this id.
    pub fn new(vector: &str, line: &str) -> Self {
        let mut text = Self { vector: vector.to_owned(), line: line.to_owned(), id: None };
        text.id = text.error().and_then(|error| error.id);
        text
    }

    /// What is wrong with it, in its schema or in its values.
    pub fn error(&self) -> Option<LineError> {
        let decided = parse(self.line.as_bytes(), 1).and_then(|record| {
            decide(record).map_err(|(id, problem)| LineError::new(1, Some(id), problem))
        });
        decided.err()
    }
}

/// A record with a damage.
#[derive(Clone, Debug, PartialEq)]
pub struct Damaged {
    /// The record without it; not damaged itself.
    pub record: Box<Question>,
    /// What is wrong.
    pub damage: Damage,
    /// At which of the places where it could be, counted around.
    pub at: usize,
}

impl Damaged {
    /// A damage that makes the record unreadable, at this place or one behind it; where it does so
    /// nowhere, as a word in a record without any, the line is cut.
    pub fn new(record: Question, damage: Damage, at: usize) -> Self {
        let mut damaged = Self { record: Box::new(record), damage, at };
        for _ in 0..TRIES {
            if parse(damaged.line("x").as_bytes(), 1).is_err() {
                return damaged;
            }
            damaged.at = damaged.at.wrapping_add(1);
        }
        Self { damage: Damage::Cut, ..damaged }
    }

    /// The line.
    pub fn line(&self, id: &str) -> String {
        let mut text = self.record.line(id);
        let changes = self.damage.changes(&text);
        if let Some((place, by)) = changes.get(self.at % changes.len().max(1)) {
            text.replace_range(place.clone(), by);
        }
        text
    }
}

#[cfg(test)]
mod tests {
    use mufasa_model::input::cycle::Profile;

    use super::*;
    use crate::cases::generate::Generator;

    #[test]
    fn the_line_of_a_question_reads_back_to_it() {
        let (mut seen, mut refused) = ([0; 4], 0);
        for case in 0..600 {
            let generator =
                Generator { seed: 3, profile: Profile::PAPER, kinds: Kind::RECORDS.into() };
            let question = generator.question(case);
            let line = question.line("c-\"1\"");
            let Some(read) = Question::of_line(&line) else {
                // A bitmap of another length is invalid as soon as it is read.
                let error = parse(line.as_bytes(), 1).expect_err("it is no record");
                assert!(format!("{error:?}").contains("grid.occupied"), "{error:?}: {line}");
                refused += 1;
                continue;
            };
            assert!(line.contains("\"id\": \"c-\\\"1\\\"\""), "{line}");
            seen[question.kind() as usize] += 1;
            // NaN is not equal to itself; its text is.
            assert_eq!(read.line("x"), question.line("x"));
        }
        assert!(seen.iter().all(|count| *count > 20) && refused < 6, "{seen:?} {refused}");
    }

    #[test]
    fn each_damage_makes_each_kind_of_record_unreadable() {
        for kind in Kind::RECORDS {
            let generator = Generator { seed: 1, profile: Profile::HARDENED, kinds: vec![kind] };
            for (at, damage) in Damage::ALL.into_iter().cycle().take(220).enumerate() {
                let damaged = Damaged::new(generator.question(at as u64), damage, at * 7);
                let line = damaged.line("c-1");
                assert!(parse(line.as_bytes(), 1).is_err(), "{damage:?}: {line}");
                assert_ne!(line, damaged.record.line("c-1"));
            }
        }
    }
}
