//! Laws of a cycle's report (`spec/3-stages.md#schedule`).

use mufasa::input::cycle::Cycle;
use mufasa::input::profile::Profile;
use mufasa::report::{FailedStage, Outcome, Report, Rule, Stage, Witness};
use mufasa::services::configuration::Configuration;

/// A law of a cycle with valid input and its report.
pub type Law = fn(&Cycle<'_>, &Report) -> bool;

/// All laws of one report with their names.
pub const LAWS: [(&str, Law); 6] = [
    ("no_stage_runs_in_local", no_stage_runs_in_local),
    ("only_scheduled_stages_run", only_scheduled_stages_run),
    ("nothing_runs_after_a_failure", nothing_runs_after_a_failure),
    ("unsafe_exactly_when_something_failed", unsafe_exactly_when_something_failed),
    ("nothing_runs_without_its_input", nothing_runs_without_its_input),
    ("no_trajectory_is_accepted_unexamined", no_trajectory_is_accepted_unexamined),
];

/// In `Local` no stage runs, and nothing is unsafe.
pub fn no_stage_runs_in_local(cycle: &Cycle<'_>, report: &Report) -> bool {
    cycle.configuration != Configuration::Local
        || (report.failed_stage.is_none()
            && report.stages.iter().all(|outcome| *outcome == Outcome::NotScheduled))
}

/// A stage is `not_scheduled` exactly where the table has a dash; H-05 puts v into `PlanRemote`.
pub fn only_scheduled_stages_run(cycle: &Cycle<'_>, report: &Report) -> bool {
    let hardened = cycle.profile == Profile::HARDENED;
    let scheduled = match cycle.configuration {
        Configuration::Local => [false; 5],
        Configuration::MotRemote => [true, true, false, true, true],
        Configuration::AllRemote => [true; 5],
        Configuration::PlanRemote => [false, true, true, true, hardened],
    };
    report
        .stages
        .iter()
        .zip(scheduled)
        .all(|(outcome, scheduled)| (*outcome == Outcome::NotScheduled) != scheduled)
}

/// Behind the first stage that failed none ran (I-04).
pub fn nothing_runs_after_a_failure(_: &Cycle<'_>, report: &Report) -> bool {
    let mut rest = report.stages.iter().skip_while(|outcome| !failed(outcome)).skip(1);
    rest.all(|outcome| !ran(outcome))
}

/// The failed stage is the stage that failed; without one the cycle is safe or lacks an obstacle
/// check (H-05).
pub fn unsafe_exactly_when_something_failed(cycle: &Cycle<'_>, report: &Report) -> bool {
    let first = Stage::ALL.into_iter().zip(&report.stages).find(|(_, outcome)| failed(outcome));
    match (report.failed_stage, first) {
        (Some(FailedStage::Stage(named)), Some((stage, _))) => named == stage,
        (None, None) => true,
        (Some(FailedStage::NoObstacleCheck), None) => cycle.profile == Profile::HARDENED,
        (Some(FailedStage::Input), None) => report.input.is_some(),
        (Some(FailedStage::Stage(_)), None)
        | (None | Some(FailedStage::NoObstacleCheck | FailedStage::Input), Some(_)) => false,
    }
}

/// Stage i needs current detections, ii to v a current trajectory, iii current tracks, v a
/// current grid; iv fails without detections only by what stands in its place.
pub fn nothing_runs_without_its_input(cycle: &Cycle<'_>, report: &Report) -> bool {
    let current =
        |stamp_ns: Option<i64>| stamp_ns.is_some_and(|stamp_ns| is_young(cycle, stamp_ns));
    let trajectory = current(cycle.trajectory.map(|list| list.stamp_ns));
    let tracks = current(cycle.tracks.map(|list| list.stamp_ns));
    let detections = current(cycle.detections.map(|list| list.stamp_ns));
    let grid = current(cycle.grid.map(|grid| grid.stamp_ns));
    let inputs = [
        cycle.tracks.is_some() && detections,
        trajectory,
        trajectory && tracks,
        trajectory && (detections || fails_instead_of_iv(cycle, &report.stages[3])),
        trajectory && grid,
    ];
    report.stages.iter().zip(inputs).all(|(outcome, is_there)| is_there || !ran(outcome))
}

/// H-05: a safe cycle of the hardened profile with a current trajectory had one of iii, iv and v
/// run, and in `AllRemote` a iii that stage i has not checked does not count (H-02).
pub fn no_trajectory_is_accepted_unexamined(cycle: &Cycle<'_>, report: &Report) -> bool {
    let current = cycle.trajectory.is_some_and(|list| is_young(cycle, list.stamp_ns));
    if cycle.profile == Profile::PAPER
        || cycle.configuration == Configuration::Local
        || report.failed_stage.is_some()
        || !current
    {
        return true;
    }
    let [i, _, iii, iv, v] = &report.stages;
    let iii_counts = cycle.configuration != Configuration::AllRemote || ran(i);
    ran(iv) || ran(v) || (ran(iii) && iii_counts)
}

/// What the paper profile rejects the hardened one rejects too, where stage i does not tell places from
/// positions and leaves no track out (H-01): as in the scene.
pub fn hardened_accepts_nothing_that_paper_rejects(paper: &Report, hardened: &Report) -> bool {
    paper.failed_stage.is_none() || hardened.failed_stage.is_some()
}

/// Whether the outcome of stage iv is that of a rule that stands in its place where it does not run: the gap,
/// which needs a lead (H-04), and H-14, which needs an object, or in `PlanRemote` tracks and detections that
/// are too close to call.
pub fn fails_instead_of_iv(cycle: &Cycle<'_>, outcome: &Outcome) -> bool {
    let Outcome::Failed(Witness { rule, .. }) = outcome else { return false };
    let lead = cycle.lead.is_some_and(|lead| is_young(cycle, lead.stamp_ns));
    let tracks =
        cycle.tracks.is_some_and(|list| is_young(cycle, list.stamp_ns) && !list.items.is_empty());
    let detections = cycle
        .detections
        .is_some_and(|list| is_young(cycle, list.stamp_ns) && !list.items.is_empty());
    let both = cycle.configuration == Configuration::PlanRemote && tracks && detections;
    cycle.profile == Profile::HARDENED
        && (*rule == Rule::Gap && lead
            || [Rule::FailSafe, Rule::WorkLimit].contains(rule) && (tracks || detections)
            || *rule == Rule::Ambiguous && both)
}

fn is_young(cycle: &Cycle<'_>, stamp_ns: i64) -> bool {
    let age_ns = i128::from(cycle.now_ns) - i128::from(stamp_ns);
    0 <= age_ns && age_ns <= i128::from(cycle.parameters.max_age_ns)
}

fn failed(outcome: &Outcome) -> bool {
    match outcome {
        Outcome::Failed(_) => true,
        Outcome::Passed
        | Outcome::Skipped(_)
        | Outcome::NotApplicable(_)
        | Outcome::NotScheduled => false,
    }
}

fn ran(outcome: &Outcome) -> bool {
    match outcome {
        Outcome::Passed | Outcome::Failed(_) => true,
        Outcome::Skipped(_) | Outcome::NotApplicable(_) | Outcome::NotScheduled => false,
    }
}
