//! What a cycle reports, as C gets it (`spec/3-stages.md#schedule`).

use core::ffi::c_char;

use mufasa::report::{
    FailedStage, Input, InvalidInput, Outcome, Problem, Reason, Report, Rule, Stage, Witness,
};

/// What made a cycle unsafe.
#[repr(u32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MufasaFailedStage {
    /// Nothing.
    None = 0,
    /// Track validation.
    I = 1,
    /// Trajectory to map.
    Ii = 2,
    /// Trajectory with tracks.
    Iii = 3,
    /// Trajectory with detections.
    Iv = 4,
    /// Trajectory with grid map.
    V = 5,
    /// Invalid remote data.
    Input = 6,
    /// H-05: a trajectory that nothing compared with obstacles.
    NoObstacleCheck = 7,
    /// Invalid local input (`input` says what), or a call that failed.
    Error = 8,
}

/// What became of a stage.
#[repr(u32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MufasaOutcomeKind {
    /// Not part of this configuration.
    NotScheduled = 0,
    /// It ran and found nothing.
    Passed = 1,
    /// It found what `witness` says.
    Failed = 2,
    /// It did not run, for `reason`.
    Skipped = 3,
    /// It should have run and lacked `missing`.
    NotApplicable = 4,
}

/// Why a stage was skipped.
#[repr(u32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MufasaReason {
    /// It was not skipped.
    None = 0,
    /// An earlier stage failed.
    AfterFailure = 1,
    /// Another stage made it unnecessary.
    OtherStageRan = 2,
    /// `missing` says which input was not current.
    NoCurrentInput = 3,
}

/// An input that a stage lacked.
#[repr(u32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(missing_docs, reason = "the names are those of the record")]
pub enum MufasaInput {
    /// No input was missing.
    None = 0,
    Trajectory = 1,
    Tracks = 2,
    Detections = 3,
    Grid = 4,
}

/// The rule that a witness breaks; the names are those of the answers of `mufasa oracle`.
#[repr(u32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(missing_docs, reason = "mufasa::report::Rule says what each is")]
pub enum MufasaRule {
    /// There is no witness.
    None = 0,
    Ambiguous = 1,
    MeanCost = 2,
    WorkLimit = 3,
    NoAssignment = 4,
    ThetaMap = 5,
    StartTime = 6,
    Position = 7,
    StartHeading = 8,
    StartOffset = 9,
    Corridor = 10,
    Direction = 11,
    StepTime = 12,
    StepLength = 13,
    StepSpeed = 14,
    StepForward = 15,
    StepLateral = 16,
    StepTurn = 17,
    Slide = 18,
    Gap = 25,
    Collision = 26,
    Occupied = 29,
    Unknown = 30,
    Outside = 31,
    Reach = 32,
    FailSafe = 33,
}

/// Why a stage failed. Indices that mean nothing for the rule are -1.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct MufasaWitness {
    /// The rule that was broken.
    pub rule: MufasaRule,
    /// 1 when `track` means something.
    pub has_track: u32,
    /// Id of the track.
    pub track: i64,
    /// Index of the trajectory point (the later one of a step); places behind the last count on.
    pub point: i64,
    /// Index of the detection.
    pub detection: i64,
    /// Index of the item in a list of the detection history.
    pub item: i64,
    /// Age of that list, ns.
    pub age_ns: i64,
    /// Index of the segment of the reference path.
    pub segment: i64,
    /// Index of the disk.
    pub disk: i64,
    /// Column and row of the grid cell.
    pub cell: [i64; 2],
    /// The two numbers that were compared.
    pub compared: [f64; 2],
}

/// What became of one stage.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct MufasaOutcome {
    /// What became of it.
    pub kind: MufasaOutcomeKind,
    /// Of a skipped stage.
    pub reason: MufasaReason,
    /// Of a stage that lacked an input.
    pub missing: MufasaInput,
    /// Of a failed stage.
    pub witness: MufasaWitness,
}

/// Bytes of the texts of MufasaInvalidInput, the closing 0 included.
pub const MUFASA_TEXT_BYTES: usize = 96;

/// What is wrong with the input. The texts are empty when nothing is.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct MufasaInvalidInput {
    /// Dotted path of the field, such as tracks.items.vx.
    pub field: [c_char; MUFASA_TEXT_BYTES],
    /// What is wrong and what would be right.
    pub message: [c_char; MUFASA_TEXT_BYTES],
    /// Index in the innermost list, or -1.
    pub index: i64,
}

/// The answer to one cycle.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct MufasaReport {
    /// 1 when the cycle is safe, else 0: `if (report.safe)`.
    pub safe: u32,
    /// What made the cycle unsafe; NONE of a safe one.
    pub failed_stage: MufasaFailedStage,
    /// Stages i to v.
    pub stages: [MufasaOutcome; 5],
    /// The problem of invalid input, local or remote.
    pub input: MufasaInvalidInput,
}

pub(crate) const NO_WITNESS: MufasaWitness = MufasaWitness {
    rule: MufasaRule::None,
    has_track: 0,
    track: 0,
    point: -1,
    detection: -1,
    item: -1,
    age_ns: -1,
    segment: -1,
    disk: -1,
    cell: [-1, -1],
    compared: [0.0, 0.0],
};

const NOT_SCHEDULED: MufasaOutcome = MufasaOutcome {
    kind: MufasaOutcomeKind::NotScheduled,
    reason: MufasaReason::None,
    missing: MufasaInput::None,
    witness: NO_WITNESS,
};

/// The report of a cycle that could not be checked, or of invalid local input.
pub(crate) fn error(problem: Option<InvalidInput>) -> MufasaReport {
    MufasaReport {
        safe: 0,
        failed_stage: MufasaFailedStage::Error,
        stages: [NOT_SCHEDULED; 5],
        input: input(problem),
    }
}

/// The report of a cycle that was checked.
pub(crate) fn report_of(report: &Report) -> MufasaReport {
    MufasaReport {
        safe: u32::from(report.failed_stage.is_none()),
        failed_stage: failed_stage(report.failed_stage),
        stages: report.stages.map(outcome),
        input: input(report.input),
    }
}

pub(crate) fn failed_stage(failed: Option<FailedStage>) -> MufasaFailedStage {
    match failed {
        None => MufasaFailedStage::None,
        Some(FailedStage::Input) => MufasaFailedStage::Input,
        Some(FailedStage::Stage(Stage::I)) => MufasaFailedStage::I,
        Some(FailedStage::Stage(Stage::Ii)) => MufasaFailedStage::Ii,
        Some(FailedStage::Stage(Stage::Iii)) => MufasaFailedStage::Iii,
        Some(FailedStage::Stage(Stage::Iv)) => MufasaFailedStage::Iv,
        Some(FailedStage::Stage(Stage::V)) => MufasaFailedStage::V,
        Some(FailedStage::NoObstacleCheck) => MufasaFailedStage::NoObstacleCheck,
    }
}

fn outcome(outcome: Outcome) -> MufasaOutcome {
    let of = |kind| MufasaOutcome { kind, ..NOT_SCHEDULED };
    match outcome {
        Outcome::NotScheduled => NOT_SCHEDULED,
        Outcome::Passed => of(MufasaOutcomeKind::Passed),
        Outcome::Failed(it) => {
            MufasaOutcome { witness: witness(&it), ..of(MufasaOutcomeKind::Failed) }
        }
        Outcome::Skipped(reason) => {
            let (reason, missing) = match reason {
                Reason::AfterFailure => (MufasaReason::AfterFailure, MufasaInput::None),
                Reason::OtherStageRan => (MufasaReason::OtherStageRan, MufasaInput::None),
                Reason::NoCurrent(it) => (MufasaReason::NoCurrentInput, missing(it)),
            };
            MufasaOutcome { reason, missing, ..of(MufasaOutcomeKind::Skipped) }
        }
        Outcome::NotApplicable(it) => {
            MufasaOutcome { missing: missing(it), ..of(MufasaOutcomeKind::NotApplicable) }
        }
    }
}

const fn missing(input: Input) -> MufasaInput {
    match input {
        Input::Trajectory => MufasaInput::Trajectory,
        Input::Tracks => MufasaInput::Tracks,
        Input::Detections => MufasaInput::Detections,
        Input::Grid => MufasaInput::Grid,
    }
}

pub(crate) fn witness(witness: &Witness) -> MufasaWitness {
    let &Witness {
        rule: broken,
        point,
        track,
        detection,
        item,
        age_ns,
        segment,
        disk,
        cell,
        compared,
    } = witness;
    MufasaWitness {
        rule: rule(broken),
        has_track: u32::from(track.is_some()),
        track: track.unwrap_or(0),
        point: index(point),
        detection: index(detection),
        item: index(item),
        age_ns: age_ns.unwrap_or(-1),
        segment: index(segment),
        disk: index(disk),
        cell: cell.map_or([-1, -1], |(column, row)| [column, row]),
        compared,
    }
}

const fn rule(rule: Rule) -> MufasaRule {
    match rule {
        Rule::Ambiguous => MufasaRule::Ambiguous,
        Rule::MeanCost => MufasaRule::MeanCost,
        Rule::WorkLimit => MufasaRule::WorkLimit,
        Rule::NoAssignment => MufasaRule::NoAssignment,
        Rule::ThetaMap => MufasaRule::ThetaMap,
        Rule::StartTime => MufasaRule::StartTime,
        Rule::Position => MufasaRule::Position,
        Rule::StartHeading => MufasaRule::StartHeading,
        Rule::StartOffset => MufasaRule::StartOffset,
        Rule::Corridor => MufasaRule::Corridor,
        Rule::Direction => MufasaRule::Direction,
        Rule::StepTime => MufasaRule::StepTime,
        Rule::StepLength => MufasaRule::StepLength,
        Rule::StepSpeed => MufasaRule::StepSpeed,
        Rule::StepForward => MufasaRule::StepForward,
        Rule::StepLateral => MufasaRule::StepLateral,
        Rule::StepTurn => MufasaRule::StepTurn,
        Rule::Slide => MufasaRule::Slide,
        Rule::Reach => MufasaRule::Reach,
        Rule::Gap => MufasaRule::Gap,
        Rule::Collision => MufasaRule::Collision,
        Rule::FailSafe => MufasaRule::FailSafe,
        Rule::Occupied => MufasaRule::Occupied,
        Rule::Unknown => MufasaRule::Unknown,
        Rule::Outside => MufasaRule::Outside,
    }
}

fn index(index: Option<usize>) -> i64 {
    index.and_then(|index| i64::try_from(index).ok()).unwrap_or(-1)
}

/// A problem of the input for C; empty texts for none.
pub(crate) fn input(problem: Option<InvalidInput>) -> MufasaInvalidInput {
    let (field, message) = problem.map_or(("", ""), |it| (it.field, Problem::message(it.problem)));
    let index = index(problem.and_then(|it| it.index));
    MufasaInvalidInput { field: text(field), message: text(message), index }
}

/// A text with a closing 0; one that is too long is cut off.
pub(crate) fn text(text: &str) -> [c_char; MUFASA_TEXT_BYTES] {
    joined([text, ""])
}

/// Two texts as one.
pub(crate) fn joined(parts: [&str; 2]) -> [c_char; MUFASA_TEXT_BYTES] {
    let mut bytes = [0; MUFASA_TEXT_BYTES];
    let places = bytes.iter_mut().take(MUFASA_TEXT_BYTES - 1);
    for (place, byte) in places.zip(parts.iter().flat_map(|part| part.bytes())) {
        *place = c_char::from_ne_bytes([byte]);
    }
    bytes
}

#[cfg(test)]
mod tests;
