//! Which stages run, in which order, and what becomes of each: paper Sec. IV-A, Fig. 3
//! (`spec/3-stages.md#schedule`). This folder is the paper's; what rules change is [`crate::cycle`].

pub mod distances;
pub mod horizon;
pub mod i_track_validation;
pub mod ii_trajectory_to_map;
pub mod iii_tracks;
pub mod iv_detections;
pub mod llcc;
pub mod v_grid_map;

use crate::input::scene::Scene;
use crate::report::{Input, Outcome, Reason, Stage, Witness};
use crate::services::configuration::Configuration;
use crate::stages::i_track_validation::track_validation;
use crate::stages::ii_trajectory_to_map::trajectory_to_map;
use crate::stages::iii_tracks::trajectory_with_tracks;
use crate::stages::iv_detections::trajectory_with_detections;
use crate::stages::v_grid_map::trajectory_with_grid_map;

/// How a configuration applies a stage.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scheduled {
    /// Always.
    Always,
    /// Only when other stages could not do its work.
    Conditional,
    /// Not at all.
    Never,
}

/// A stage in the schedule of a cycle.
#[derive(Clone, Copy, Debug)]
pub struct Entry {
    /// The stage.
    pub stage: Stage,
    /// How it is applied.
    pub scheduled: Scheduled,
    /// Where it is conditional: one of these makes it unnecessary when it ran.
    pub unless_ran: &'static [Stage],
}

/// The table of `spec/3-stages.md#schedule`.
pub fn schedule(configuration: Configuration) -> [Entry; 5] {
    use Configuration::{AllRemote, Local, MotRemote, PlanRemote};
    use Scheduled::{Always, Conditional, Never};
    Stage::ALL.map(|stage| {
        let ([mot_remote, all_remote, plan_remote], unless_ran): (_, &[Stage]) = match stage {
            Stage::I => ([Always, Always, Never], &[]),
            Stage::Ii => ([Always, Always, Always], &[]),
            Stage::Iii => ([Never, Conditional, Always], &[]),
            Stage::Iv => ([Conditional, Conditional, Conditional], &[Stage::Iii]),
            Stage::V => ([Always, Conditional, Never], &[Stage::Iii, Stage::Iv]),
        };
        let scheduled = match configuration {
            Local => Never,
            MotRemote => mot_remote,
            AllRemote => all_remote,
            PlanRemote => plan_remote,
        };
        Entry { stage, scheduled, unless_ran }
    })
}

/// One pass over the stages.
#[derive(Debug)]
pub struct Pass {
    /// What became of each.
    pub outcomes: [Outcome; 5],
    /// Which ran.
    pub ran: Vec<Stage>,
    /// Which failed.
    pub failed: Option<Stage>,
}

/// Takes the stages one after the other. `judge` says what fails a stage that is come to, and is told
/// whether that runs or is skipped; of the paper alone it is [`failure`] of a stage that runs. `Err`
/// is that of `judge`.
pub fn pass<E>(
    scene: &Scene,
    schedule: &[Entry; 5],
    mut judge: impl FnMut(Stage, bool) -> Result<Option<Witness>, E>,
) -> Result<Pass, E> {
    let not_scheduled = Stage::ALL.map(|_| Outcome::NotScheduled);
    let mut pass = Pass { outcomes: not_scheduled, ran: Vec::new(), failed: None };
    for (entry, place) in schedule.iter().zip(0..) {
        let without_it = pass.without_running(scene, entry);
        let runs = without_it.is_none();
        let failure = match without_it {
            None | Some(Outcome::Skipped(Reason::OtherStageRan | Reason::NoCurrent(_))) => {
                judge(entry.stage, runs)?
            }
            Some(_) => None,
        };
        if runs {
            pass.ran.push(entry.stage);
        }
        if failure.is_some() {
            pass.failed = Some(entry.stage);
        }
        let outcome = without_it.unwrap_or(Outcome::Passed);
        pass.outcomes[place] = failure.map_or(outcome, Outcome::Failed);
    }
    Ok(pass)
}

impl Pass {
    /// The outcome of a stage that does not run; `None`: it runs.
    fn without_running(&self, scene: &Scene, entry: &Entry) -> Option<Outcome> {
        let other_ran = || entry.unless_ran.iter().any(|other| self.ran.contains(other));
        match (entry.scheduled, missing(scene, entry.stage)) {
            (Scheduled::Never, _) => Some(Outcome::NotScheduled),
            (Scheduled::Always | Scheduled::Conditional, _) if self.failed.is_some() => {
                Some(Outcome::Skipped(Reason::AfterFailure))
            }
            (Scheduled::Conditional, _) if other_ran() => {
                Some(Outcome::Skipped(Reason::OtherStageRan))
            }
            (Scheduled::Always, Some(input)) => Some(Outcome::NotApplicable(input)),
            (Scheduled::Conditional, Some(input)) => {
                Some(Outcome::Skipped(Reason::NoCurrent(input)))
            }
            (Scheduled::Always | Scheduled::Conditional, None) => None,
        }
    }
}

/// The first input that the stage needs and that is missing.
fn missing(scene: &Scene, stage: Stage) -> Option<Input> {
    let trajectory = (Input::Trajectory, scene.trajectory.is_some());
    let detections = (Input::Detections, scene.detections.is_some());
    let needs: &[(Input, bool)] = match stage {
        // Received tracks go to stage i whatever their age.
        Stage::I => &[(Input::Tracks, scene.tracks.is_some()), detections],
        Stage::Ii => &[trajectory],
        Stage::Iii => &[trajectory, (Input::Tracks, scene.tracks_current)],
        Stage::Iv => &[trajectory, detections],
        Stage::V => &[trajectory, (Input::Grid, scene.grid.is_some())],
    };
    needs.iter().find(|(_, is_there)| !is_there).map(|(input, _)| *input)
}

/// What fails a stage whose inputs are there.
pub fn failure(scene: &Scene, stage: Stage) -> Option<Witness> {
    let trajectory = scene.trajectory.as_deref();
    let tracks = scene.tracks.as_ref();
    let detections = scene.detections.as_ref();
    match stage {
        Stage::I => track_validation(scene, tracks?, &detections?.items),
        Stage::Ii => trajectory_to_map(scene, trajectory?),
        Stage::Iii => trajectory_with_tracks(scene, trajectory?, tracks?),
        Stage::Iv => trajectory_with_detections(scene, trajectory?, detections?),
        Stage::V => trajectory_with_grid_map(scene, trajectory?, scene.grid.as_ref()?),
    }
}
