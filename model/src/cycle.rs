//! What a cycle reports: the stages of the paper ([`crate::stages`]) as the rules of a profile change
//! them from outside ([`crate::hardened`]), by what they give a stage and by what they add behind it
//! (`spec/3-stages.md#schedule`, `spec/hardened/README.md`).

use crate::hardened::detection_history::ambiguous_failure;
use crate::hardened::h02_h05_h10_schedule::{no_obstacle_check, schedule};
use crate::hardened::h14_fail_safe::path::{self, Place};
use crate::hardened::h14_fail_safe::widening::wider_by;
use crate::hardened::h14_fail_safe::{self, meeting, reach, road};
use crate::hardened::{h01_matched_pairs, h04_gap, h06_closed_cells, h07_start, h11_steps};
use crate::input::cycle::Cycle;
use crate::input::domain::{Problem, first_problem};
use crate::input::profile::HardenedRule;
use crate::input::scene::{Grid, Point, Scene};
use crate::report::{
    FailedStage, InvalidInput, Outcome, Reading, Reason, Report, Rule, Stage, Witness,
};
use crate::stages::ii_trajectory_to_map::OnMap;
use crate::stages::{self, Scheduled, v_grid_map};
use crate::work::{self, Work};

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
/// before rejects (`props/tests/stages/readings.rs` compares). `Err` as of [`check`].
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
    let mut work = Work::default();
    let pass =
        stages::pass(scene, &schedule(scene.profile, scene.configuration), |stage, runs| {
            if runs {
                work.add(work::of_stage(scene, stage))?;
            }
            let own = if runs { failure(scene, stage) } else { None };
            match stage {
                Stage::Iv if own.is_none() => behind_stage_iv(scene, runs, &mut work),
                Stage::I | Stage::Ii | Stage::Iii | Stage::Iv | Stage::V => Ok(own),
            }
        })?;
    let failed_stage = match pass.failed {
        Some(stage) => Some(FailedStage::Stage(stage)),
        None => no_obstacle_check(scene, &pass.ran).then_some(FailedStage::NoObstacleCheck),
    };
    Ok(Report { failed_stage, stages: pass.outcomes, input: None })
}

fn invalid_remote_data(cycle: &Cycle, problem: InvalidInput) -> Report {
    let outcome = |entry: stages::Entry| match entry.scheduled {
        Scheduled::Always | Scheduled::Conditional => Outcome::Skipped(Reason::AfterFailure),
        Scheduled::Never => Outcome::NotScheduled,
    };
    Report {
        failed_stage: Some(FailedStage::Input),
        stages: schedule(cycle.profile, cycle.configuration).map(outcome),
        input: Some(problem),
    }
}

/// What fails a stage whose inputs are there.
fn failure(scene: &Scene, stage: Stage) -> Option<Witness> {
    match stage {
        Stage::I => track_validation(scene),
        Stage::Ii => trajectory_to_map(scene, scene.trajectory.as_deref()?),
        Stage::Iii | Stage::Iv => stages::failure(scene, stage),
        Stage::V => grid_map(scene, scene.trajectory.as_deref()?, scene.grid.as_ref()?),
    }
}

/// H-01 gives stage i places and what may be left out.
fn track_validation(scene: &Scene) -> Option<Witness> {
    let (tracks, detections) = (scene.tracks.as_ref()?, &scene.detections.as_ref()?.items);
    ambiguous_failure(scene, tracks).or_else(|| {
        if scene.profile.has(HardenedRule::H01) {
            h01_matched_pairs::validation(scene, tracks, detections)
        } else {
            stages::failure(scene, Stage::I)
        }
    })
}

/// H-07, H-11, and reach and road of H-14 stand behind stage ii.
fn trajectory_to_map(scene: &Scene, trajectory: &[Point]) -> Option<Witness> {
    let map = OnMap::new(scene, trajectory);
    let rules: [(HardenedRule, &dyn Fn() -> Option<Witness>); 4] = [
        (HardenedRule::H07, &|| h07_start::failure(scene, &map)),
        (HardenedRule::H11, &|| h11_steps::step_failure(scene, trajectory)),
        (HardenedRule::H14, &|| reach::failure(scene, trajectory)),
        (HardenedRule::H14, &|| road::failure(scene, &map)),
    ];
    let mut in_force = rules.iter().filter(|(rule, _)| scene.profile.has(*rule));
    map.failure(scene)
        .or_else(|| in_force.find_map(|(_, failure)| failure()))
        .or_else(|| reach::ambiguous_failure(scene, trajectory))
        .or_else(|| reach::ambiguous_end_failure(scene, trajectory))
}

/// H-04, where stage iv did not run, and H-14 stand behind stage iv.
fn behind_stage_iv(
    scene: &Scene,
    runs: bool,
    work: &mut Work,
) -> Result<Option<Witness>, InvalidInput> {
    let Some(trajectory) = scene.trajectory.as_deref() else { return Ok(None) };
    let gap = if runs { None } else { h04_gap::failure_without_stage_iv(scene) };
    if gap.is_some() || !scene.profile.has(HardenedRule::H14) {
        return Ok(gap);
    }
    work.add(work::of_fail_safe(scene, trajectory))?;
    Ok(h14_fail_safe::failure(scene, trajectory))
}

/// H-04 gives stage v the places of H-14 behind the paper's, where the CAV is as wide as there, H-06 what collides.
fn grid_map(scene: &Scene, trajectory: &[Point], grid: &Grid) -> Option<Witness> {
    let places = || {
        let points = v_grid_map::places(scene, trajectory).enumerate();
        let asks_places = scene.profile.has(HardenedRule::H04);
        let places = asks_places.then(|| {
            let widening = wider_by(scene, trajectory);
            let wider = move |place: Place| meeting::wider(scene, &widening, &place.pose);
            path::places(scene, trajectory).map(wider)
        });
        points.chain((trajectory.len()..).zip(places.into_iter().flatten()))
    };
    let first = |rule, hits: h06_closed_cells::Test| {
        v_grid_map::first_hit(scene, grid, rule, places(), hits)
    };
    if scene.profile.has(HardenedRule::H06) {
        let mut rules = h06_closed_cells::rules(scene, trajectory, grid).into_iter();
        rules.find_map(|(rule, hits)| first(rule, hits))
    } else {
        first(Rule::Occupied, Box::new(|disk| v_grid_map::dilated(scene, grid, disk)))
    }
}
