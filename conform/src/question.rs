//! What is asked: a record of one of the three kinds, and its line.

use std::fmt::Write;

use mufasa_model::input::cycle::Cycle;
use mufasa_model::offloading::requester::{Event, EventKind, Group, Groups, Parameters};
use mufasa_model::services::orchestrator::Task;
use serde_json::json;

use super::class::Kind;
use super::damage::Damage;
use mufasa_records::{self as records, Trace, cycle_to_line, names};

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
    /// A line that is none of them.
    Line(Damaged),
}

impl Question {
    /// Its kind.
    pub fn kind(&self) -> Kind {
        match self {
            Self::Cycle(_) => Kind::Cycle,
            Self::Offloading(_) => Kind::Offloading,
            Self::Composition(_) => Kind::Composition,
            Self::Line(_) => Kind::Line,
        }
    }

    /// Profile and configuration as in the record; empty where it has none.
    pub fn setting(&self) -> (&'static str, &'static str) {
        match self {
            Self::Cycle(cycle) => {
                (names::profile(cycle.profile), names::configuration(cycle.configuration))
            }
            Self::Offloading(trace) => (names::profile(trace.profile), ""),
            Self::Composition(_) | Self::Line(_) => ("", ""),
        }
    }

    /// The record on one line, without the newline.
    pub fn line(&self, id: &str) -> String {
        match self {
            Self::Cycle(cycle) => cycle_to_line(id, cycle),
            Self::Offloading(trace) => trace_to_line(id, trace),
            Self::Composition(task) => task_to_line(id, task),
            Self::Line(damaged) => damaged.line(id),
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
            Self::Line(damaged) => damaged.record.objects(),
        }
    }

    /// What `objects` counts.
    pub fn unit(&self) -> &'static str {
        match self {
            Self::Cycle(_) => "object",
            Self::Offloading(_) => "event",
            Self::Composition(_) => "service",
            Self::Line(damaged) => damaged.record.unit(),
        }
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
            if records::parse(damaged.line("x").as_bytes(), 1).is_err() {
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

fn trace_to_line(id: &str, trace: &Trace) -> String {
    let events: Vec<String> = trace.events.iter().map(event).collect();
    format!(
        "{{\"kind\": \"offloading\", \"id\": {}, \"profile\": \"{}\", \"parameters\": {{{}}}, \
         \"events\": [{}]}}",
        json!(id),
        names::profile(trace.profile),
        times(&trace.parameters),
        events.join(", ")
    )
}

/// The times that are not at their default.
fn times(parameters: &Parameters) -> String {
    let usual = Parameters::default();
    let pairs = [
        ("t_wait_ns", parameters.t_wait_ns, usual.t_wait_ns),
        ("request_timeout_ns", parameters.request_timeout_ns, usual.request_timeout_ns),
        ("l_max_ns", parameters.l_max_ns, usual.l_max_ns),
        ("dt_max_ns", parameters.dt_max_ns, usual.dt_max_ns),
    ];
    let mut fields: Vec<String> = pairs
        .into_iter()
        .filter(|(_, value, usual)| value != usual)
        .map(|(key, value, _)| format!("\"{key}\": {value}"))
        .collect();
    if parameters.qos_hold != usual.qos_hold {
        fields.push(format!("\"qos_hold\": {}", parameters.qos_hold));
    }
    fields.join(", ")
}

fn event(event: &Event) -> String {
    let mut text = format!("{{\"t_ns\": {}, \"type\": \"{}\"", event.t_ns, event_type(event));
    let message = |station: i64, group: Group, session: i64| {
        let group = names::group(group);
        format!(", \"station\": {station}, \"group\": \"{group}\", \"session\": {session}")
    };
    let rest = match event.kind {
        EventKind::Offer { station, groups } => {
            format!(", \"station\": {station}, \"groups\": {}", list(groups))
        }
        EventKind::Withdraw { station } | EventKind::Lost { station } => {
            format!(", \"station\": {station}")
        }
        EventKind::Area { groups } => format!(", \"groups\": {}", list(groups)),
        EventKind::Tick => String::new(),
        EventKind::Confirm { station, group, session }
        | EventKind::Reject { station, group, session } => message(station, group, session),
        EventKind::Data { station, group, session, generated_ns } => {
            format!("{}, \"generated_ns\": {generated_ns}", message(station, group, session))
        }
        EventKind::Verdict { safe, groups } => {
            format!(", \"verdict\": \"{}\", \"groups\": {}", names::verdict(safe), list(groups))
        }
    };
    // Writing to a string cannot fail.
    let _ = write!(text, "{rest}}}");
    text
}

/// The type of an event in the records.
pub fn event_type(event: &Event) -> &'static str {
    match event.kind {
        EventKind::Offer { .. } => "offer",
        EventKind::Withdraw { .. } => "withdraw",
        EventKind::Lost { .. } => "lost",
        EventKind::Area { .. } => "area",
        EventKind::Tick => "tick",
        EventKind::Confirm { .. } => "confirm",
        EventKind::Reject { .. } => "reject",
        EventKind::Data { .. } => "data",
        EventKind::Verdict { .. } => "verdict",
    }
}

fn list(groups: Groups) -> String {
    let named = Group::ALL.into_iter().filter(|group| groups.contains(*group));
    json!(named.map(names::group).collect::<Vec<_>>()).to_string()
}

fn task_to_line(id: &str, task: &Task) -> String {
    let services: Vec<String> = task
        .services
        .iter()
        .map(|service| {
            format!(
                "{{\"id\": {}, \"requires\": {}, \"guarantees\": {}, \"station\": {}}}",
                json!(service.id),
                json!(service.requires),
                json!(service.guarantees),
                service.station
            )
        })
        .collect();
    format!(
        "{{\"kind\": \"composition\", \"id\": {}, \"services\": [{}], \"goal\": {}, \
         \"same_station\": {}, \"local_only\": {}}}",
        json!(id),
        services.join(", "),
        json!(task.goal),
        json!(task.same_station),
        json!(task.local_only)
    )
}

#[cfg(test)]
mod tests {
    use mufasa_model::input::cycle::Profile;

    use super::super::generate::Generator;
    use super::*;
    use mufasa_records::{Record, parse};

    #[test]
    fn the_line_of_a_question_reads_back_to_it() {
        let mut seen = [0; 3];
        for case in 0..600 {
            let generator =
                Generator { seed: 3, profile: Profile::Paper, kinds: Kind::RECORDS.into() };
            let question = generator.question(case);
            let line = question.line("c-\"1\"");
            let record = parse(line.as_bytes(), 1).unwrap_or_else(|e| panic!("{e}\n{line}"));
            let (id, read) = match record {
                Record::Cycle { id, cycle } => (id, Question::Cycle(cycle)),
                Record::Offloading { id, trace } => (id, Question::Offloading(trace)),
                Record::Composition { id, task } => (id, Question::Composition(task)),
            };
            assert_eq!(id, "c-\"1\"");
            seen[question.kind() as usize] += 1;
            // NaN is not equal to itself; its text is.
            assert_eq!(read.line("x"), question.line("x"));
        }
        assert!(seen.iter().all(|count| *count > 20), "{seen:?}");
    }

    #[test]
    fn each_damage_makes_each_kind_of_record_unreadable() {
        for kind in Kind::RECORDS {
            let generator = Generator { seed: 1, profile: Profile::Hardened, kinds: vec![kind] };
            for (at, damage) in Damage::ALL.into_iter().cycle().take(220).enumerate() {
                let damaged = Damaged::new(generator.question(at as u64), damage, at * 7);
                let line = damaged.line("c-1");
                assert!(parse(line.as_bytes(), 1).is_err(), "{damage:?}: {line}");
                assert_ne!(line, damaged.record.line("c-1"));
            }
        }
    }
}
