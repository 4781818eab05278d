//! Which stages run, in which order, and what the cycle reports: paper Sec. IV-A, Fig. 3
//! (`spec/3-stages.md#schedule`, H-01, H-02, H-04, H-05, H-10, H-14).

pub mod distances;
pub mod horizon;
pub mod i_track_validation;
pub mod ii_trajectory_to_map;
pub mod iii_tracks;
pub mod iv_detections;
pub mod llcc;
pub mod v_grid_map;

use crate::hardened::detection_history::ambiguous_failure;
use crate::hardened::h01_matched_pairs;
use crate::hardened::h02_h05_h10_schedule::{
    has_stage_v_in_plan_remote, no_obstacle_check, runs_whatever_else_ran,
};
use crate::hardened::h04_gap::failure_without_stage_iv;
use crate::hardened::h14_fail_safe;
use crate::input::cycle::Cycle;
use crate::input::domain::{Problem, first_problem};
use crate::input::profile::{HardenedRule, Profile};
use crate::input::scene::Scene;
use crate::report::{
    FailedStage, Input, InvalidInput, Outcome, Reading, Reason, Report, Stage, Witness,
};
use crate::services::configuration::Configuration;
use crate::stages::i_track_validation::track_validation;
use crate::stages::ii_trajectory_to_map::trajectory_to_map;
use crate::stages::iii_tracks::trajectory_with_tracks;
use crate::stages::iv_detections::trajectory_with_detections;
use crate::stages::v_grid_map::trajectory_with_grid_map;
use crate::work::{self, Work};

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

/// The table of `spec/3-stages.md#schedule`; never what the profile leaves out.
pub fn scheduled(profile: Profile, configuration: Configuration, stage: Stage) -> Scheduled {
    use Configuration::{AllRemote, Local, MotRemote, PlanRemote};
    use Scheduled::{Always, Conditional, Never};
    let in_plan_remote_v = if has_stage_v_in_plan_remote(profile) { Conditional } else { Never };
    let [mot_remote, all_remote, plan_remote] = match stage {
        Stage::I => [Always, Always, Never],
        Stage::Ii => [Always, Always, Always],
        Stage::Iii => [Never, Conditional, Always],
        Stage::Iv => [Conditional, Conditional, Conditional],
        Stage::V => [Always, Conditional, in_plan_remote_v],
    };
    match configuration {
        _ if !profile.runs(stage) => Never,
        Local => Never,
        MotRemote => mot_remote,
        AllRemote => all_remote,
        PlanRemote => plan_remote,
    }
}

/// Decides one cycle in the given reading. `Err` is an error to the caller: invalid local input, or
/// more work than the model does (field `work`).
pub fn check(cycle: &Cycle, reading: Reading) -> Result<Report, InvalidInput> {
    match first_problem(cycle) {
        Some(Problem::Local(problem)) => Err(problem),
        Some(Problem::Remote(problem)) => Ok(invalid_remote_data(cycle, problem)),
        None => decide(&Scene::new(cycle, reading)),
    }
}

/// The reports of the strict, the exact and the lax reading. Every margin moves towards rejection in
/// the one and towards acceptance in the other, so what strict accepts exact accepts, and what exact
/// accepts lax accepts, with the same outcome of every stage: a reading is computed only where the one
/// before rejects (`props/tests/readings.rs` compares). `Err` as of [`check`].
pub fn readings(cycle: &Cycle) -> Result<[Report; 3], InvalidInput> {
    let strict = check(cycle, Reading::Strict)?;
    let next = |before: &Report, reading| match before.failed_stage {
        None => Ok(before.clone()),
        Some(_) => check(cycle, reading),
    };
    let exact = next(&strict, Reading::Exact)?;
    let lax = next(&exact, Reading::Lax)?;
    Ok([strict, exact, lax])
}

/// Decides a valid cycle in exact numbers. `Err` is more work than the model does.
pub fn decide(scene: &Scene) -> Result<Report, InvalidInput> {
    let mut run = Run { scene, ran: Vec::new(), failed: None, work: Work::default() };
    let [i, ii, iii, iv, v] = Stage::ALL;
    let stages =
        [run.outcome(i)?, run.outcome(ii)?, run.outcome(iii)?, run.outcome(iv)?, run.outcome(v)?];
    let failed_stage = match run.failed {
        Some(stage) => Some(FailedStage::Stage(stage)),
        None => no_obstacle_check(scene, &run.ran).then_some(FailedStage::NoObstacleCheck),
    };
    Ok(Report { failed_stage, stages, input: None })
}

fn invalid_remote_data(cycle: &Cycle, problem: InvalidInput) -> Report {
    let outcome = |stage| match scheduled(cycle.profile, cycle.configuration, stage) {
        Scheduled::Always | Scheduled::Conditional => Outcome::Skipped(Reason::AfterFailure),
        Scheduled::Never => Outcome::NotScheduled,
    };
    Report {
        failed_stage: Some(FailedStage::Input),
        stages: Stage::ALL.map(outcome),
        input: Some(problem),
    }
}

/// One pass over the stages.
struct Run<'a> {
    scene: &'a Scene,
    ran: Vec<Stage>,
    failed: Option<Stage>,
    work: Work,
}

impl Run<'_> {
    fn outcome(&mut self, stage: Stage) -> Result<Outcome, InvalidInput> {
        let scheduled = scheduled(self.scene.profile, self.scene.configuration, stage);
        if scheduled == Scheduled::Never {
            return Ok(Outcome::NotScheduled);
        }
        if self.failed.is_some() {
            return Ok(Outcome::Skipped(Reason::AfterFailure));
        }
        let other_ran = scheduled == Scheduled::Conditional && self.other_stage_ran(stage);
        let outcome = match self.missing(stage) {
            _ if other_ran => Outcome::Skipped(Reason::OtherStageRan),
            Some(input) if scheduled == Scheduled::Always => Outcome::NotApplicable(input),
            Some(input) => Outcome::Skipped(Reason::NoCurrent(input)),
            None => {
                self.work.add(work::of_stage(self.scene, stage))?;
                let failure = self.run(stage);
                self.ran.push(stage);
                failure.map_or(Outcome::Passed, Outcome::Failed)
            }
        };
        let failure = match (stage, &outcome) {
            (Stage::Iv, Outcome::Passed) => self.fail_safe()?,
            (Stage::Iv, Outcome::Skipped(_)) => self.in_place_of_stage_iv()?,
            _ => None,
        };
        let outcome = failure.map_or(outcome, Outcome::Failed);
        if let Outcome::Failed(_) = outcome {
            self.failed = Some(stage);
        }
        Ok(outcome)
    }

    /// H-04, then H-14, where stage iv did not run.
    fn in_place_of_stage_iv(&mut self) -> Result<Option<Witness>, InvalidInput> {
        let trajectory = self.scene.trajectory.as_ref();
        let gap = trajectory.and_then(|_| failure_without_stage_iv(self.scene));
        gap.map_or_else(|| self.fail_safe(), |witness| Ok(Some(witness)))
    }

    /// H-14.
    fn fail_safe(&mut self) -> Result<Option<Witness>, InvalidInput> {
        let scene = self.scene;
        let is_asked = scene.profile.has(HardenedRule::H14);
        let Some(trajectory) = scene.trajectory.as_deref().filter(|_| is_asked) else {
            return Ok(None);
        };
        self.work.add(work::of_fail_safe(scene, trajectory))?;
        Ok(h14_fail_safe::failure(scene, trajectory))
    }

    fn has_run(&self, stage: Stage) -> bool {
        self.ran.contains(&stage)
    }

    /// A stage that makes this conditional one unnecessary ran.
    fn other_stage_ran(&self, stage: Stage) -> bool {
        if runs_whatever_else_ran(self.scene, stage) {
            return false;
        }
        match stage {
            Stage::I | Stage::Ii | Stage::Iii => false,
            Stage::Iv => self.has_run(Stage::Iii),
            Stage::V => self.has_run(Stage::Iii) || self.has_run(Stage::Iv),
        }
    }

    /// The first input that the stage needs and that is missing.
    fn missing(&self, stage: Stage) -> Option<Input> {
        let scene = self.scene;
        let needs: &[(Input, bool)] = match stage {
            // Received tracks go to stage i whatever their age.
            Stage::I => &[
                (Input::Tracks, scene.tracks.is_some()),
                (Input::Detections, scene.detections.is_some()),
            ],
            Stage::Ii => &[(Input::Trajectory, scene.trajectory.is_some())],
            Stage::Iii => &[
                (Input::Trajectory, scene.trajectory.is_some()),
                (Input::Tracks, scene.tracks_current),
            ],
            Stage::Iv => &[
                (Input::Trajectory, scene.trajectory.is_some()),
                (Input::Detections, scene.detections.is_some()),
            ],
            Stage::V => &[
                (Input::Trajectory, scene.trajectory.is_some()),
                (Input::Grid, scene.grid.is_some()),
            ],
        };
        needs.iter().find(|(_, is_there)| !is_there).map(|(input, _)| *input)
    }

    /// Runs a stage whose inputs are there.
    fn run(&self, stage: Stage) -> Option<Witness> {
        let scene = self.scene;
        let trajectory = scene.trajectory.as_deref();
        let tracks = scene.tracks.as_ref();
        let detections = scene.detections.as_ref();
        match stage {
            Stage::I => {
                let (tracks, detections) = (tracks?, &detections?.items);
                let is_matched = scene.profile.has(HardenedRule::H01);
                let judge =
                    if is_matched { h01_matched_pairs::validation } else { track_validation };
                ambiguous_failure(scene, tracks).or_else(|| judge(scene, tracks, detections))
            }
            Stage::Ii => trajectory_to_map(scene, trajectory?),
            Stage::Iii => trajectory_with_tracks(scene, trajectory?, tracks?),
            Stage::Iv => trajectory_with_detections(scene, trajectory?, detections?),
            Stage::V => trajectory_with_grid_map(scene, trajectory?, scene.grid.as_ref()?),
        }
    }
}
