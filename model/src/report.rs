//! What a cycle reports: verdict, outcome of every stage, witness
//! (`spec/3-stages.md#schedule`, `spec/5-interfaces.md#cycle`).

pub use crate::input::profile::Stage;
pub use crate::numbers::reading::Reading;

use crate::numbers::real::Real;

/// What made a cycle unsafe.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum FailedStage {
    /// Invalid remote data.
    Input,
    /// A stage.
    Stage(Stage),
    /// H-05: a trajectory that nothing compared with obstacles.
    NoObstacleCheck,
}

/// A kind of input data that stages need.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Input {
    /// `trajectory`
    Trajectory,
    /// `tracks`
    Tracks,
    /// `detections`
    Detections,
    /// `grid`
    Grid,
}

/// Why a conditional stage did not run; with several reasons the first in this order.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Reason {
    /// An earlier stage failed.
    AfterFailure,
    /// Another stage made this one unnecessary.
    OtherStageRan,
    /// `no_current_trajectory`, `no_current_tracks`, `no_current_detections`, `no_current_grid`.
    NoCurrent(Input),
}

/// What became of a stage in this cycle.
#[derive(Clone, Debug, PartialEq)]
pub enum Outcome {
    /// It ran and found nothing.
    Passed,
    /// It found a safety issue.
    Failed(Witness),
    /// Conditional, or stopped by an earlier failure.
    Skipped(Reason),
    /// Scheduled always, but an input is missing.
    NotApplicable(Input),
    /// Not part of this configuration.
    NotScheduled,
}

/// The list of the rules of witnesses with their words, and the only place where they stand on this
/// side: `witness_rules!(callback)` expands to `callback! { .. }` with one entry for each, in the order
/// of `spec/`: `/// documentation` `name = word;`.
#[macro_export]
macro_rules! witness_rules {
    ($callback:ident) => {
        $callback! {
            /// A comparison is too close to call, strict only: of what the CAV saw itself (stage i, in `PlanRemote`
            /// stage iv), or whether a point is a node (stage ii).
            Ambiguous = "ambiguous";
            /// Stage i: mean assignment cost < theta_tr.
            MeanCost = "mean_cost";
            /// Stages i and iv, strict only: the assignment, or H-14, would take more work than work_limit.
            WorkLimit = "work_limit";
            /// H-01: fewer pairs closer than theta_track_max than tracks to be matched.
            NoAssignment = "no_assignment";
            /// Stage ii: farther than theta_map from the reference path and outside the corridor.
            ThetaMap = "theta_map";
            /// H-07: time of the first point not within max_age of now.
            StartTime = "start_time";
            /// H-07: a point farther from the CAV than it can have driven by then.
            Position = "position";
            /// H-07: the first heading is not the CAV's.
            StartHeading = "start_heading";
            /// H-07: the trajectory passes the CAV too far aside.
            StartOffset = "start_offset";
            /// Stage ii: a point (H-07) or a place (H-14) outside the corridor.
            Corridor = "corridor";
            /// H-07: heading against the nearest segments of the reference path.
            Direction = "direction";
            /// H-11: dt > step_max.
            StepTime = "step_time";
            /// H-11: step longer than L.
            StepLength = "step_length";
            /// H-11: step faster than v_max.
            StepSpeed = "step_speed";
            /// H-11: step against a heading.
            StepForward = "step_forward";
            /// H-11: step sideways by more than W/2.
            StepLateral = "step_lateral";
            /// H-11: headings of a step differ too much, or more than its length and time allow.
            StepTurn = "step_turn";
            /// H-11: the point is not where the headings lead.
            Slide = "slide";
            /// Stage ii, H-14: a place, or a point that is no node, is not within reach, or the path comes back.
            Reach = "reach";
            /// Stage iv: gap <= s_follow, or where it did not run (H-04) <= s_react + s_since.
            Gap = "gap";
            /// Stages iii and iv: rectangles share a point.
            Collision = "collision";
            /// Stage iv, H-14: an object meets the CAV, which goes on for tau and brakes.
            FailSafe = "fail_safe";
            /// Stage v: a disk on an occupied cell.
            Occupied = "occupied";
            /// H-06: a disk on an unknown cell.
            Unknown = "unknown";
            /// H-06: a disk beyond the border of the grid.
            Outside = "outside";
        }
    };
}

macro_rules! enumerate {
    ($($(#[$doc:meta])* $name:ident = $word:literal;)*) => {
        /// The comparison that decided a failure, in the order of `spec/`: first by rule, then by
        /// trajectory point, then by list order.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
        pub enum Rule {
            $($(#[$doc])* $name,)*
        }
    };
}

crate::witness_rules!(enumerate);

/// Why a stage failed: the rule, where, and the two numbers that were compared, as the nearest
/// doubles. `track` is an id; `point`, `detection`, `item`, `segment` (of the reference path) and `disk`
/// are list indices; `cell` is (column, row).
#[derive(Clone, Debug, PartialEq)]
pub struct Witness {
    /// The rule that was broken.
    pub rule: Rule,
    /// Index of the trajectory point (the later one of a step); the places of H-14 count on behind
    /// the last one.
    pub point: Option<usize>,
    /// Id of the track.
    pub track: Option<i64>,
    /// Index of the detection.
    pub detection: Option<usize>,
    /// Index of the item in a list of the detection history (H-14).
    pub item: Option<usize>,
    /// Age of that list, ns.
    pub age_ns: Option<i64>,
    /// Index of the segment of the reference path.
    pub segment: Option<usize>,
    /// Index of the disk.
    pub disk: Option<usize>,
    /// Column and row of the grid cell.
    pub cell: Option<(i64, i64)>,
    /// The two numbers that were compared.
    pub compared: [f64; 2],
}

impl Witness {
    /// The witness of a rule with the nearest doubles of the two numbers, and no place yet.
    pub fn new(rule: Rule, left: &Real, right: &Real) -> Self {
        Self {
            rule,
            point: None,
            track: None,
            detection: None,
            item: None,
            age_ns: None,
            segment: None,
            disk: None,
            cell: None,
            compared: [left.to_f64(), right.to_f64()],
        }
    }

    /// The witness of a rule, unless a comparison of the two numbers passes it.
    pub fn unless(passes: bool, rule: Rule, left: &Real, right: &Real) -> Option<Self> {
        (!passes).then(|| Self::new(rule, left, right))
    }

    /// The same at a trajectory point.
    #[must_use]
    pub fn at_point(self, point: usize) -> Self {
        Self { point: Some(point), ..self }
    }
}

/// A value that breaks the rules for input: the dotted path of the field without indices, the
/// innermost list index, and what is wrong.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct InvalidInput {
    /// Dotted path, such as `tracks.items.vx`.
    pub field: String,
    /// Index in the innermost list, if the value is in one.
    pub index: Option<usize>,
    /// What is wrong and what would be right.
    pub message: String,
}

/// The answer to one cycle.
#[derive(Clone, Debug, PartialEq)]
pub struct Report {
    /// `None`: the cycle is safe.
    pub failed_stage: Option<FailedStage>,
    /// Outcomes in the order of `Stage::ALL`.
    pub stages: [Outcome; 5],
    /// The problem, when `failed_stage` is `Input`.
    pub input: Option<InvalidInput>,
}

impl Report {
    /// What decided, where a stage failed.
    pub fn witness(&self) -> Option<&Witness> {
        self.stages.iter().find_map(|outcome| match outcome {
            Outcome::Failed(witness) => Some(witness),
            Outcome::Passed
            | Outcome::Skipped(_)
            | Outcome::NotApplicable(_)
            | Outcome::NotScheduled => None,
        })
    }
}
