//! The rules that can be left out.

use mufasa_model::report::{FailedStage, Outcome, Report, Rule, Stage};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A rule that is left out.
#[derive(
    Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize, JsonSchema,
)]
pub enum Without {
    /// None: the guard is that of the hardened profile.
    Nothing,
    /// H-01: stage i is the paper's.
    #[serde(rename = "H-01")]
    H01,
    /// H-02: a stage iii on a list that stage i did not check counts as an obstacle check.
    #[serde(rename = "H-02")]
    H02,
    /// H-03: objects farther than `theta_obj` are not examined.
    #[serde(rename = "H-03")]
    H03,
    /// H-04: stages iii, iv and v look as far as the paper's, and where stage iv does not run the gap is not
    /// compared. `s_stop` stays what H-10, H-12 and H-13 make of it.
    #[serde(rename = "H-04")]
    H04,
    /// H-05: a trajectory that nothing compared with obstacles passes.
    #[serde(rename = "H-05")]
    H05,
    /// H-06: stage v compares with the dilated grid of the paper, in which unknown is free.
    #[serde(rename = "H-06")]
    H06,
    /// H-07: stage ii does not ask where and when a trajectory starts, and asks for the corridor as the paper.
    #[serde(rename = "H-07")]
    H07,
    /// H-08: local services stop as soon as a station answers.
    #[serde(rename = "H-08")]
    H08,
    /// H-09: no track is taken as standing.
    #[serde(rename = "H-09")]
    H09,
    /// H-10: what stage iii did keeps stage iv from running, what they did stage v.
    #[serde(rename = "H-10")]
    H10,
    /// H-11: stage ii does not ask whether a vehicle can drive the steps.
    #[serde(rename = "H-11")]
    H11,
    /// H-12: stage ii does not ask how far the trajectory gets.
    #[serde(rename = "H-12")]
    H12,
    /// H-13: stage iv does not look at detections as moving.
    #[serde(rename = "H-13")]
    H13,
}

impl Without {
    /// All that can be left out.
    pub const ALL: [Self; 13] = [
        Self::H01,
        Self::H02,
        Self::H03,
        Self::H04,
        Self::H05,
        Self::H06,
        Self::H07,
        Self::H08,
        Self::H09,
        Self::H10,
        Self::H11,
        Self::H12,
        Self::H13,
    ];

    /// Its name.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Nothing => "nothing",
            Self::H01 => "H-01",
            Self::H02 => "H-02",
            Self::H03 => "H-03",
            Self::H04 => "H-04",
            Self::H05 => "H-05",
            Self::H06 => "H-06",
            Self::H07 => "H-07",
            Self::H08 => "H-08",
            Self::H09 => "H-09",
            Self::H10 => "H-10",
            Self::H11 => "H-11",
            Self::H12 => "H-12",
            Self::H13 => "H-13",
        }
    }

    /// The rule that alone makes a stage fail with this witness. Collisions, gaps, cells and mean costs are found with
    /// and without rules.
    pub const fn of(rule: Rule) -> Option<Self> {
        match rule {
            Rule::NoAssignment => Some(Self::H01),
            Rule::Unknown | Rule::Outside => Some(Self::H06),
            Rule::StartTime
            | Rule::StartPosition
            | Rule::StartHeading
            | Rule::StartOffset
            | Rule::Corridor
            | Rule::Direction => Some(Self::H07),
            Rule::CollisionStanding => Some(Self::H09),
            Rule::StepTime
            | Rule::StepLength
            | Rule::StepSpeed
            | Rule::StepForward
            | Rule::StepLateral
            | Rule::StepTurn
            | Rule::Slide
            | Rule::TurnReversed
            | Rule::TurnOnTheSpot
            | Rule::TurnHard => Some(Self::H11),
            Rule::ArcTooShort | Rule::ArcTooLong | Rule::EndsTooSoon => Some(Self::H12),
            Rule::CollisionMoving => Some(Self::H13),
            Rule::Ambiguous
            | Rule::MeanCost
            | Rule::WorkLimit
            | Rule::ThetaMap
            | Rule::Gap
            | Rule::Collision
            | Rule::Occupied => None,
        }
    }

    /// Whether a cycle that is decided so with all rules may be decided otherwise without this one. Without H-01, H-06 or H-10
    /// one may fail that passes with it; of the others a cycle that fails at nothing of theirs stays as it is.
    pub fn may_change(self, report: &Report) -> bool {
        let ran = |stage: Stage| {
            matches!(report.stages[stage as usize], Outcome::Passed | Outcome::Failed(_))
        };
        let found = report.stages.iter().find_map(|outcome| match outcome {
            Outcome::Failed(witness) => Some(witness.rule),
            _ => None,
        });
        let by = |rules: &[Rule]| found.is_some_and(|rule| rules.contains(&rule));
        let failed = |stages: &[Stage]| {
            let is_it = |stage: &Stage| report.failed_stage == Some(FailedStage::Stage(*stage));
            stages.iter().any(is_it)
        };
        match self {
            Self::Nothing | Self::H08 => false,
            Self::H01 => ran(Stage::I),
            Self::H02 | Self::H05 => report.failed_stage == Some(FailedStage::NoObstacleCheck),
            Self::H03 => by(&[Rule::Collision, Rule::CollisionStanding, Rule::CollisionMoving]),
            Self::H04 => failed(&[Stage::Iii, Stage::Iv, Stage::V]),
            Self::H06 => ran(Stage::V),
            Self::H07 | Self::H11 | Self::H12 => failed(&[Stage::Ii]),
            Self::H09 => by(&[Rule::CollisionStanding]),
            // Where stage i could not check what stage iii ran on, H-02 asks for one of the stages that H-10 keeps.
            Self::H10 => failed(&[Stage::Iv, Stage::V]) || (ran(Stage::Iii) && !ran(Stage::I)),
            Self::H13 => failed(&[Stage::Iv]),
        }
    }
}
