//! The words that records and answers use (`spec/5-interfaces.md`, `spec/3-stages.md#schedule`).

use mufasa_model::input::cycle::Profile;
use mufasa_model::offloading::requester::Group;
use mufasa_model::report::{FailedStage, Input, Reason, Rule, Stage};
use mufasa_model::services::configuration::Configuration;

/// `paper` or `hardened`.
pub const fn profile(profile: Profile) -> &'static str {
    match profile {
        Profile::Paper => "paper",
        Profile::Hardened => "hardened",
    }
}

/// `Local`, `MotRemote`, `AllRemote` or `PlanRemote`.
pub const fn configuration(configuration: Configuration) -> &'static str {
    match configuration {
        Configuration::Local => "Local",
        Configuration::MotRemote => "MotRemote",
        Configuration::AllRemote => "AllRemote",
        Configuration::PlanRemote => "PlanRemote",
    }
}

/// `safe` or `unsafe`.
pub const fn verdict(safe: bool) -> &'static str {
    if safe { "safe" } else { "unsafe" }
}

/// `i` to `v`.
pub const fn stage(stage: Stage) -> &'static str {
    match stage {
        Stage::I => "i",
        Stage::Ii => "ii",
        Stage::Iii => "iii",
        Stage::Iv => "iv",
        Stage::V => "v",
    }
}

/// `input`, a stage, or `no_obstacle_check`.
pub const fn failed_stage(failed: FailedStage) -> &'static str {
    match failed {
        FailedStage::Input => "input",
        FailedStage::Stage(failed) => stage(failed),
        FailedStage::NoObstacleCheck => "no_obstacle_check",
    }
}

/// The key of an input in the record.
pub const fn input(input: Input) -> &'static str {
    match input {
        Input::Trajectory => "trajectory",
        Input::Tracks => "tracks",
        Input::Detections => "detections",
        Input::Grid => "grid",
    }
}

/// Why a stage was skipped.
pub const fn reason(reason: Reason) -> &'static str {
    match reason {
        Reason::AfterFailure => "after_failure",
        Reason::OtherStageRan => "other_stage_ran",
        Reason::NoCurrent(Input::Trajectory) => "no_current_trajectory",
        Reason::NoCurrent(Input::Tracks) => "no_current_tracks",
        Reason::NoCurrent(Input::Detections) => "no_current_detections",
        Reason::NoCurrent(Input::Grid) => "no_current_grid",
    }
}

/// The rule of a witness.
pub const fn rule(rule: Rule) -> &'static str {
    match rule {
        Rule::MeanCost => "mean_cost",
        Rule::WorkLimit => "work_limit",
        Rule::NoAssignment => "no_assignment",
        Rule::Velocity => "velocity",
        Rule::ThetaMap => "theta_map",
        Rule::StartTime => "start_time",
        Rule::StartPosition => "start_position",
        Rule::Corridor => "corridor",
        Rule::Direction => "direction",
        Rule::StepTime => "step_time",
        Rule::StepLength => "step_length",
        Rule::StepSpeed => "step_speed",
        Rule::StepForward => "step_forward",
        Rule::StepLateral => "step_lateral",
        Rule::StepTurn => "step_turn",
        Rule::ArcTooShort => "arc_too_short",
        Rule::ArcTooLong => "arc_too_long",
        Rule::EndsTooSoon => "ends_too_soon",
        Rule::Gap => "gap",
        Rule::Collision => "collision",
        Rule::CollisionStanding => "collision_standing",
        Rule::Occupied => "occupied",
        Rule::Unknown => "unknown",
        Rule::Outside => "outside",
    }
}

/// `mot` or `plan`.
pub const fn group(group: Group) -> &'static str {
    match group {
        Group::Mot => "mot",
        Group::Plan => "plan",
    }
}
