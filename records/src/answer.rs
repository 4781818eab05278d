//! Answers as JSON (`spec/5-interfaces.md#cycle`).

use mufasa_model::cycle::readings;
use mufasa_model::input::cycle::Cycle;
use mufasa_model::report::{FailedStage, Input, InvalidInput, Outcome, Reason, Report};
use schemars::JsonSchema;
use serde::Serialize;

use crate::composition_answer::CompositionAnswer;
use crate::error::LineError;
use crate::monitor_answer::MonitorAnswer;
use crate::offloading_answer::OffloadingAnswer;
use crate::record::value::Word;
pub use crate::witness_answer::{InputProblem, WitnessAnswer, decimal};

/// The answer to one line.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(untagged)]
pub enum Answer {
    /// To a cycle.
    Cycle(Box<CycleAnswer>),
    /// To an offloading trace.
    Offloading(OffloadingAnswer),
    /// To a composition.
    Composition(CompositionAnswer),
    /// To a sequence of the monitor.
    Monitor(MonitorAnswer),
    /// To a line that is no record, or to a record with invalid local input.
    Error(ErrorAnswer),
}

/// The answer to one cycle.
#[derive(Clone, Debug, PartialEq, JsonSchema, Serialize)]
pub struct CycleAnswer {
    /// Id of the record.
    pub id: String,
    /// `safe` or `unsafe`, as the exact model decides.
    pub verdict: Word<bool>,
    /// `None` when the cycle is safe.
    pub failed_stage: Option<Word<FailedStage>>,
    /// Where the problem is, when the failed stage is `input`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub input: Option<InputProblem>,
    /// What became of every stage.
    pub stages: Stages,
    /// Verdict of the strict reading.
    pub strict: Word<bool>,
    /// Verdict of the lax reading.
    pub lax: Word<bool>,
}

/// The outcomes of the five stages.
#[derive(Clone, Debug, PartialEq, JsonSchema, Serialize)]
pub struct Stages {
    /// Track validation.
    pub i: StageAnswer,
    /// Trajectory to map.
    pub ii: StageAnswer,
    /// Trajectory with tracks.
    pub iii: StageAnswer,
    /// Trajectory with detections.
    pub iv: StageAnswer,
    /// Trajectory with grid map.
    pub v: StageAnswer,
}

/// The outcome of a stage.
#[derive(Clone, Debug, PartialEq, JsonSchema, Serialize)]
#[serde(tag = "outcome", rename_all = "snake_case")]
pub enum StageAnswer {
    /// It ran and found nothing.
    Passed,
    /// It found a safety issue.
    Failed {
        /// What decided.
        witness: WitnessAnswer,
    },
    /// Conditional, or stopped by an earlier failure.
    Skipped {
        /// Why.
        reason: Word<Reason>,
    },
    /// Scheduled always, but an input is missing.
    NotApplicable {
        /// Key of that input in the record.
        missing: Word<Input>,
    },
    /// Not part of this configuration.
    NotScheduled,
}

/// The answer to a line that is no record, or to a record with invalid local input.
#[derive(Clone, Debug, PartialEq, Eq, JsonSchema, Serialize)]
pub struct ErrorAnswer {
    /// Id of the record, when it could be read.
    pub id: Option<String>,
    /// Always `error`.
    pub verdict: ErrorVerdict,
    /// Always null.
    #[schemars(with = "()")]
    pub failed_stage: Option<&'static str>,
    /// What is wrong.
    pub error: ErrorProblem,
}

/// Verdict of a line that is refused.
#[derive(Clone, Copy, Debug, PartialEq, Eq, JsonSchema, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum ErrorVerdict {
    /// The only one.
    Error,
}

/// What is wrong with a line.
#[derive(Clone, Debug, PartialEq, Eq, JsonSchema, Serialize)]
pub struct ErrorProblem {
    /// Dotted path without indices; empty for the record itself.
    pub field: String,
    /// Index in the innermost list.
    pub index: Option<usize>,
    /// What is wrong and what would be right.
    pub message: String,
    /// Number of the line, from 1.
    pub line: usize,
}

impl CycleAnswer {
    /// Decides a cycle in the three readings. `Err` is invalid local input.
    pub fn decide(id: &str, cycle: &Cycle) -> Result<Self, InvalidInput> {
        let [strict, exact, lax] = readings(cycle)?;
        Ok(Self::new(id.to_owned(), exact, &strict, &lax))
    }

    /// The answer from the reports of the three readings.
    pub fn new(id: String, exact: Report, strict: &Report, lax: &Report) -> Self {
        let [i, ii, iii, iv, v] = exact.stages.each_ref().map(StageAnswer::new);
        Self {
            id,
            verdict: verdict(&exact),
            failed_stage: exact.failed_stage.map(Word),
            input: exact
                .input
                .map(|problem| InputProblem { field: problem.field, index: problem.index }),
            stages: Stages { i, ii, iii, iv, v },
            strict: verdict(strict),
            lax: verdict(lax),
        }
    }
}

impl StageAnswer {
    fn new(outcome: &Outcome) -> Self {
        match outcome {
            Outcome::Passed => Self::Passed,
            Outcome::Failed(witness) => Self::Failed { witness: WitnessAnswer::new(witness) },
            Outcome::Skipped(reason) => Self::Skipped { reason: Word(*reason) },
            Outcome::NotApplicable(input) => Self::NotApplicable { missing: Word(*input) },
            Outcome::NotScheduled => Self::NotScheduled,
        }
    }
}

impl From<LineError> for ErrorAnswer {
    fn from(error: LineError) -> Self {
        let message = error.to_string();
        let LineError { line, id, field, index, .. } = error;
        Self {
            id,
            verdict: ErrorVerdict::Error,
            failed_stage: None,
            error: ErrorProblem { field, index, message, line },
        }
    }
}

fn verdict(report: &Report) -> Word<bool> {
    Word(report.failed_stage.is_none())
}
