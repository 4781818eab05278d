//! Mutants of the requester, of the orchestrator and of readers.

use mufasa_conform::vectors::flag;
use mufasa_model::offloading::requester::{Event, EventKind, Groups, Sessions};
use mufasa_model::services::orchestrator::Task;
use mufasa_records::{self as json, Trace};
use serde_json::Value;

use crate::implementation::{exact, run};

/// A requester that gets other events, or none.
type Ear = fn(&Event) -> Option<Event>;
/// A requester with other parameters.
type Setting = fn(&mut Trace);

fn kind(event: &Event, kind: EventKind) -> Event {
    Event { kind, ..*event }
}

/// A requester that does not hear events of a kind.
macro_rules! deaf {
    ($name:literal, $pattern:pat) => {
        ($name, |event| (!matches!(event.kind, $pattern)).then_some(*event))
    };
}

const EARS: &[(&str, Ear)] = &[
    deaf!("offers unheard", EventKind::Offer { .. }),
    deaf!("withdrawals unheard", EventKind::Withdraw { .. }),
    deaf!("losses unheard", EventKind::Lost { .. }),
    deaf!("areas unheard", EventKind::Area { .. }),
    deaf!("ticks unheard", EventKind::Tick),
    deaf!("confirmations unheard", EventKind::Confirm { .. }),
    deaf!("rejections unheard", EventKind::Reject { .. }),
    deaf!("data unheard", EventKind::Data { .. }),
    deaf!("safe cycles unheard", EventKind::Verdict { safe: true, .. }),
    deaf!("unsafe cycles unheard", EventKind::Verdict { safe: false, .. }),
    ("any offer is of everything", |event| {
        Some(match event.kind {
            EventKind::Offer { station, .. } => {
                kind(event, EventKind::Offer { station, groups: Groups::ALL })
            }
            _ => *event,
        })
    }),
    ("everything is safe", |event| {
        Some(match event.kind {
            EventKind::Verdict { sessions, .. } => {
                kind(event, EventKind::Verdict { safe: true, sessions })
            }
            _ => *event,
        })
    }),
    ("everything is unsafe", |event| {
        Some(match event.kind {
            EventKind::Verdict { sessions, .. } => {
                kind(event, EventKind::Verdict { safe: false, sessions })
            }
            _ => *event,
        })
    }),
    ("every cycle used the first two sessions", |event| {
        Some(match event.kind {
            EventKind::Verdict { safe, .. } => {
                let sessions = Sessions { mot: Some(1), plan: Some(2) };
                kind(event, EventKind::Verdict { safe, sessions })
            }
            _ => *event,
        })
    }),
    ("sessions are all the first", |event| {
        Some(match event.kind {
            EventKind::Confirm { station, group, .. } => {
                kind(event, EventKind::Confirm { station, group, session: 1 })
            }
            EventKind::Reject { station, group, .. } => {
                kind(event, EventKind::Reject { station, group, session: 1 })
            }
            EventKind::Data { station, group, generated_ns, .. } => {
                kind(event, EventKind::Data { station, group, session: 1, generated_ns })
            }
            _ => *event,
        })
    }),
    ("stations are all the first", |event| {
        Some(match event.kind {
            EventKind::Confirm { group, session, .. } => {
                kind(event, EventKind::Confirm { station: 1, group, session })
            }
            EventKind::Reject { group, session, .. } => {
                kind(event, EventKind::Reject { station: 1, group, session })
            }
            EventKind::Data { group, session, generated_ns, .. } => {
                kind(event, EventKind::Data { station: 1, group, session, generated_ns })
            }
            _ => *event,
        })
    }),
    ("data are always fresh", |event| {
        Some(match event.kind {
            EventKind::Data { station, group, session, .. } => {
                kind(event, EventKind::Data { station, group, session, generated_ns: event.t_ns })
            }
            _ => *event,
        })
    }),
    ("a withdrawal is a loss", |event| {
        Some(match event.kind {
            EventKind::Withdraw { station } => kind(event, EventKind::Lost { station }),
            _ => *event,
        })
    }),
    ("a loss is a withdrawal", |event| {
        Some(match event.kind {
            EventKind::Lost { station } => kind(event, EventKind::Withdraw { station }),
            _ => *event,
        })
    }),
    ("a rejection is a withdrawal", |event| {
        Some(match event.kind {
            EventKind::Reject { station, .. } => kind(event, EventKind::Withdraw { station }),
            _ => *event,
        })
    }),
];

const SETTINGS: &[(&str, Setting)] = &[
    ("the other profile of the protocol", |t| {
        t.profile = flag::other(t.profile);
    }),
    ("t_wait a nanosecond longer", |t| {
        t.parameters.t_wait_ns = t.parameters.t_wait_ns.saturating_add(1);
    }),
    ("t_wait a nanosecond shorter", |t| {
        t.parameters.t_wait_ns = (t.parameters.t_wait_ns - 1).max(0);
    }),
    ("request_timeout a nanosecond longer", |t| t.parameters.request_timeout_ns += 1),
    ("request_timeout a nanosecond shorter", |t| {
        t.parameters.request_timeout_ns = (t.parameters.request_timeout_ns - 1).max(0);
    }),
    ("l_max a nanosecond longer", |t| t.parameters.l_max_ns += 1),
    ("l_max a nanosecond shorter", |t| t.parameters.l_max_ns -= 1),
    ("dt_max a nanosecond longer", |t| t.parameters.dt_max_ns += 1),
    ("dt_max a nanosecond shorter", |t| t.parameters.dt_max_ns -= 1),
    ("the other qos_hold", |t| t.parameters.qos_hold = !t.parameters.qos_hold),
];

/// The names of all mutants of requester and orchestrator.
pub fn names() -> impl Iterator<Item = &'static str> {
    let ears = EARS.iter().map(|(name, _)| *name);
    let settings = SETTINGS.iter().map(|(name, _)| *name);
    ears.chain(settings).chain(TASKS.iter().map(|(name, _)| *name))
}

/// The mutants of the requester that a trace tells apart.
pub fn of_trace(trace: &Trace) -> Vec<&'static str> {
    let right = exact(trace);
    let ears = EARS.iter().filter(|(_, ear)| run(trace, ear) != right).map(|(name, _)| *name);
    let settings = SETTINGS.iter().filter(|(_, setting)| {
        let mut other = trace.clone();
        setting(&mut other);
        run(&other, |event| Some(*event)) != right
    });
    ears.chain(settings.map(|(name, _)| *name)).collect()
}

/// An orchestrator that sees another task.
type Eye = fn(&Task) -> Task;

/// Orchestrators that see another task.
pub const TASKS: &[(&str, Eye)] = &[
    ("same_station ignored", |task| Task { same_station: vec![], ..task.clone() }),
    ("local_only ignored", |task| Task { local_only: vec![], ..task.clone() }),
    ("everything on the CAV", |task| {
        let mut task = task.clone();
        task.services.iter_mut().for_each(|service| service.station = 0);
        task
    }),
    ("everything remote", |task| {
        let mut task = task.clone();
        task.services.iter_mut().for_each(|service| service.station = 1);
        task
    }),
    ("the last service forgotten", |task| {
        let mut task = task.clone();
        task.services.pop();
        task
    }),
    ("double names removed", |task| {
        let mut task = task.clone();
        for service in &mut task.services {
            service.requires.dedup();
            service.guarantees.dedup();
        }
        task
    }),
    ("the second service renamed", |task| {
        let mut task = task.clone();
        task.services.iter_mut().skip(1).take(1).for_each(|service| service.id.push('2'));
        task
    }),
    ("the goal is the first service", |task| {
        let goal = task.services.first().map_or_else(String::new, |service| service.id.clone());
        Task { goal, ..task.clone() }
    }),
    ("at most forty services", |task| {
        let mut task = task.clone();
        task.services.truncate(40);
        task
    }),
    ("every service requires something", |task| {
        let mut task = task.clone();
        for service in task.services.iter_mut().filter(|service| service.requires.is_empty()) {
            service.requires.push(String::from("x"));
        }
        task
    }),
    ("an empty set has a service", |task| {
        let mut task = task.clone();
        if task.services.is_empty() {
            let (id, station) = (task.goal.clone(), 0);
            let (requires, guarantees) = (vec![], vec![]);
            let service =
                mufasa_model::services::service::Service { id, requires, guarantees, station };
            task.services.push(service);
        }
        task
    }),
];

/// The mutants of readers that a line which is refused tells apart: they answer it otherwise, or
/// with another place of what is wrong.
pub fn of_line(line: &str) -> Vec<&'static str> {
    let place = |text: &str| {
        let answer = serde_json::to_value(json::answer(text.as_bytes(), 1)).expect("JSON");
        (answer["error"]["field"].clone(), answer["error"]["index"].clone())
    };
    let (field, index) = place(line);
    let mut told = Vec::new();
    if index != Value::Null {
        told.push("no index");
    }
    if field.as_str().is_some_and(|field| field.contains('.')) {
        told.push("no path");
    }
    // What a library makes of the text: the last of equal keys, doubles for all numbers.
    match serde_json::from_str::<Value>(line) {
        Ok(value) => {
            let mended = rounded(&value).to_string();
            if place(&mended) != (field.clone(), index.clone()) {
                told.push("read by a lenient library");
            }
            if value.get("kind").is_some() {
                // Absent fields have defaults, unknown ones are ignored: the answer is a verdict.
                told.push("never refuses an object with a kind");
            }
        }
        Err(_) if line.trim().is_empty() => told.push("blank lines skipped"),
        Err(_) => told.push("lines that are no JSON skipped"),
    }
    if field == "kind" || field == "" {
        told.push("any object is a record");
    }
    told
}

/// Numbers without a fraction as integers.
fn rounded(value: &Value) -> Value {
    match value {
        Value::Number(number) => match number.as_f64() {
            #[expect(clippy::cast_possible_truncation, reason = "a lenient reader truncates")]
            Some(double) if double.fract() == 0.0 && double.abs() < 1e15 => (double as i64).into(),
            _ => value.clone(),
        },
        Value::Array(items) => items.iter().map(rounded).collect(),
        Value::Object(fields) => {
            fields.iter().map(|(key, value)| (key.clone(), rounded(value))).collect()
        }
        Value::Null | Value::Bool(_) | Value::String(_) => value.clone(),
    }
}
