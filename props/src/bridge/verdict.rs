//! Verdicts from the implementation's types to the model's.

use mufasa::report as twin;
use mufasa_model::report::{
    FailedStage, Input, InvalidInput, Outcome, Reason, Report, Rule, Stage, Witness,
};

/// A report in the model's types.
pub fn report_from_impl(report: &twin::Report) -> Report {
    let twin::Report { failed_stage, stages, input } = *report;
    Report {
        failed_stage: failed_stage.map(failed_stage_from_impl),
        stages: stages.map(outcome_from_impl),
        input: input.as_ref().map(invalid_input_from_impl),
    }
}

/// A problem in the model's types; the message is the implementation's.
pub fn invalid_input_from_impl(problem: &twin::InvalidInput) -> InvalidInput {
    let twin::InvalidInput { field, index, problem } = *problem;
    InvalidInput { field: field.to_owned(), index, message: problem.message().to_owned() }
}

fn failed_stage_from_impl(failed_stage: twin::FailedStage) -> FailedStage {
    match failed_stage {
        twin::FailedStage::Input => FailedStage::Input,
        twin::FailedStage::Stage(stage) => FailedStage::Stage(stage_from_impl(stage)),
        twin::FailedStage::NoObstacleCheck => FailedStage::NoObstacleCheck,
    }
}

fn stage_from_impl(stage: twin::Stage) -> Stage {
    match stage {
        twin::Stage::I => Stage::I,
        twin::Stage::Ii => Stage::Ii,
        twin::Stage::Iii => Stage::Iii,
        twin::Stage::Iv => Stage::Iv,
        twin::Stage::V => Stage::V,
    }
}

fn outcome_from_impl(outcome: twin::Outcome) -> Outcome {
    match outcome {
        twin::Outcome::Passed => Outcome::Passed,
        twin::Outcome::Failed(witness) => Outcome::Failed(witness_from_impl(witness)),
        twin::Outcome::Skipped(reason) => Outcome::Skipped(reason_from_impl(reason)),
        twin::Outcome::NotApplicable(input) => Outcome::NotApplicable(input_from_impl(input)),
        twin::Outcome::NotScheduled => Outcome::NotScheduled,
    }
}

fn reason_from_impl(reason: twin::Reason) -> Reason {
    match reason {
        twin::Reason::AfterFailure => Reason::AfterFailure,
        twin::Reason::OtherStageRan => Reason::OtherStageRan,
        twin::Reason::NoCurrent(input) => Reason::NoCurrent(input_from_impl(input)),
    }
}

fn input_from_impl(input: twin::Input) -> Input {
    match input {
        twin::Input::Trajectory => Input::Trajectory,
        twin::Input::Tracks => Input::Tracks,
        twin::Input::Detections => Input::Detections,
        twin::Input::Grid => Input::Grid,
    }
}

fn witness_from_impl(witness: twin::Witness) -> Witness {
    let twin::Witness { rule, point, track, detection, segment, disk, cell, compared } = witness;
    Witness { rule: rule_from_impl(rule), point, track, detection, segment, disk, cell, compared }
}

fn rule_from_impl(rule: twin::Rule) -> Rule {
    match rule {
        twin::Rule::MeanCost => Rule::MeanCost,
        twin::Rule::WorkLimit => Rule::WorkLimit,
        twin::Rule::NoAssignment => Rule::NoAssignment,
        twin::Rule::Velocity => Rule::Velocity,
        twin::Rule::ThetaMap => Rule::ThetaMap,
        twin::Rule::StartTime => Rule::StartTime,
        twin::Rule::StartPosition => Rule::StartPosition,
        twin::Rule::Corridor => Rule::Corridor,
        twin::Rule::Direction => Rule::Direction,
        twin::Rule::StepTime => Rule::StepTime,
        twin::Rule::StepLength => Rule::StepLength,
        twin::Rule::StepSpeed => Rule::StepSpeed,
        twin::Rule::StepForward => Rule::StepForward,
        twin::Rule::StepLateral => Rule::StepLateral,
        twin::Rule::StepTurn => Rule::StepTurn,
        twin::Rule::ArcTooShort => Rule::ArcTooShort,
        twin::Rule::ArcTooLong => Rule::ArcTooLong,
        twin::Rule::EndsTooSoon => Rule::EndsTooSoon,
        twin::Rule::Gap => Rule::Gap,
        twin::Rule::Collision => Rule::Collision,
        twin::Rule::CollisionStanding => Rule::CollisionStanding,
        twin::Rule::Occupied => Rule::Occupied,
        twin::Rule::Unknown => Rule::Unknown,
        twin::Rule::Outside => Rule::Outside,
    }
}
