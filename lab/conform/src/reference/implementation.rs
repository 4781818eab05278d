//! Answers of the implementation in place of the model: fast, with the cautious verdict that a
//! vehicle would get (`mufasa oracle --implementation`).

use mufasa::offloading::requester as twin;
use mufasa_model::offloading::requester::{EventKind, Group};
use mufasa_model::report::InvalidInput;
use mufasa_props::bridge;
use serde_json::Value;

use mufasa_records::answer::{Answer, CycleAnswer};
use mufasa_records::offloading_answer::{OffloadingAnswer, StateAnswer};
use mufasa_records::{self as json, LineError, Record, Trace};

/// The answer to line number `number` (from 1), given without its newline, as JSON. Cycles have no
/// `strict` and `lax`; the implementation checks compositions but finds none, so they get an error.
pub fn answer(line: &[u8], number: usize) -> Value {
    let answered = json::parse(line, number).and_then(|record| {
        decide(record).map_err(|(id, problem)| LineError::new(number, Some(id), problem))
    });
    match answered {
        Ok(value) => value,
        Err(error) => value(&Answer::Error(error.into())),
    }
}

fn decide(record: Record) -> Result<Value, (String, InvalidInput)> {
    match record {
        Record::Cycle { id, cycle } => match bridge::check_impl(&cycle) {
            Ok(report) => {
                let (strict, lax) = (report.clone(), report.clone());
                let answer = CycleAnswer::new(id, report, &strict, &lax);
                let mut value = value(&Answer::Cycle(Box::new(answer)));
                if let Value::Object(object) = &mut value {
                    object.remove("strict");
                    object.remove("lax");
                }
                Ok(value)
            }
            Err(problem) => Err((id, problem)),
        },
        Record::Offloading { id, trace } => match states(&trace) {
            Ok(states) => Ok(value(&Answer::Offloading(OffloadingAnswer { id, states }))),
            Err(message) => {
                Err((id, InvalidInput { field: String::from("events"), index: None, message }))
            }
        },
        Record::Monitor { id, .. } => {
            let message = String::from(
                "sequences of the monitor are answered by the model alone: leave out --implementation",
            );
            Err((id, InvalidInput { field: String::from("kind"), index: None, message }))
        }
        Record::Composition { id, .. } => {
            let message = String::from(
                "the implementation checks compositions and finds none: leave out --implementation",
            );
            Err((id, InvalidInput { field: String::from("kind"), index: None, message }))
        }
    }
}

fn states(trace: &Trace) -> Result<Vec<StateAnswer>, String> {
    let mut stations: Vec<i64> = trace
        .events
        .iter()
        .filter_map(|event| match event.kind {
            EventKind::Offer { station, .. } => Some(station),
            EventKind::Withdraw { .. }
            | EventKind::Lost { .. }
            | EventKind::Area { .. }
            | EventKind::Tick
            | EventKind::Confirm { .. }
            | EventKind::Reject { .. }
            | EventKind::Data { .. }
            | EventKind::Verdict { .. } => None,
        })
        .collect();
    stations.sort_unstable();
    stations.dedup();
    let mut table = vec![twin::StationRecord::FREE; stations.len()];
    let profile = bridge::profile_to_impl(trace.profile);
    let parameters = bridge::parameters_to_impl(&trace.parameters);
    let mut requester =
        twin::Requester::new(profile, parameters, &mut table).map_err(|it| it.to_string())?;
    let step = |event| {
        let actions =
            requester.step(&bridge::event_to_impl(event)).map_err(|error| error.to_string())?;
        let groups = [Group::Mot, Group::Plan]
            .map(|group| bridge::state_from_impl(requester.state(bridge::group_to_impl(group))));
        let actions = actions.iter().copied().map(bridge::action_from_impl);
        Ok(StateAnswer::new(groups, requester.hold_until_ns(), actions))
    };
    trace.events.iter().map(step).collect()
}

/// Answers are plain data: they always become JSON.
fn value(answer: &Answer) -> Value {
    serde_json::to_value(answer).unwrap_or_default()
}
