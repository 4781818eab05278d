//! The words that answers use, for their schemas; `json::names` has them for the answers.

use schemars::JsonSchema;

/// Verdict of a cycle.
#[derive(Debug, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Verdict {
    /// No stage failed.
    Safe,
    /// A stage failed.
    Unsafe,
}

/// Verdict of a line that is refused.
#[derive(Debug, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum ErrorVerdict {
    /// The only one.
    Error,
}

/// What made a cycle unsafe.
#[derive(Debug, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum FailedStage {
    /// Invalid remote data.
    Input,
    /// Track validation.
    I,
    /// Trajectory to map.
    Ii,
    /// Trajectory with tracks.
    Iii,
    /// Trajectory with detections.
    Iv,
    /// Trajectory with grid map.
    V,
    /// H-05.
    NoObstacleCheck,
}

/// Why a stage did not run.
#[derive(Debug, JsonSchema)]
#[serde(rename_all = "snake_case")]
#[expect(missing_docs, reason = "the words speak")]
pub enum Reason {
    AfterFailure,
    OtherStageRan,
    NoCurrentTrajectory,
    NoCurrentTracks,
    NoCurrentDetections,
    NoCurrentGrid,
}

/// The key of a missing input.
#[derive(Debug, JsonSchema)]
#[serde(rename_all = "snake_case")]
#[expect(missing_docs, reason = "the words speak")]
pub enum Missing {
    Trajectory,
    Tracks,
    Detections,
    Grid,
}

/// The rule of a witness, in the order of `spec/3-stages.md`.
#[derive(Debug, JsonSchema)]
#[serde(rename_all = "snake_case")]
#[expect(missing_docs, reason = "documented at `mufasa_model::report::Rule`")]
pub enum Rule {
    MeanCost,
    WorkLimit,
    NoAssignment,
    Velocity,
    ThetaMap,
    StartTime,
    StartPosition,
    Corridor,
    Direction,
    StepTime,
    StepLength,
    StepSpeed,
    StepForward,
    StepLateral,
    StepTurn,
    ArcTooShort,
    ArcTooLong,
    EndsTooSoon,
    Gap,
    Collision,
    CollisionStanding,
    Occupied,
    Unknown,
    Outside,
}

/// A message to a station.
#[derive(Debug, JsonSchema)]
#[serde(rename_all = "snake_case")]
#[expect(missing_docs, reason = "the words speak")]
pub enum Send {
    Request,
    Release,
}

/// Why no composition keeps all rules.
#[derive(Debug, JsonSchema)]
#[serde(rename_all = "snake_case")]
#[expect(missing_docs, reason = "the words speak")]
pub enum PlacementRule {
    SameStation,
    LocalOnly,
    Acyclic,
}
