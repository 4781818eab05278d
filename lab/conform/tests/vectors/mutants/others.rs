//! Mutants of the requester, of the orchestrator and of readers.

use mufasa_conform::vectors::flag;
use mufasa_model::offloading::requester::EventKind::{
    Area, Confirm, Data, Lost, Offer, Reject, Tick, Verdict, Withdraw,
};
use mufasa_model::offloading::requester::{Event, Groups, Sessions};
use mufasa_model::services::orchestrator::Task;
use mufasa_model::services::service::Service;
use mufasa_records::{self as json, Record, Trace, decide};
use serde_json::Value;

use crate::vectors::implementation::{exact, run};

/// A requester that gets other events, or none.
type Ear = fn(&Event) -> Option<Event>;
/// A requester with other parameters.
type Setting = fn(&mut Trace);

/// A requester that does not hear events of a kind.
macro_rules! deaf {
    ($name:literal, $pattern:pat) => {
        ($name, |event| (!matches!(event.kind, $pattern)).then_some(*event))
    };
}

/// A requester that hears other events of some kinds.
macro_rules! hears {
    ($name:literal, $($pattern:pat => $kind:expr),+) => {
        ($name, |event| {
            Some(match event.kind {
                $($pattern => Event { kind: $kind, ..*event },)+
                _ => *event,
            })
        })
    };
}

const EARS: &[(&str, Ear)] = &[
    deaf!("offers unheard", Offer { .. }),
    deaf!("withdrawals unheard", Withdraw { .. }),
    deaf!("losses unheard", Lost { .. }),
    deaf!("areas unheard", Area { .. }),
    deaf!("ticks unheard", Tick),
    deaf!("confirmations unheard", Confirm { .. }),
    deaf!("rejections unheard", Reject { .. }),
    deaf!("data unheard", Data { .. }),
    deaf!("safe cycles unheard", Verdict { safe: true, .. }),
    deaf!("unsafe cycles unheard", Verdict { safe: false, .. }),
    hears!("any offer is of everything",
        Offer { station, .. } => Offer { station, groups: Groups::ALL }),
    hears!("everything is safe", Verdict { sessions, .. } => Verdict { safe: true, sessions }),
    hears!("everything is unsafe", Verdict { sessions, .. } => Verdict { safe: false, sessions }),
    hears!("every cycle used the first two sessions",
        Verdict { safe, .. } => Verdict { safe, sessions: Sessions { mot: Some(1), plan: Some(2) } }),
    hears!("sessions are all the first",
        Confirm { station, group, .. } => Confirm { station, group, session: 1 },
        Reject { station, group, .. } => Reject { station, group, session: 1 },
        Data { station, group, generated_ns, .. } => Data { station, group, session: 1, generated_ns }),
    hears!("stations are all the first",
        Confirm { group, session, .. } => Confirm { station: 1, group, session },
        Reject { group, session, .. } => Reject { station: 1, group, session },
        Data { group, session, generated_ns, .. } => Data { station: 1, group, session, generated_ns }),
    ("data are always fresh", |event| {
        let mut fresh = *event;
        if let Data { generated_ns, .. } = &mut fresh.kind {
            *generated_ns = event.t_ns;
        }
        Some(fresh)
    }),
    hears!("a withdrawal is a loss", Withdraw { station } => Lost { station }),
    hears!("a loss is a withdrawal", Lost { station } => Withdraw { station }),
    hears!("a rejection is a withdrawal", Reject { station, .. } => Withdraw { station }),
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
    ears.chain(settings).chain(EYES.iter().map(|(name, _)| *name))
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

/// A change of the task on its way to the orchestrator.
type Eye = fn(&mut Task);

/// Orchestrators that see another task.
const EYES: &[(&str, Eye)] = &[
    ("same_station ignored", |task| task.same_station.clear()),
    ("local_only ignored", |task| task.local_only.clear()),
    ("everything on the CAV", |task| task.services.iter_mut().for_each(|it| it.station = 0)),
    ("everything remote", |task| task.services.iter_mut().for_each(|it| it.station = 1)),
    ("the last service forgotten", |task| drop(task.services.pop())),
    ("double names removed", |task| {
        for service in &mut task.services {
            service.requires.dedup();
            service.guarantees.dedup();
        }
    }),
    ("the second service renamed", |task| {
        task.services.iter_mut().skip(1).take(1).for_each(|service| service.id.push('2'));
    }),
    ("the goal is the first service", |task| {
        task.goal = task.services.first().map_or_else(String::new, |service| service.id.clone());
    }),
    ("at most forty services", |task| task.services.truncate(40)),
    ("every service requires something", |task| {
        for service in task.services.iter_mut().filter(|service| service.requires.is_empty()) {
            service.requires.push(String::from("x"));
        }
    }),
    ("an empty set has a service", |task| {
        if task.services.is_empty() {
            let (id, requires, guarantees) = (task.goal.clone(), vec![], vec![]);
            task.services.push(Service { id, requires, guarantees, station: 0 });
        }
    }),
];

/// The mutants of the orchestrator that a task tells apart.
pub fn of_task(task: &Task) -> Vec<&'static str> {
    let of = |task| decide(Record::Composition { id: String::new(), task });
    let right = of(task.clone());
    let is_told = |(_, eye): &&(&str, Eye)| {
        let mut seen = task.clone();
        eye(&mut seen);
        of(seen) != right
    };
    EYES.iter().filter(is_told).map(|(name, _)| *name).collect()
}

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
