//! One record: asked, decided by the model, and compared
//! (`spec/4-arithmetic.md#conformance-of-an-implementation`).

use mufasa_model::cycle::check;
use mufasa_model::input::cycle::Cycle;
use mufasa_model::report::{FailedStage, InvalidInput, Outcome, Reading, Stage};
use mufasa_props::conformance::{Answer, Disagreement, is_too_much, name, rank, stage_conforms};
use serde_json::{Map, Value};

use crate::cases::question::Question;
use crate::error::ConformError;
use crate::judge::answer::{self, Said, names_another};
use crate::judge::class::{Breach, Class, Kind, Scale};
use crate::judge::norm;
use crate::judge::states::States;
use crate::subject::{Broken, Subject};
use mufasa_records::composition_answer::CompositionAnswer;
use mufasa_records::{self as json, LineError, compose, names};

/// Margin within which a disagreement counts as one at the threshold, m.
const ROUNDING_M: f64 = 1e-6;

/// What the model says.
#[derive(Clone, Debug)]
pub enum Expected {
    /// Of a cycle, exactly.
    Cycle(Box<Answer>),
    /// Of a trace or a monitor; `Err` is a setting that is refused.
    States(Result<States, InvalidInput>),
    /// Of a composition; `Err` is invalid input.
    Composition(Result<CompositionAnswer, InvalidInput>),
    /// What is wrong with a line; nothing, when it was made so small that nothing is.
    Line(Option<LineError>),
}

/// A record, asked and compared.
#[derive(Clone, Debug)]
pub struct Examined {
    /// The model's answer.
    pub expected: Expected,
    /// The line that came back, or what came instead.
    pub answered: Result<Vec<u8>, Broken>,
    /// The answer's breach of conformance, if any.
    pub class: Option<Class>,
    /// Whether only the tolerance makes the answer conform.
    pub tolerated: bool,
}

impl Examined {
    /// Whether no answer came in time.
    pub fn hangs(&self) -> bool {
        matches!(&self.answered, Err(broken) if broken.breach == Breach::Hangs)
    }
}

/// Asks a record under this id. A disagreement that a margin of `tolerance` m explains is none.
/// Errors: the program cannot be started again.
pub fn ask_and_compare(
    subject: &mut Subject,
    id: &str,
    question: &Question,
    tolerance: Option<f64>,
) -> Result<Examined, ConformError> {
    let (expected, answered) = subject.ask(&question.line(id), || expect(id, question))?;
    let compared = match &answered {
        Ok(line) => answer::object(line, question.id(id), question.kind() != Kind::Line)
            .and_then(|object| Ok((compare(question, &expected, &object)?, object)))
            .map_err(|broken| subject.broke(broken)),
        Err(broken) => Err(broken.clone()),
    };
    let (profile, configuration) = question.setting();
    let class = |breach, place, profile: &str, configuration: &str, scale| Class {
        kind: question.kind(),
        breach,
        place,
        profile: profile.to_owned(),
        configuration: configuration.to_owned(),
        scale,
    };
    Ok(match compared {
        Ok((None, _)) => Examined { expected, answered, class: None, tolerated: false },
        Ok((Some(differs), object)) => {
            let explains = |margin| is_explained(question, &differs, &object, margin);
            let tolerated = tolerance.is_some_and(explains);
            let scale = if explains(ROUNDING_M) { Scale::Threshold } else { Scale::Clear };
            let class = class(differs.breach, differs.place, profile, configuration, scale);
            Examined { expected, answered, class: Some(class).filter(|_| !tolerated), tolerated }
        }
        Err(broken) => {
            let class = class(broken.breach, question.wrong().to_owned(), "", "", Scale::Clear);
            Examined { expected, answered: Err(broken), class: Some(class), tolerated: false }
        }
    })
}

/// The model's answer to a record with this id.
pub fn expect(id: &str, question: &Question) -> Expected {
    match question {
        Question::Cycle(cycle) => Expected::Cycle(Box::new(check(cycle, Reading::Exact))),
        Question::Offloading(trace) => Expected::States(Ok(States::of_trace(trace))),
        Question::Monitor(sequence) => Expected::States(States::of_sequence(sequence)),
        Question::Composition(task) => {
            let composed = compose(task);
            let answer = |(_, answer)| CompositionAnswer::new(id.to_owned(), answer);
            Expected::Composition(composed.map(answer))
        }
        Question::Text(text) => Expected::Line(text.error()),
        Question::Line(damaged) => {
            Expected::Line(json::parse(damaged.line(id).as_bytes(), 1).err())
        }
    }
}

/// A difference.
struct Differs {
    breach: Breach,
    place: String,
    /// The answer to a cycle, where that is what differs.
    said: Option<Said>,
}

impl Differs {
    fn new(breach: Breach, place: impl Into<String>) -> Self {
        Self { breach, place: place.into(), said: None }
    }
}

/// Whether a margin explains a difference, or the rounding of the norms of directions does.
fn is_explained(
    question: &Question,
    differs: &Differs,
    object: &Map<String, Value>,
    margin_m: f64,
) -> bool {
    let (Question::Cycle(cycle), Some(said)) = (question, differs.said) else { return false };
    let conforms = |cycle: Cycle| {
        let exact = check(&cycle, Reading::Exact);
        compare_cycle(&cycle, &exact, said, object)
            .is_none_or(|differs| is_moved(&cycle, &differs, margin_m))
    };
    is_moved(cycle, differs, margin_m) || norm::either_way(cycle).any(conforms)
}

/// Whether a margin explains a difference in the answer to a cycle: it moves no bound of a domain.
fn is_moved(cycle: &Cycle, differs: &Differs, margin_m: f64) -> bool {
    let is_of_input = differs.breach == Breach::Input;
    !is_of_input && differs.said.is_some_and(|said| is_within(cycle, said, margin_m))
}

fn compare(
    question: &Question,
    expected: &Expected,
    object: &Map<String, Value>,
) -> Result<Option<Differs>, Broken> {
    match (question, expected) {
        (Question::Cycle(cycle), Expected::Cycle(exact)) => {
            Ok(compare_cycle(cycle, exact, answer::said(object)?, object))
        }
        (_, Expected::States(expected)) => compare_states(expected, object),
        (Question::Composition(_), Expected::Composition(expected)) => {
            compare_compositions(expected, object)
        }
        (Question::Line(_) | Question::Text(_), Expected::Line(Some(expected))) => {
            Ok(compare_errors(question.wrong(), expected, object))
        }
        // `expect` answers in kind; a line that was made smaller may have become a record.
        (_, _) => Ok(None),
    }
}

fn compare_cycle(
    cycle: &Cycle,
    exact: &Answer,
    said: Said,
    object: &Map<String, Value>,
) -> Option<Differs> {
    if is_too_much(exact) {
        return None;
    }
    compare_verdict(cycle, exact, said).or_else(|| compare_place(exact, said, object))
}

fn compare_verdict(cycle: &Cycle, exact: &Answer, said: Said) -> Option<Differs> {
    let input = |place| Some(Differs { breach: Breach::Input, place, said: Some(said) });
    let (report, said) = match (exact, said) {
        (Err(_), Said::Error) => return None,
        (Err(problem), Said::Verdict(said)) => {
            let said = said.map_or("safe", |failed| name(Some(failed)));
            return input(format!("{} {said} instead of error", part(problem)));
        }
        (Ok(report), Said::Error) => {
            return input(format!("error instead of {}", name(report.failed_stage)));
        }
        (Ok(report), Said::Verdict(said)) => (report, said),
    };
    let exact = report.failed_stage;
    if said == exact {
        return None;
    }
    let strict = check(cycle, Reading::Strict).ok().and_then(|report| report.failed_stage);
    let (breach, place) = match stage_conforms(exact, strict, said).err()? {
        Disagreement::UnsafeAccepted { exact } => {
            let mut place = name(Some(exact)).to_owned();
            if let FailedStage::Stage(stage) = exact
                && let Outcome::Failed(witness) = &report.stages[index(stage)]
            {
                place = format!("{place} {}", names::rule(witness.rule));
            } else if let Some(problem) = &report.input {
                place = format!("{place} {}", part(problem));
            }
            (Breach::Soundness, place)
        }
        Disagreement::SafeRejected { implementation } => {
            (Breach::Completeness, name(Some(implementation)).to_owned())
        }
        Disagreement::WrongStage { .. }
        | Disagreement::WrongInput { .. }
        | Disagreement::ModelUnordered { .. } => {
            (Breach::Stage, format!("{} instead of {}", name(said), name(exact)))
        }
    };
    Some(Differs { breach, place, said: Some(Said::Verdict(said)) })
}

/// Invalid input: an answer that names a place must name the right one.
fn compare_place(exact: &Answer, said: Said, object: &Map<String, Value>) -> Option<Differs> {
    let (key, problem) = match exact {
        Err(problem) => ("error", problem),
        Ok(report) => ("input", report.input.as_ref()?),
    };
    let wrong = names_another(object.get(key), &problem.field, problem.index);
    let place = || format!("{} at another place", part(problem));
    wrong.then(|| Differs { breach: Breach::Input, place: place(), said: Some(said) })
}

/// Place of a stage in a report.
pub fn index(stage: Stage) -> usize {
    Stage::ALL.iter().position(|it| *it == stage).unwrap_or(0)
}

/// The input that a problem is in: the first word of its path.
fn part(problem: &InvalidInput) -> &str {
    problem.field.split('.').next().unwrap_or(&problem.field)
}

/// Whether the model with this margin could fail at this stage: it lies between the strict and
/// the lax reading.
pub fn is_within(cycle: &Cycle, said: Said, margin_m: f64) -> bool {
    let Said::Verdict(said) = said else { return false };
    let mut cycle = cycle.clone();
    cycle.parameters.delta = margin_m;
    let at = |reading| check(&cycle, reading).map(|report| rank(report.failed_stage));
    match (at(Reading::Strict), at(Reading::Lax)) {
        (Ok(strict), Ok(lax)) => (strict..=lax).contains(&rank(said)),
        (Err(_), _) | (_, Err(_)) => false,
    }
}

fn compare_states(
    expected: &Result<States, InvalidInput>,
    object: &Map<String, Value>,
) -> Result<Option<Differs>, Broken> {
    let differs = |place: &str| Ok(Some(Differs::new(Breach::States, place)));
    let expected = match (expected, answer::is_error(object)) {
        (Err(problem), _) if problem.field == "work" => return Ok(None),
        (Err(problem), true) => {
            let wrong = names_another(object.get("error"), &problem.field, problem.index);
            return if wrong { differs("error at another place") } else { Ok(None) };
        }
        (Err(problem), false) => return differs(&format!("{} is not refused", problem.field)),
        (Ok(_), true) => return differs("error"),
        (Ok(expected), false) => expected,
    };
    let states = answer::list(object, "states")?;
    if let Some(it) = expected.first_difference(states) {
        return differs(&format!("{} after {}", it.field.replace('/', "."), it.event));
    }
    if states.len() == expected.list.len() { Ok(None) } else { differs("number of states") }
}

fn compare_compositions(
    expected: &Result<CompositionAnswer, InvalidInput>,
    object: &Map<String, Value>,
) -> Result<Option<Differs>, Broken> {
    let differs = |place| Ok(Some(Differs::new(Breach::Compositions, place)));
    let expected = match (expected, answer::is_error(object)) {
        (Err(problem), true) => {
            let wrong = names_another(object.get("error"), &problem.field, problem.index);
            return if wrong { differs("error at another place") } else { Ok(None) };
        }
        (Err(_), false) => return differs("invalid input taken for valid"),
        (Ok(_), true) => return differs("error"),
        (Ok(expected), false) => serde_json::to_value(expected).unwrap_or_default(),
    };
    let found = answer::list(object, "compositions")?;
    let wanted = expected.get("compositions").and_then(Value::as_array);
    let wanted = wanted.map_or(&[][..], Vec::as_slice);
    if found.iter().any(|it| !wanted.contains(it)) {
        return differs("one that is none, or in another form");
    }
    if wanted.iter().any(|it| !found.contains(it)) {
        return differs("one is missing");
    }
    if found != wanted {
        return differs("order or repetition");
    }
    if object.get("none").unwrap_or(&Value::Null) != expected.get("none").unwrap_or(&Value::Null) {
        return differs("none");
    }
    Ok(None)
}

/// A line that is no record must be an error; an answer that names a place must name the right one.
fn compare_errors(
    wrong: &str,
    expected: &LineError,
    object: &Map<String, Value>,
) -> Option<Differs> {
    if !answer::is_error(object) {
        return Some(Differs::new(Breach::Schema, wrong));
    }
    names_another(object.get("error"), &expected.field, expected.index)
        .then(|| Differs::new(Breach::Schema, format!("{wrong} at another place")))
}

#[cfg(test)]
mod tests;
