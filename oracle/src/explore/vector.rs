//! Offloading vectors of what was found (`spec/5-interfaces.md#vectors`).

use mufasa_model::cycle::Profile;
use mufasa_model::requester::{Event, EventKind, Group, Groups, Parameters};
use mufasa_proofs::explore::replay::{Scene, What};
use serde::Serialize;

use crate::json::offloading_answer::OffloadingAnswer;
use crate::json::{Trace, names};

/// The events of one CAV in a story.
pub fn events(scenes: &[Scene], cav: usize) -> Vec<Event> {
    let at_cav = |scene: &Scene| match scene.what {
        What::AtCav { cav: at, event, .. } if at == cav => Some(event),
        _ => None,
    };
    scenes.iter().filter_map(at_cav).collect()
}

/// A vector on one line, without the newline: the record of the trace and the model's answer.
/// Errors: the words do not fit into JSON, which cannot be.
pub fn line(
    id: &str,
    requirement: &str,
    note: &str,
    trace: &Trace,
) -> Result<String, serde_json::Error> {
    serde_json::to_string(&Vector {
        id,
        requirement,
        flag: match trace.profile {
            Profile::Paper => "paper-only",
            Profile::Hardened => "hardened-only",
        },
        note,
        input: Input {
            kind: "offloading",
            id,
            profile: names::profile(trace.profile),
            parameters: Times::from(&trace.parameters),
            events: trace.events.iter().map(Entry::from).collect(),
        },
        expect: OffloadingAnswer::run(id.to_owned(), trace),
    })
}

#[derive(Serialize)]
struct Vector<'a> {
    id: &'a str,
    requirement: &'a str,
    flag: &'static str,
    note: &'a str,
    input: Input<'a>,
    expect: OffloadingAnswer,
}

#[derive(Serialize)]
struct Input<'a> {
    kind: &'static str,
    id: &'a str,
    profile: &'static str,
    parameters: Times,
    events: Vec<Entry>,
}

#[derive(Serialize)]
struct Times {
    t_wait_ns: i64,
    request_timeout_ns: i64,
    l_max_ns: i64,
    dt_max_ns: i64,
    qos_hold: bool,
}

impl From<&Parameters> for Times {
    fn from(parameters: &Parameters) -> Self {
        let Parameters { t_wait_ns, request_timeout_ns, l_max_ns, dt_max_ns, qos_hold } =
            *parameters;
        Self { t_wait_ns, request_timeout_ns, l_max_ns, dt_max_ns, qos_hold }
    }
}

/// An event with the fields of its type.
#[derive(Default, Serialize)]
struct Entry {
    t_ns: i64,
    #[serde(rename = "type")]
    kind: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    station: Option<i64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    group: Option<&'static str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    session: Option<i64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    generated_ns: Option<i64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    verdict: Option<&'static str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    groups: Option<Vec<&'static str>>,
}

impl From<&Event> for Entry {
    fn from(event: &Event) -> Self {
        let entry = Self { t_ns: event.t_ns, ..Self::default() };
        let message = |kind, station, group, session| Self {
            kind,
            station: Some(station),
            group: Some(names::group(group)),
            session: Some(session),
            ..Self::default()
        };
        let filled = match event.kind {
            EventKind::Offer { station, groups } => {
                let (station, groups) = (Some(station), Some(list(groups)));
                Self { kind: "offer", station, groups, ..entry }
            }
            EventKind::Withdraw { station } => {
                Self { kind: "withdraw", station: Some(station), ..entry }
            }
            EventKind::Lost { station } => Self { kind: "lost", station: Some(station), ..entry },
            EventKind::Area { groups } => {
                Self { kind: "area", groups: Some(list(groups)), ..entry }
            }
            EventKind::Tick => Self { kind: "tick", ..entry },
            EventKind::Confirm { station, group, session } => {
                message("confirm", station, group, session)
            }
            EventKind::Reject { station, group, session } => {
                message("reject", station, group, session)
            }
            EventKind::Data { station, group, session, generated_ns } => {
                let generated_ns = Some(generated_ns);
                Self { generated_ns, ..message("data", station, group, session) }
            }
            EventKind::Verdict { safe, groups } => {
                let (verdict, groups) = (Some(names::verdict(safe)), Some(list(groups)));
                Self { kind: "verdict", verdict, groups, ..entry }
            }
        };
        Self { t_ns: event.t_ns, ..filled }
    }
}

fn list(groups: Groups) -> Vec<&'static str> {
    Group::ALL.into_iter().filter(|it| groups.contains(*it)).map(names::group).collect()
}
