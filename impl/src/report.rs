//! What a cycle reports: verdict, outcome of every stage, witness
//! (`spec/3-stages.md#schedule`, `spec/5-interfaces.md#cycle`).

/// The five stages in their order. Source: `spec/3-stages.md`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Stage {
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
}

impl Stage {
    /// All stages in the order in which they run.
    pub const ALL: [Self; 5] = [Self::I, Self::Ii, Self::Iii, Self::Iv, Self::V];
}

/// What made a cycle unsafe. Source: `spec/3-stages.md#schedule`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum FailedStage {
    /// Invalid remote data.
    Input,
    /// A stage.
    Stage(Stage),
    /// H-05: a trajectory that nothing compared with obstacles.
    NoObstacleCheck,
}

/// A kind of input data that stages need. Source: `spec/3-stages.md#schedule`.
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

/// Why a conditional stage did not run; with several reasons the first in this order. Source:
/// `spec/3-stages.md#schedule`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
// SCHED-15
pub enum Reason {
    /// An earlier stage failed.
    AfterFailure,
    /// Another stage made this one unnecessary.
    OtherStageRan,
    /// `no_current_trajectory`, `no_current_tracks`, `no_current_detections`, `no_current_grid`.
    NoCurrent(Input),
}

/// What became of a stage in this cycle. Source: `spec/3-stages.md#schedule`.
#[derive(Clone, Copy, Debug, PartialEq)]
// SCHED-14
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

/// The comparison that decided a failure, in the order of `spec/`: first by rule, then by
/// trajectory point, then by list order.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
// SCHED-20
pub enum Rule {
    /// Stage i, in `PlanRemote` iv: a comparison of what the CAV saw itself is too close to call.
    Ambiguous,
    /// Stage i: mean assignment cost < `theta_tr`.
    MeanCost,
    /// Stages i and iv: the assignment, or H-14, would take more work than `work_limit`.
    WorkLimit,
    /// H-01: fewer pairs closer than `theta_track_max` than tracks to be matched.
    NoAssignment,
    /// Stage ii: farther than `theta_map` from the reference path and outside the corridor.
    ThetaMap,
    /// H-07: time of the first point not within `max_age` of now.
    StartTime,
    /// H-07: a point farther from the CAV than it can drive by then.
    Position,
    /// H-07: the first heading is not the CAV's.
    StartHeading,
    /// H-07: the trajectory passes the CAV too far aside.
    StartOffset,
    /// H-07: a point outside the corridor. H-14: a place.
    Corridor,
    /// H-07: heading against the nearest segments of the reference path.
    Direction,
    /// H-11: dt > `step_max`.
    StepTime,
    /// H-11: step longer than L.
    StepLength,
    /// H-11: step faster than `v_max`.
    StepSpeed,
    /// H-11: step against a heading.
    StepForward,
    /// H-11: step sideways by more than W/2.
    StepLateral,
    /// H-11: headings of a step differ too much, or more than its length and time allow.
    StepTurn,
    /// H-11: the point is not where the headings lead.
    Slide,
    /// H-14: a point or place is beyond what the CAV can drive, or the path is too long.
    Reach,
    /// Stage iv: gap <= `s_follow`; H-04: gap <= `s_react` + `s_since`.
    Gap,
    /// Stages iii and iv: rectangles share a point.
    Collision,
    /// Stage iv, H-14: an object may be where the CAV is when it goes on and then brakes.
    FailSafe,
    /// Stage v: a disk on an occupied cell.
    Occupied,
    /// H-06: a disk on an unknown cell.
    Unknown,
    /// H-06: a disk beyond the border of the grid.
    Outside,
}

/// Why a stage failed: the rule, where, and the two numbers that were compared, as the nearest
/// doubles. `track` is an id; `point`, `detection`, `item`, `segment` (of the reference path) and `disk`
/// are list indices; `cell` is (column, row). Source: `spec/3-stages.md#schedule`.
#[derive(Clone, Copy, Debug, PartialEq)]
// SCHED-19
pub struct Witness {
    /// The rule that was broken.
    pub rule: Rule,
    /// Index of the trajectory point (the later one of a step); the places of H-14 count as
    /// points behind the last.
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
    /// A witness that names only the rule and the two numbers.
    pub(crate) const fn of(rule: Rule, compared: [f64; 2]) -> Self {
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
            compared,
        }
    }

    /// The same witness at a trajectory point.
    pub(crate) const fn at_point(self, index: usize) -> Self {
        Self { point: Some(index), ..self }
    }
}

/// What is wrong with a value. Source: `spec/3-stages.md#invalid-input`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Problem {
    /// NaN or infinite where a number has to be given.
    NotFinite,
    /// Outside the domain of `spec/4-arithmetic.md#domain`.
    OutOfDomain,
    /// A direction with `abs(cos^2 + sin^2 - 1)` above 1e-6.
    NotADirection,
    /// A time more than 60 s from now.
    TimeOutOfRange,
    /// The id of an earlier track of the list.
    DuplicateId,
    /// The same reference point as the cross section before.
    EqualPoints,
    /// A time not later than that of the point before.
    TimeNotIncreasing,
    /// A stamp not earlier than that of the list before.
    StampNotDecreasing,
    /// Fewer items than the list has to have.
    TooFew,
    /// More items than the list may have.
    TooMany,
    /// A bitmap with another number of bytes than its grid needs.
    BitmapLength,
    /// Scratch memory smaller than `scratch::Sizes` asks for, or less memory lent to a monitor than what
    /// came needs.
    ScratchTooSmall,
    /// The monitor was never given a route.
    NoRoute,
    /// Something is remote, and the monitor had no tick since the cycle before, or one of another time.
    NoTick,
}

impl Problem {
    /// What is wrong and what would be right, in words. Source: `spec/3-stages.md#invalid-input`.
    pub const fn message(self) -> &'static str {
        match self {
            Self::NotFinite => "not a finite number; give a finite one",
            Self::OutOfDomain => "outside the domain; see spec/4-arithmetic.md#domain",
            Self::NotADirection => "not a direction; cos^2 + sin^2 has to be within 1e-6 of 1",
            Self::TimeOutOfRange => "more than 60 s from now; give a time within 60 s",
            Self::DuplicateId => "an earlier track has this id; give every track its own",
            Self::EqualPoints => "equal to the reference point before; drop one of the two",
            Self::TimeNotIncreasing => "not later than the point before; order the points by time",
            Self::StampNotDecreasing => {
                "not earlier than the list before; order the lists from the youngest on"
            }
            Self::TooFew => "too few items; see spec/3-stages.md#invalid-input",
            Self::TooMany => "too many items; see spec/4-arithmetic.md#domain",
            Self::BitmapLength => "wrong length; give ceil(width * height / 8) bytes",
            Self::ScratchTooSmall => {
                "more than the lent memory holds; see scratch::Sizes::for_cycle, monitor::Memory"
            }
            Self::NoRoute => "no route was set; give the monitor one before its first cycle",
            Self::NoTick => {
                "no tick of this time came since the cycle before; tick in each period, whatever came"
            }
        }
    }
}

/// A value that breaks the rules for input: the dotted path of the field without indices, the
/// innermost list index, and what is wrong. Source: `spec/3-stages.md#invalid-input`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct InvalidInput {
    /// Dotted path, such as `tracks.items.vx`.
    pub field: &'static str,
    /// Index in the innermost list, if the value is in one.
    pub index: Option<usize>,
    /// What is wrong.
    pub problem: Problem,
}

impl core::fmt::Display for InvalidInput {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        let Self { field, index, problem } = *self;
        match index {
            Some(index) => write!(f, "{field}, item {index}: {}", problem.message()),
            None => write!(f, "{field}: {}", problem.message()),
        }
    }
}

impl core::error::Error for InvalidInput {}

/// The answer to one cycle. Source: `spec/3-stages.md#schedule`.
#[derive(Clone, Copy, Debug, PartialEq)]
#[must_use = "a report may say that the cycle is unsafe"]
pub struct Report {
    /// `None`: the cycle is safe.
    pub failed_stage: Option<FailedStage>,
    /// Outcomes in the order of `Stage::ALL`.
    pub stages: [Outcome; 5],
    /// The problem, when `failed_stage` is `Input`.
    pub input: Option<InvalidInput>,
}
