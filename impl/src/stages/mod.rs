//! Which stages run, in which order, and what the cycle reports (`spec/3-stages.md#schedule`).

pub(crate) mod distances;
pub(crate) mod examined;
pub(crate) mod i_track_validation;
pub(crate) mod ii_trajectory_to_map;
mod iii_tracks;
mod iv_detections;
pub(crate) mod llcc;
mod v_grid_map;

use crate::input::cycle::{Cycle, DetectionList, Grid, Lead, Profile, TrackList, Trajectory};
use crate::input::domain::{Fault, Usable, elapsed_ns, validate};
use crate::input::route_index::RouteIndex;
use crate::input::scratch::Scratch;
use crate::report::{FailedStage, Input, InvalidInput, Outcome, Reason, Report, Stage, Witness};
use crate::services::configuration::Configuration;
use crate::stages::i_track_validation::{previous_in_use, track_validation};
use crate::stages::ii_trajectory_to_map::map_validation;
use crate::stages::iii_tracks::tracks;
use crate::stages::iv_detections::{detections, gap};
use crate::stages::v_grid_map::grid;

/// Decides one cycle. `Err` is invalid local input, an error to the caller; invalid remote data
/// make the cycle unsafe (`spec/3-stages.md#invalid-input`).
///
/// Work, for T tracks, D detections, P points, S stations, n disks and G cells of the grid. Usually
/// each stage is linear in its lists. At most:
///
/// * input: T + D + P + S, and T^2/2 comparisons of ids that do not increase and share their low
///   twelve bits; H-09: T ids looked for in the previous list;
/// * i: a few times T D distances, which `work_limit` does not limit, and an assignment of
///   min(T, c)^2 max(T, c) steps, c = D + `miss_budget`, never more than `work_limit`;
/// * ii: P S segments and triangles, with an index only those beside each point, which on a folded
///   route may be four times as many;
/// * iii to v: in the hardened profile P is up to 4 L + 1 more, for places behind the end of the
///   trajectory (H-04);
/// * iii and iv: T P and D P pairs of rectangles (iii twice in the hardened profile, with T^2
///   comparisons of ids), each about 60 operations with error bounds;
/// * v: 2 P + log2 P bands, each of which looks at its cells, 57 at a time, and P n disks, each of which
///   looks at the square around it (in the paper profile around up to four cells), which is
///   (2 r / resolution + 3)^2 cells and at most G; twice with unknown cells.
///
/// Only stage i has a limit. The default of `work_limit`, 10^10, is above the most work there is,
/// 1024^2 * 2112 = 2.2e9 steps: no verdict of the paper depends on it. To bound the run time,
/// choose a smaller one (`docs/speed.md` has the time for a work), and for the other stages, whose
/// work follows from the sizes, limit the lists, the number of disks and of cells.
pub fn check(cycle: &Cycle<'_>, scratch: &mut Scratch<'_>) -> Result<Report, InvalidInput> {
    decide(cycle, None, scratch)
}

/// As `check`, with the index of the cycle's route: the same stations in the same memory. An index
/// of another route is not used. The answer is the same.
pub fn check_indexed<'a>(
    cycle: &Cycle<'a>,
    index: &RouteIndex<'a>,
    scratch: &mut Scratch<'_>,
) -> Result<Report, InvalidInput> {
    decide(cycle, Some(index).filter(|index| index.is_of(&cycle.route)), scratch)
}

fn decide<'a>(
    cycle: &Cycle<'a>,
    index: Option<&RouteIndex<'a>>,
    scratch: &mut Scratch<'_>,
) -> Result<Report, InvalidInput> {
    match validate(cycle, index) {
        Err(Fault::Local(problem)) => Err(problem),
        Err(Fault::Remote(problem)) => {
            let stages = Stage::ALL.map(|stage| match duty(cycle, stage) {
                Duty::Never => Outcome::NotScheduled,
                Duty::Always | Duty::Conditional => Outcome::Skipped(Reason::AfterFailure),
            });
            Ok(Report { failed_stage: Some(FailedStage::Input), stages, input: Some(problem) })
        }
        Ok(usable) => {
            scratch.fits(cycle)?;
            Ok(run(cycle, usable, index, scratch))
        }
    }
}

/// A cycle whose input is valid, for running one stage alone: to test it, or to time it.
#[derive(Debug)]
pub struct Valid<'c, 'a> {
    cycle: &'c Cycle<'a>,
    current: Current<'c, 'a>,
    previous: Option<&'c TrackList<'a>>,
    index: Option<&'c RouteIndex<'a>>,
}

impl<'c, 'a> Valid<'c, 'a> {
    /// Checks all input, local and remote, and the size of the scratch. `index`: as for
    /// `check_indexed`.
    ///
    /// Errors: the first invalid value. Source: `spec/3-stages.md#invalid-input`.
    pub fn new(
        cycle: &'c Cycle<'a>,
        index: Option<&'c RouteIndex<'a>>,
        scratch: &Scratch<'_>,
    ) -> Result<Self, InvalidInput> {
        let index = index.filter(|index| index.is_of(&cycle.route));
        let usable = validate(cycle, index)
            .map_err(|(Fault::Local(problem) | Fault::Remote(problem))| problem)?;
        scratch.fits(cycle)?;
        let received = cycle.tracks.as_ref();
        let previous =
            received.and_then(|list| previous_in_use(cycle, list, usable.previous_tracks));
        Ok(Self { cycle, current: Current::new(cycle, usable), previous, index })
    }

    /// What the stage finds on its own, whatever the schedule says about it; `NotApplicable` when
    /// an input of it is not current. Stage iv includes the gap, stage v takes stage iv as run.
    pub fn stage(&self, stage: Stage, scratch: &mut Scratch<'_>) -> Outcome {
        let Self { cycle, ref current, previous, index } = *self;
        let found = match stage {
            Stage::I => cycle.tracks.as_ref().ok_or(Input::Tracks).and_then(|tracks| {
                let detections = current.detections.ok_or(Input::Detections)?;
                Ok(track_validation(cycle, tracks, detections, previous, scratch))
            }),
            Stage::Ii => current.trajectory().map(|path| map_validation(cycle, path, index)),
            Stage::Iii => current.trajectory().and_then(|path| {
                Ok(tracks(cycle, path, current.tracks.ok_or(Input::Tracks)?, previous))
            }),
            Stage::Iv => current.trajectory().and_then(|path| {
                let list = current.detections.ok_or(Input::Detections)?;
                let too_close = current.lead.and_then(|lead| gap(cycle, lead));
                Ok(too_close.or_else(|| detections(cycle, path, list, current.lead)))
            }),
            Stage::V => current
                .trajectory()
                .and_then(|path| Ok(grid(cycle, path, current.grid.ok_or(Input::Grid)?, true))),
        };
        match found {
            Ok(None) => Outcome::Passed,
            Ok(Some(witness)) => Outcome::Failed(witness),
            Err(missing) => Outcome::NotApplicable(missing),
        }
    }
}

/// How a stage stands in the table of `spec/3-stages.md#schedule`.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Duty {
    Always,
    Conditional,
    Never,
}

/// The table; H-05 makes stage v conditional in `PlanRemote`.
fn duty(cycle: &Cycle<'_>, stage: Stage) -> Duty {
    use Configuration::{AllRemote, Local, MotRemote, PlanRemote};
    match (stage, cycle.configuration) {
        (_, Local) | (Stage::I, PlanRemote) | (Stage::Iii, MotRemote) => Duty::Never,
        (Stage::I, MotRemote | AllRemote)
        | (Stage::Ii, MotRemote | AllRemote | PlanRemote)
        | (Stage::Iii, PlanRemote)
        | (Stage::V, MotRemote) => Duty::Always,
        (Stage::Iii | Stage::V, AllRemote) | (Stage::Iv, MotRemote | AllRemote | PlanRemote) => {
            Duty::Conditional
        }
        (Stage::V, PlanRemote) => match cycle.profile {
            Profile::Paper => Duty::Never,
            Profile::Hardened => Duty::Conditional,
        },
    }
}

/// The inputs that are current.
#[derive(Debug)]
struct Current<'c, 'a> {
    trajectory: Option<&'c Trajectory<'a>>,
    tracks: Option<&'c TrackList<'a>>,
    detections: Option<&'c DetectionList<'a>>,
    lead: Option<&'c Lead>,
    grid: Option<&'c Grid<'a>>,
}

impl<'c, 'a> Current<'c, 'a> {
    fn new(cycle: &'c Cycle<'a>, usable: Usable) -> Self {
        let current = |stamp_ns: i64| {
            let age_ns = elapsed_ns(stamp_ns, cycle.now_ns);
            0 <= age_ns && age_ns <= cycle.parameters.max_age_ns
        };
        let trajectory = cycle.trajectory.as_ref().filter(|list| current(list.stamp_ns));
        Self {
            trajectory: trajectory.filter(|_| usable.trajectory),
            tracks: cycle.tracks.as_ref().filter(|list| current(list.stamp_ns)),
            detections: cycle.detections.as_ref().filter(|list| current(list.stamp_ns)),
            lead: cycle.lead.as_ref().filter(|lead| current(lead.stamp_ns)),
            grid: cycle.grid.as_ref().filter(|grid| current(grid.stamp_ns)),
        }
    }

    fn trajectory(&self) -> Result<&'c Trajectory<'a>, Input> {
        self.trajectory.ok_or(Input::Trajectory)
    }
}

/// What is known of the cycle so far.
struct Progress {
    failed: Option<FailedStage>,
    stages: [Outcome; 5],
}

impl Progress {
    /// Settles one stage. `blocked`: another stage made a conditional one unnecessary; `missing`:
    /// the first input that it lacks; `run` gives the witness of a failure. Whether it ran.
    fn settle(
        &mut self,
        (stage, duty): (Stage, Duty),
        blocked: bool,
        missing: Option<Input>,
        run: impl FnOnce() -> Option<Witness>,
    ) -> bool {
        let skipped = match (duty, missing) {
            (Duty::Never, _) => Some(Outcome::NotScheduled),
            _ if self.failed.is_some() => Some(Outcome::Skipped(Reason::AfterFailure)),
            (Duty::Conditional, _) if blocked => Some(Outcome::Skipped(Reason::OtherStageRan)),
            (Duty::Conditional, Some(input)) => Some(Outcome::Skipped(Reason::NoCurrent(input))),
            (Duty::Always, Some(input)) => Some(Outcome::NotApplicable(input)),
            (Duty::Always | Duty::Conditional, None) => None,
        };
        let outcome = skipped.unwrap_or_else(|| run().map_or(Outcome::Passed, Outcome::Failed));
        self.report(stage, outcome);
        skipped.is_none()
    }

    fn report(&mut self, stage: Stage, outcome: Outcome) {
        if matches!(outcome, Outcome::Failed(_)) {
            self.failed = Some(FailedStage::Stage(stage));
        }
        for (slot, _) in self.stages.iter_mut().zip(Stage::ALL).filter(|&(_, at)| at == stage) {
            *slot = outcome;
        }
    }
}

/// Runs the stages on valid input.
fn run<'a>(
    cycle: &Cycle<'a>,
    usable: Usable,
    index: Option<&RouteIndex<'a>>,
    scratch: &mut Scratch<'_>,
) -> Report {
    let hardened = cycle.profile == Profile::Hardened;
    let all_remote = cycle.configuration == Configuration::AllRemote;
    let current = Current::new(cycle, usable);
    let scheduled = |stage| (stage, duty(cycle, stage));
    let mut progress = Progress { failed: None, stages: [Outcome::NotScheduled; 5] };

    let received = cycle.tracks.as_ref().zip(current.detections);
    let previous =
        cycle.tracks.as_ref().and_then(|list| previous_in_use(cycle, list, usable.previous_tracks));
    let missing = lacks(&[
        (Input::Tracks, cycle.tracks.is_some()),
        (Input::Detections, current.detections.is_some()),
    ]);
    let ran_i = progress.settle(scheduled(Stage::I), false, missing, || {
        let (tracks, detections) = received?;
        track_validation(cycle, tracks, detections, previous, scratch)
    });

    let with_trajectory = (Input::Trajectory, current.trajectory.is_some());
    progress.settle(scheduled(Stage::Ii), false, lacks(&[with_trajectory]), || {
        map_validation(cycle, current.trajectory?, index)
    });

    let missing = lacks(&[with_trajectory, (Input::Tracks, current.tracks.is_some())]);
    let ran_iii = progress.settle(scheduled(Stage::Iii), false, missing, || {
        tracks(cycle, current.trajectory?, current.tracks?, previous.filter(|_| ran_i))
    });

    // H-10: in AllRemote what stage iii did keeps neither iv nor v from running.
    let iii_counts = ran_iii && !(hardened && all_remote);
    let missing = lacks(&[with_trajectory, (Input::Detections, current.detections.is_some())]);
    let ran_iv = stage_iv(cycle, &current, &mut progress, iii_counts, missing);

    let missing = lacks(&[with_trajectory, (Input::Grid, current.grid.is_some())]);
    let ran_v = progress.settle(scheduled(Stage::V), iii_counts || ran_iv, missing, || {
        grid(cycle, current.trajectory?, current.grid?, ran_iv)
    });

    // H-02: tracks that stage i could not check are no obstacle check.
    let checked_iii = ran_iii && (!all_remote || current.detections.is_some());
    let checked = checked_iii || ran_iv || ran_v;
    let local = cycle.configuration == Configuration::Local;
    if hardened && !local && progress.failed.is_none() && with_trajectory.1 && !checked {
        progress.failed = Some(FailedStage::NoObstacleCheck);
    }
    Report { failed_stage: progress.failed, stages: progress.stages, input: None }
}

/// Stage iv, and H-04: the gap is compared at its place even when it does not run. Whether it ran.
fn stage_iv(
    cycle: &Cycle<'_>,
    current: &Current<'_, '_>,
    progress: &mut Progress,
    blocked: bool,
    missing: Option<Input>,
) -> bool {
    let scheduled = (Stage::Iv, duty(cycle, Stage::Iv));
    let too_close = || current.lead.and_then(|lead| gap(cycle, lead));
    let ran = progress.settle(scheduled, blocked, missing, || {
        too_close()
            .or_else(|| detections(cycle, current.trajectory?, current.detections?, current.lead))
    });
    let compared = cycle.profile == Profile::Hardened
        && scheduled.1 != Duty::Never
        && progress.failed.is_none()
        && current.trajectory.is_some();
    if compared && !ran {
        if let Some(witness) = too_close() {
            progress.report(Stage::Iv, Outcome::Failed(witness));
        }
    }
    ran
}

/// The first of the inputs that is not there.
fn lacks(inputs: &[(Input, bool)]) -> Option<Input> {
    inputs.iter().find(|(_, present)| !present).map(|&(input, _)| input)
}
