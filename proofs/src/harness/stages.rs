//! The stages on arbitrary numbers, also invalid, NaN and infinite ones: none panics, every loop
//! ends, and what is reported follows the schedule.

use mufasa::configuration::Configuration;
use mufasa::cycle::Cycle;
use mufasa::schedule::check;
use mufasa::scratch::{Column, Row, Scratch, Sizes};
use mufasa::verdict::{FailedStage, Input, Outcome, Problem, Report};

use super::any::{index, profile};
use super::bounds::{DETECTIONS, DISKS, TRACKS};
use super::schedule::assert_scheduled;
use super::world::World;
#[cfg(not(kani))]
use crate::kani;

/// Stage i, with H-01 and H-09, panics at no input, refuses only what is invalid or does not fit
/// the scratch, and reports what the schedule says.
///
/// Domain: any numbers of 64 bits, lists up to the bounds, any scratch, both profiles, `MotRemote`.
/// Not covered: longer lists, other configurations.
#[cfg_attr(kani, kani::proof)]
#[cfg_attr(kani, kani::unwind(37))]
pub fn verify_stage_i_never_panics() {
    let world = World::any();
    let holds = [Input::Tracks, Input::Detections];
    let cycle = world.cycle(profile(), Configuration::MotRemote, &holds);
    let outcome = checked(&cycle).map(|report| report.stages[0]);
    kani::cover!(outcome == Some(Outcome::Passed), "passed");
    kani::cover!(matches!(outcome, Some(Outcome::Failed(_))), "failed");
    kani::cover!(outcome.is_none(), "refused");
}

/// Stage ii, with H-07, H-11 and H-12, panics at no input, refuses only what is invalid or does not
/// fit the scratch, and reports what the schedule says.
///
/// Domain: any numbers of 64 bits, lists up to the bounds, any scratch, both profiles,
/// `PlanRemote`. Not covered: longer lists, other configurations.
#[cfg_attr(kani, kani::proof)]
#[cfg_attr(kani, kani::unwind(37))]
pub fn verify_stage_ii_never_panics() {
    let world = World::any();
    let holds = [Input::Trajectory];
    let cycle = world.cycle(profile(), Configuration::PlanRemote, &holds);
    let outcome = checked(&cycle).map(|report| report.stages[1]);
    kani::cover!(outcome == Some(Outcome::Passed), "passed");
    kani::cover!(matches!(outcome, Some(Outcome::Failed(_))), "failed");
    kani::cover!(outcome.is_none(), "refused");
}

/// Stage iii, with H-09, panics at no input, refuses only what is invalid or does not fit the
/// scratch, and reports what the schedule says.
///
/// Domain: any numbers of 64 bits, lists up to the bounds, any scratch, both profiles, `AllRemote`.
/// Not covered: longer lists, other configurations.
#[cfg_attr(kani, kani::proof)]
#[cfg_attr(kani, kani::unwind(37))]
pub fn verify_stage_iii_never_panics() {
    let world = World::any();
    let holds = [Input::Trajectory, Input::Tracks];
    let cycle = world.cycle(profile(), Configuration::AllRemote, &holds);
    let outcome = checked(&cycle).map(|report| report.stages[2]);
    kani::cover!(outcome == Some(Outcome::Passed), "passed");
    kani::cover!(matches!(outcome, Some(Outcome::Failed(_))), "failed");
    kani::cover!(outcome.is_none(), "refused");
}

/// Stage iv, with H-04, panics at no input, refuses only what is invalid or does not fit the
/// scratch, and reports what the schedule says.
///
/// Domain: any numbers of 64 bits, lists up to the bounds, any scratch, both profiles,
/// `PlanRemote`. Not covered: longer lists, other configurations.
#[cfg_attr(kani, kani::proof)]
#[cfg_attr(kani, kani::unwind(37))]
pub fn verify_stage_iv_never_panics() {
    let world = World::any();
    let holds = [Input::Trajectory, Input::Detections];
    let cycle = world.cycle(profile(), Configuration::PlanRemote, &holds);
    let outcome = checked(&cycle).map(|report| report.stages[3]);
    kani::cover!(outcome == Some(Outcome::Passed), "passed");
    kani::cover!(matches!(outcome, Some(Outcome::Failed(_))), "failed");
    kani::cover!(outcome.is_none(), "refused");
}

/// Stage v, with H-06, panics at no input, refuses only what is invalid or does not fit the
/// scratch, and reports what the schedule says.
///
/// Domain: any numbers of 64 bits, lists up to the bounds, any scratch, both profiles, `MotRemote`,
/// up to two disks. Not covered: longer lists, other configurations.
#[cfg_attr(kani, kani::proof)]
#[cfg_attr(kani, kani::unwind(37))]
pub fn verify_stage_v_never_panics() {
    let world = World::any();
    let holds = [Input::Trajectory, Input::Grid];
    let cycle = world.cycle(profile(), Configuration::MotRemote, &holds);
    kani::assume(cycle.parameters.n <= DISKS);
    let outcome = checked(&cycle).map(|report| report.stages[4]);
    kani::cover!(outcome == Some(Outcome::Passed), "passed");
    kani::cover!(matches!(outcome, Some(Outcome::Failed(_))), "failed");
    kani::cover!(outcome.is_none(), "refused");
}

/// What is said of the cycle, which follows the schedule; `None` for invalid local input and for
/// too little scratch, which is refused for no other reason.
fn checked(cycle: &Cycle<'_>) -> Option<Report> {
    const COLUMNS: usize = DETECTIONS + TRACKS;
    let (mut rows, mut columns) = ([Row::default(); TRACKS], [Column::default(); COLUMNS]);
    let rows = &mut rows[..index(TRACKS + 1)];
    let columns = &mut columns[..index(COLUMNS + 1)];
    let sizes = Sizes::for_cycle(cycle);
    let fits = rows.len() >= sizes.rows && columns.len() >= sizes.columns;
    match check(cycle, &mut Scratch::new(rows, columns)) {
        Ok(report) => {
            assert_scheduled(cycle, &report);
            assert!(fits || report.failed_stage == Some(FailedStage::Input));
            Some(report)
        }
        Err(problem) => {
            assert!((problem.problem != Problem::ScratchTooSmall) || !fits);
            None
        }
    }
}
