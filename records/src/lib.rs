//! Records and answers as JSON, one per line (`spec/5-interfaces.md`).

pub mod answer;
pub mod calls;
pub mod composition_answer;
pub mod error;
pub mod files;
pub mod lines;
pub mod monitor_answer;
pub mod names;
pub mod offloading_answer;
pub mod record;
pub mod schema;
pub mod witness_answer;
pub mod write;

mod order;
mod read;
mod typed;

use mufasa_model::input::cycle::Cycle;
use mufasa_model::report::InvalidInput;
use mufasa_model::services::orchestrator::{self, Task, TaskError};
use mufasa_model::services::service::ServiceSet;
use serde_json::value::RawValue;

pub use answer::Answer;
pub use error::LineError;
pub use read::Record;
pub use record::monitor::Sequence;
pub use record::offloading::Trace;
pub use typed::excerpt as shown;
pub use write::{cycle_to_line, sequence_to_line, task_to_line, trace_to_line};

use answer::CycleAnswer;
use composition_answer::CompositionAnswer;
use monitor_answer::MonitorAnswer;
use offloading_answer::OffloadingAnswer;

/// Reads the record on line number `number` (from 1), given without its newline. A record may
/// also go over several lines, of which `number` is the first.
pub fn parse(line: &[u8], number: usize) -> Result<Record, LineError> {
    let text = std::str::from_utf8(line).map_err(|error| {
        LineError::whole(number, format!("is not UTF-8 after byte {}", error.valid_up_to()))
    })?;
    if text.trim_ascii().is_empty() {
        return Err(LineError::whole(number, String::from("is blank, a record was expected")));
    }
    read::record(text).map_err(|problem| match serde_json::from_str::<&RawValue>(text) {
        Err(error) => LineError::syntax(number, &error),
        // A record that breaks the schema is still answered by its name, if it has one.
        Ok(_) => LineError::new(number, read::id(text), problem),
    })
}

/// Decides a record. `Err` is a record that cannot be answered.
pub fn decide(record: Record) -> Result<Answer, (String, InvalidInput)> {
    match record {
        Record::Cycle { id, cycle } => match CycleAnswer::decide(&id, &cycle) {
            Ok(answer) => Ok(Answer::Cycle(Box::new(answer))),
            Err(problem) => Err((id, problem)),
        },
        Record::Offloading { id, trace } => {
            Ok(Answer::Offloading(OffloadingAnswer::run(id, &trace)))
        }
        Record::Composition { id, task } => match compose(&task) {
            Ok((_, answer)) => Ok(Answer::Composition(CompositionAnswer::new(id, answer))),
            Err(problem) => Err((id, problem)),
        },
        Record::Monitor { id, sequence } => match MonitorAnswer::run(id.clone(), &sequence) {
            Ok(answer) => Ok(Answer::Monitor(answer)),
            Err(problem) => Err((id, problem)),
        },
    }
}

/// Composes a task; also gives its services as a set. Errors: the rules of a service set, a goal
/// that is no service, too many choices.
pub fn compose(task: &Task) -> Result<(ServiceSet, orchestrator::Answer), InvalidInput> {
    let services = ServiceSet::new(task.services.clone())
        .map_err(|error| composition_answer::problem(&TaskError::Services(error)))?;
    let answer =
        orchestrator::compose(task).map_err(|error| composition_answer::problem(&error))?;
    Ok((services, answer))
}

/// The answer to line number `number` (from 1), given without its newline.
pub fn answer(line: &[u8], number: usize) -> Answer {
    parse(line, number)
        .and_then(|record| {
            decide(record).map_err(|(id, problem)| LineError::new(number, Some(id), problem))
        })
        .unwrap_or_else(|error| Answer::Error(error.into()))
}

/// The cycles of a text of JSON Lines, such as a drive, with their ids. A line that is no cycle
/// is an error of its own and does not end the reading.
pub fn cycles_from_lines(text: &str) -> Vec<Result<(String, Cycle), LineError>> {
    text.lines().enumerate().map(|(index, line)| cycle_from_line(line, index + 1)).collect()
}

/// The cycle of line number `number` (from 1), given without its newline, with its id.
pub fn cycle_from_line(
    line: impl AsRef<[u8]>,
    number: usize,
) -> Result<(String, Cycle), LineError> {
    match parse(line.as_ref(), number)? {
        Record::Cycle { id, cycle } => Ok((id, *cycle)),
        Record::Offloading { id, .. }
        | Record::Composition { id, .. }
        | Record::Monitor { id, .. } => {
            let problem = InvalidInput {
                field: String::from("kind"),
                index: None,
                message: String::from("kind must be cycle"),
            };
            Err(LineError::new(number, Some(id), problem))
        }
    }
}
