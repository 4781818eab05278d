//! Which stages run, in which order, and what the cycle reports (`spec/3-stages.md#schedule`).

pub mod distances;
pub mod i_track_validation;
pub mod ii_trajectory_to_map;
pub mod iii_tracks;
pub mod iv_detections;
pub mod llcc;
pub mod readings;
pub mod v_grid_map;

use crate::input::cycle::Cycle;
use crate::input::domain::{Problem, first_problem};
use crate::input::profile::Profile;
use crate::input::scene::Scene;
use crate::report::{
    FailedStage, Input, InvalidInput, Outcome, Reading, Reason, Report, Stage, Witness,
};
use crate::services::configuration::Configuration;
use crate::stages::i_track_validation::track_validation;
use crate::stages::ii_trajectory_to_map::map_validation;
use crate::stages::iii_tracks::tracks;
use crate::stages::iv_detections::{detections, gap_failure};
use crate::stages::v_grid_map::grid;

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

/// The table of `spec/3-stages.md#schedule`; hardened with H-05 and H-10.
pub fn scheduled(profile: Profile, configuration: Configuration, stage: Stage) -> Scheduled {
    use Configuration::{AllRemote, Local, MotRemote, PlanRemote};
    use Scheduled::{Always, Conditional, Never};
    let in_plan_remote_v = match profile {
        Profile::Paper => Never,
        Profile::Hardened => Conditional,
    };
    let [mot_remote, all_remote, plan_remote] = match stage {
        Stage::I => [Always, Always, Never],
        Stage::Ii => [Always, Always, Always],
        Stage::Iii => [Never, Conditional, Always],
        Stage::Iv => [Conditional, Conditional, Conditional],
        Stage::V => [Always, Conditional, in_plan_remote_v],
    };
    match configuration {
        Local => Never,
        MotRemote => mot_remote,
        AllRemote => all_remote,
        PlanRemote => plan_remote,
    }
}

/// Decides one cycle in the given reading. `Err` is invalid local input, an error to the caller.
pub fn check(cycle: &Cycle, reading: Reading) -> Result<Report, InvalidInput> {
    match first_problem(cycle) {
        Some(Problem::Local(problem)) => Err(problem),
        Some(Problem::Remote(problem)) => Ok(invalid_remote_data(cycle, problem)),
        None => Ok(decide(&Scene::new(cycle, reading))),
    }
}

/// Decides a valid cycle in exact numbers.
pub fn decide(scene: &Scene) -> Report {
    Run::new(scene).finish()
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
}

impl<'a> Run<'a> {
    fn new(scene: &'a Scene) -> Self {
        Self { scene, ran: Vec::new(), failed: None }
    }

    fn finish(mut self) -> Report {
        let stages = Stage::ALL.map(|stage| self.outcome(stage));
        let failed_stage = match self.failed {
            Some(stage) => Some(FailedStage::Stage(stage)),
            None => self.no_obstacle_check().then_some(FailedStage::NoObstacleCheck),
        };
        Report { failed_stage, stages, input: None }
    }

    fn outcome(&mut self, stage: Stage) -> Outcome {
        let scheduled = scheduled(self.scene.profile, self.scene.configuration, stage);
        if scheduled == Scheduled::Never {
            return Outcome::NotScheduled;
        }
        if self.failed.is_some() {
            return Outcome::Skipped(Reason::AfterFailure);
        }
        let other_ran = scheduled == Scheduled::Conditional && self.other_stage_ran(stage);
        let outcome = match self.missing(stage) {
            _ if other_ran => Outcome::Skipped(Reason::OtherStageRan),
            Some(input) if scheduled == Scheduled::Always => Outcome::NotApplicable(input),
            Some(input) => Outcome::Skipped(Reason::NoCurrent(input)),
            None => {
                let failure = self.run(stage);
                self.ran.push(stage);
                failure.map_or(Outcome::Passed, Outcome::Failed)
            }
        };
        let outcome = match (outcome, self.gap_failure_without_stage_iv(stage)) {
            (Outcome::Skipped(_), Some(witness)) => Outcome::Failed(witness),
            (outcome, _) => outcome,
        };
        if let Outcome::Failed(_) = outcome {
            self.failed = Some(stage);
        }
        outcome
    }

    fn has_run(&self, stage: Stage) -> bool {
        self.ran.contains(&stage)
    }

    /// A stage that makes this conditional one unnecessary ran; H-10: in the hardened `AllRemote`
    /// stage iii makes none unnecessary.
    fn other_stage_ran(&self, stage: Stage) -> bool {
        let iii_counts = self.scene.profile == Profile::Paper
            || self.scene.configuration != Configuration::AllRemote;
        let iii_ran = iii_counts && self.has_run(Stage::Iii);
        match stage {
            Stage::I | Stage::Ii | Stage::Iii => false,
            Stage::Iv => iii_ran,
            Stage::V => iii_ran || self.has_run(Stage::Iv),
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
        match stage {
            Stage::I => {
                track_validation(scene, scene.tracks.as_ref()?, scene.detections.as_deref()?)
            }
            Stage::Ii => map_validation(scene, trajectory?),
            Stage::Iii => {
                tracks(scene, trajectory?, scene.tracks.as_ref()?, self.has_run(Stage::I))
            }
            Stage::Iv => detections(scene, trajectory?, scene.detections.as_deref()?),
            Stage::V => grid(scene, trajectory?, scene.grid.as_ref()?, self.has_run(Stage::Iv)),
        }
    }

    /// H-04: at the place of stage iv the gap is compared with s_follow although the stage did not
    /// run, when a trajectory and a lead are current.
    fn gap_failure_without_stage_iv(&self, stage: Stage) -> Option<Witness> {
        let applies = self.scene.profile == Profile::Hardened
            && stage == Stage::Iv
            && self.scene.trajectory.is_some();
        applies.then(|| gap_failure(self.scene)).flatten()
    }

    /// H-05: a current trajectory that no stage compared with obstacles. H-02: in `AllRemote` a
    /// stage iii on a list that stage i did not check does not count.
    fn no_obstacle_check(&self) -> bool {
        let iii_counts =
            self.scene.configuration != Configuration::AllRemote || self.has_run(Stage::I);
        let checked = (iii_counts && self.has_run(Stage::Iii))
            || self.has_run(Stage::Iv)
            || self.has_run(Stage::V);
        self.scene.profile == Profile::Hardened
            && self.scene.configuration != Configuration::Local
            && self.scene.trajectory.is_some()
            && !checked
    }
}
