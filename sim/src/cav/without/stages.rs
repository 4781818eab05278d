//! The stages of the hardened profile without one rule, put together from the functions of the model, which
//! has each rule by itself. Where a rule makes a stage see more or farther, the stage is asked about a scene
//! of the paper profile instead, for that part alone.

use mufasa_model::hardened::h02_h05_h10_schedule::{no_obstacle_check, runs_whatever_else_ran};
use mufasa_model::hardened::h04_gap::failure_without_stage_iv;
use mufasa_model::hardened::h04_horizon::Places;
use mufasa_model::hardened::{
    h06_closed_cells, h09_standing, h10_explained, h11_steps, h12_progress, h13_moving,
};
use mufasa_model::input::cycle::Cycle;
use mufasa_model::input::profile::Profile;
use mufasa_model::input::scene::{Detections, Grid, Object, Point, Scene, Track, Tracks};
use mufasa_model::numbers::real::Real;
use mufasa_model::numbers::rectangle::Rectangle;
use mufasa_model::report::{
    FailedStage, Input, Outcome, Reading, Reason, Report, Rule, Stage, Witness,
};
use mufasa_model::stages::distances::{s_b, s_cav, s_valid};
use mufasa_model::stages::horizon::places_examined;
use mufasa_model::stages::i_track_validation::track_validation;
use mufasa_model::stages::ii_trajectory_to_map::trajectory_to_map;
use mufasa_model::stages::iii_tracks::trajectory_with_tracks;
use mufasa_model::stages::iv_detections::{gap_failure, trajectory_with_detections};
use mufasa_model::stages::llcc::{centre, first_collision};
use mufasa_model::stages::v_grid_map::{disk_offset, disk_radius, trajectory_with_grid_map};
use mufasa_model::stages::{Scheduled, scheduled};

use super::rule::Without;

/// A speed at which no point is too far ahead for stage v, m/s.
const FAST: i128 = 10_000_000;

/// Decides a cycle of the hardened profile with valid input, in exact numbers. With nothing left out it is
/// what the model decides (tested: `sim/tests/loop/rules.rs`).
pub fn decide(without: Without, cycle: &Cycle) -> Report {
    let scene = |profile| Scene::new(&Cycle { profile, ..cycle.clone() }, Reading::Exact);
    let (scene, mut paper) = (scene(Profile::Hardened), scene(Profile::Paper));
    if without == Without::H06 {
        // Only stage v is asked about it, at the places that H-04 chose: all of them are near enough.
        paper.ego.v_now = Real::from_integer(FAST);
    }
    let mut stages = Stages { without, scene, paper, ran: Vec::new(), failed: None };
    let outcomes = Stage::ALL.map(|stage| stages.outcome(stage));
    let failed_stage = match stages.failed {
        Some(stage) => Some(FailedStage::Stage(stage)),
        None => stages.lacks_obstacle_check().then_some(FailedStage::NoObstacleCheck),
    };
    Report { failed_stage, stages: outcomes, input: None }
}

/// One pass over the stages.
struct Stages {
    without: Without,
    /// With the hardened profile in force.
    scene: Scene,
    /// The same with the paper's.
    paper: Scene,
    ran: Vec<Stage>,
    failed: Option<Stage>,
}

impl Stages {
    fn outcome(&mut self, stage: Stage) -> Outcome {
        let scheduled = scheduled(Profile::Hardened, self.scene.configuration, stage);
        if scheduled == Scheduled::Never {
            return Outcome::NotScheduled;
        }
        if self.failed.is_some() {
            return Outcome::Skipped(Reason::AfterFailure);
        }
        let is_conditional = scheduled == Scheduled::Conditional;
        let outcome = match self.missing(stage) {
            _ if is_conditional && self.is_replaced(stage) => {
                Outcome::Skipped(Reason::OtherStageRan)
            }
            Some(input) if is_conditional => Outcome::Skipped(Reason::NoCurrent(input)),
            Some(input) => Outcome::NotApplicable(input),
            None => {
                let found = self.found(stage);
                self.ran.push(stage);
                found.map_or(Outcome::Passed, Outcome::Failed)
            }
        };
        let gap = self.hardened(Without::H04).then(|| failure_without_stage_iv(&self.scene, stage));
        let outcome = match (outcome, gap.flatten()) {
            (Outcome::Skipped(_), Some(witness)) => Outcome::Failed(witness),
            (outcome, _) => outcome,
        };
        if let Outcome::Failed(_) = outcome {
            self.failed = Some(stage);
        }
        outcome
    }

    /// Whether the rule is in force.
    fn hardened(&self, rule: Without) -> bool {
        self.without != rule
    }

    /// The scene in which the rule is in force, or is not.
    fn of(&self, rule: Without) -> &Scene {
        if self.hardened(rule) { &self.scene } else { &self.paper }
    }

    fn has_run(&self, stage: Stage) -> bool {
        self.ran.contains(&stage)
    }

    /// Whether another stage made a conditional one unnecessary.
    fn is_replaced(&self, stage: Stage) -> bool {
        let is_kept = runs_whatever_else_ran(self.of(Without::H10), stage);
        let others: &[Stage] = match stage {
            Stage::I | Stage::Ii | Stage::Iii => &[],
            Stage::Iv => &[Stage::Iii],
            Stage::V => &[Stage::Iii, Stage::Iv],
        };
        !is_kept && others.iter().any(|other| self.has_run(*other))
    }

    fn lacks_obstacle_check(&self) -> bool {
        let mut ran = self.ran.clone();
        if !self.hardened(Without::H02) {
            ran.push(Stage::I);
        }
        self.hardened(Without::H05) && no_obstacle_check(&self.scene, &ran)
    }

    /// The first input that the stage needs and that is missing.
    fn missing(&self, stage: Stage) -> Option<Input> {
        let scene = &self.scene;
        let trajectory = (Input::Trajectory, scene.trajectory.is_some());
        let detections = (Input::Detections, scene.detections.is_some());
        let needs = match stage {
            Stage::I => [(Input::Tracks, scene.tracks.is_some()), detections],
            Stage::Ii => [trajectory; 2],
            Stage::Iii => [trajectory, (Input::Tracks, scene.tracks_current)],
            Stage::Iv => [trajectory, detections],
            Stage::V => [trajectory, (Input::Grid, scene.grid.is_some())],
        };
        needs.into_iter().find(|(_, is_there)| !is_there).map(|(input, _)| input)
    }

    /// Runs a stage whose inputs are there.
    fn found(&self, stage: Stage) -> Option<Witness> {
        let scene = &self.scene;
        let (tracks, detections) = (scene.tracks.as_ref(), scene.detections.as_ref());
        let trajectory = scene.trajectory.as_deref();
        match stage {
            Stage::I => track_validation(self.of(Without::H01), tracks?, &detections?.items),
            Stage::Ii => self.ii(trajectory?),
            Stage::Iii => self.iii(trajectory?, tracks?),
            Stage::Iv => self.iv(trajectory?, detections?),
            Stage::V => self.v(trajectory?, scene.grid.as_ref()?),
        }
    }

    /// What H-07, H-11 and H-12 find comes in this order, after what the paper finds.
    fn ii(&self, trajectory: &[Point]) -> Option<Witness> {
        let found = trajectory_to_map(&self.scene, trajectory)?;
        let steps = || h11_steps::step_failure(&self.scene, trajectory);
        let progress = || h12_progress::progress_failure(&self.scene, trajectory);
        match (self.without, Without::of(found.rule)) {
            (Without::H07, Some(Without::H07)) => steps().or_else(progress),
            (Without::H11, Some(Without::H11)) => progress(),
            (Without::H12, Some(Without::H12)) => None,
            (_, _) => Some(found),
        }
    }

    fn iii(&self, trajectory: &[Point], tracks: &Tracks) -> Option<Witness> {
        if !matches!(self.without, Without::H03 | Without::H04 | Without::H09) {
            return trajectory_with_tracks(&self.scene, trajectory, tracks);
        }
        let s_cav = s_cav(&self.scene.parameters.safety_time, &self.scene.ego.v_now);
        let places = places_examined(self.of(Without::H04), trajectory, &s_cav);
        let predicted = |point: &Point, track: &Track| {
            let t_ns = i128::from(point.t_ns) - i128::from(tracks.stamp_ns);
            predicted(track, &Real::seconds(t_ns))
        };
        let (near, items) = (self.of(Without::H03), &tracks.items);
        let found = first_collision(near, Rule::Collision, places.iter(), items, predicted)
            .map(|(j, witness)| Witness { track: Some(items[j].id), ..witness });
        let standing = || h09_standing::collision_standing(near, places.iter(), tracks);
        found.or_else(|| if self.hardened(Without::H09) { standing() } else { None })
    }

    fn iv(&self, trajectory: &[Point], detections: &Detections) -> Option<Witness> {
        let beside_tracks = self.has_run(Stage::Iii);
        if !matches!(self.without, Without::H03 | Without::H04 | Without::H13) {
            return trajectory_with_detections(&self.scene, trajectory, detections, beside_tracks);
        }
        let near = self.of(Without::H03);
        let standing = || {
            let (p, ego) = (&self.scene.parameters, &self.scene.ego);
            let v_lead = self.scene.lead.as_ref().map(|lead| &lead.speed);
            let s_valid = s_valid(&ego.v_now, v_lead, &p.a_b, &p.safety_time);
            let places = places_examined(self.of(Without::H04), trajectory, &s_valid);
            if beside_tracks {
                return h10_explained::collision(near, trajectory, detections, &places);
            }
            let object = |_: &Point, detection: &Object| detection.clone();
            first_collision(near, Rule::Collision, places.iter(), &detections.items, object)
                .map(|(j, witness)| Witness { detection: Some(j), ..witness })
        };
        let moving = || h13_moving::collision_moving(near, trajectory, detections);
        let found = gap_failure(&self.scene).or_else(standing);
        found.or_else(|| if self.hardened(Without::H13) { moving() } else { None })
    }

    fn v(&self, trajectory: &[Point], grid: &Grid) -> Option<Witness> {
        let ran_iv = self.has_run(Stage::Iv);
        let s_b = s_b(&self.scene.ego.v_now, &self.scene.parameters.a_b);
        let places = places_examined(self.of(Without::H04), trajectory, &s_b);
        match self.without {
            Without::H04 => self.closed_cells(&places, grid, ran_iv),
            Without::H06 => {
                let points: Vec<Point> = places.iter().collect();
                trajectory_with_grid_map(&self.paper, &points, grid, ran_iv)
            }
            _ => trajectory_with_grid_map(&self.scene, trajectory, grid, ran_iv),
        }
    }

    /// H-06 at these places.
    fn closed_cells(&self, places: &Places<'_>, grid: &Grid, ran_iv: bool) -> Option<Witness> {
        let (ego, n) = (&self.scene.ego, self.scene.parameters.n);
        let [l, w] = [&ego.length, &ego.width];
        let number = |count: i64| Real::from_integer(count.into());
        let r = disk_radius(l, w, &number(n));
        let rules = h06_closed_cells::rules(&self.scene, grid, ran_iv);
        rules.into_iter().find_map(|(rule, reaches)| {
            places.iter().enumerate().find_map(|(i, place)| {
                let cav = Rectangle::new(centre(&self.scene, &place), l, w);
                (0..n).find_map(|disk| {
                    let along = disk_offset(&number(disk), &number(n), l);
                    let at = grid.frame.coordinates(&cav.frame.point(&along, &Real::zero()));
                    let hit = reaches(&cav, &at, &r)?;
                    let witness = Witness::new(rule, &hit.distance, &r).at_point(i);
                    let disk = usize::try_from(disk).ok();
                    Some(Witness { disk, cell: hit.cell, ..witness })
                })
            })
        })
    }
}

/// The CV model: the track moved by v t.
fn predicted(track: &Track, t: &Real) -> Object {
    let mut object = track.object.clone();
    object.frame.origin = &object.frame.origin + &track.velocity.scaled(t);
    object
}
