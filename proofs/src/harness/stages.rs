//! The stages on arbitrary numbers, also invalid, NaN and infinite ones: none panics, every loop
//! ends, and what is reported follows the schedule.

use mufasa::cycle::{ValidCycle, check, check_indexed};
use mufasa::input::cycle::Cycle;
use mufasa::input::route_index::{Block, RouteIndex};
use mufasa::input::scratch::{Column, Row, Scratch, Sizes};
use mufasa::report::{FailedStage, Input, InvalidInput, Outcome, Problem, Report, Stage};
use mufasa::services::configuration::Configuration;

use super::any::{index, profile};
use super::bounds::{DETECTIONS, DISKS, TRACKS};
use super::schedule::assert_scheduled;
use super::world::World;
#[cfg(not(kani))]
use crate::kani;

/// Columns of the largest assignment: a spare one for each track.
const COLUMNS: usize = DETECTIONS + TRACKS;

/// Stage i, with H-01, panics at no input, refuses only what is invalid or does not fit the scratch, and
/// reports what the schedule says.
///
/// Domain: any numbers of 64 bits, lists up to the bounds, any scratch, both profiles, `MotRemote`.
/// Not covered: longer lists, other configurations.
pub fn verify_stage_i_never_panics() {
    never_panics(Configuration::MotRemote, &[Input::Tracks, Input::Detections], 0);
}

/// Stage ii, with H-07, H-11 and the reach of H-14, panics at no input, refuses only what is invalid or does
/// not fit the scratch, and reports what the schedule says.
///
/// Domain: any numbers of 64 bits, lists up to the bounds, any scratch, both profiles,
/// `PlanRemote`. Not covered: longer lists, other configurations.
pub fn verify_stage_ii_never_panics() {
    never_panics(Configuration::PlanRemote, &[Input::Trajectory], 1);
}

/// Stage iii panics at no input, refuses only what is invalid or does not fit the scratch, and reports what
/// the schedule says.
///
/// Domain: any numbers of 64 bits, lists up to the bounds, any scratch, both profiles, `AllRemote`.
/// Not covered: longer lists, other configurations.
pub fn verify_stage_iii_never_panics() {
    never_panics(Configuration::AllRemote, &[Input::Trajectory, Input::Tracks], 2);
}

/// Stage iv, with H-04 and H-14, panics at no input, refuses only what is invalid or does not fit the
/// scratch, and reports what the schedule says.
///
/// Domain: any numbers of 64 bits, lists up to the bounds, any scratch, both profiles,
/// `PlanRemote`. Not covered: longer lists, other configurations.
pub fn verify_stage_iv_never_panics() {
    never_panics(Configuration::PlanRemote, &[Input::Trajectory, Input::Detections], 3);
}

/// Stage v, with H-06, panics at no input, refuses only what is invalid or does not fit the
/// scratch, and reports what the schedule says.
///
/// Domain: any numbers of 64 bits, lists up to the bounds, any scratch, both profiles, `MotRemote`,
/// up to two disks. Not covered: longer lists, other configurations.
pub fn verify_stage_v_never_panics() {
    never_panics(Configuration::MotRemote, &[Input::Trajectory, Input::Grid], 4);
}

fn never_panics(configuration: Configuration, holds: &[Input], at: usize) {
    let world = World::any();
    let cycle = world.cycle(profile(), configuration, holds);
    kani::assume(at != 4 || cycle.parameters.n <= DISKS);
    let outcome = checked(&cycle).map(|report| report.stages[at]);
    kani::cover!(outcome == Some(Outcome::Passed), "passed");
    kani::cover!(matches!(outcome, Some(Outcome::Failed(_))), "failed");
    kani::cover!(outcome.is_none(), "refused");
}

/// An index of the route is made of exactly the valid routes that fit its memory, and with it every
/// cycle gets the same answer.
///
/// Domain: any numbers of 64 bits, lists up to the bounds, both profiles, `AllRemote` with a
/// trajectory alone. Not covered: routes with more than one block.
pub fn verify_index_changes_nothing() {
    let world = World::any();
    let cycle = world.cycle(profile(), Configuration::AllRemote, &[Input::Trajectory]);
    let mut memory = [Block::default(); 2];
    let memory = &mut memory[..index(3)];
    let fits = memory.len() >= Block::needed(cycle.route.cross_sections.len());
    let answer = check(&cycle, &mut Scratch::new(&mut [], &mut []));
    let index = RouteIndex::new(cycle.route, memory);
    if let Ok(index) = &index {
        assert!(
            fits && check_indexed(&cycle, index, &mut Scratch::new(&mut [], &mut [])) == answer
        );
    }
    let of_the_route = |problem: &InvalidInput| problem.field.starts_with("route.");
    assert!(index.is_ok() || !fits || answer.is_err());
    kani::cover!(index.is_ok() && answer.is_ok_and(|report| report.failed_stage.is_none()), "safe");
    kani::cover!(
        index.is_ok() && answer.is_ok_and(|report| report.failed_stage.is_some()),
        "unsafe"
    );
    kani::cover!(answer.as_ref().is_err_and(of_the_route), "an invalid route");
    kani::cover!(!fits && answer.is_ok(), "too little memory");
}

/// A stage that is run alone says what it says in the schedule, if it ran there.
///
/// Domain: any numbers of 64 bits, lists up to the bounds, both profiles, `MotRemote`, stages i, ii
/// and iv. Not covered: longer lists, other configurations.
pub fn verify_stage_alone_says_the_same() {
    let world = World::any();
    let holds = [Input::Trajectory, Input::Tracks, Input::Detections];
    let cycle = world.cycle(profile(), Configuration::MotRemote, &holds);
    let (mut rows, mut columns) = ([Row::default(); TRACKS], [Column::default(); COLUMNS]);
    let mut scratch = Scratch::new(&mut rows, &mut columns);
    let answer = check(&cycle, &mut scratch);
    let Ok(valid) = ValidCycle::new(&cycle, None, &scratch) else {
        assert!(answer.is_err() || is_refused(&answer));
        kani::cover!(is_refused(&answer), "invalid remote data");
        return;
    };
    let Ok(report) = answer else { unreachable!("the input is valid") };
    for (at, stage) in [(0, Stage::I), (1, Stage::Ii), (3, Stage::Iv)] {
        let (alone, scheduled) = (valid.stage(stage, &mut scratch), report.stages[at]);
        let ran = matches!(scheduled, Outcome::Passed | Outcome::Failed(_));
        // H-04 compares the gap at the place of stage iv also without detections.
        let gap_alone = at == 3 && alone == Outcome::NotApplicable(Input::Detections);
        assert!(!ran || alone == scheduled || gap_alone);
        kani::cover!(at == 0 && alone == scheduled && ran, "stage i ran");
        kani::cover!(at == 1 && alone == scheduled && ran, "stage ii ran");
        kani::cover!(at == 3 && alone == scheduled && ran, "stage iv ran");
        kani::cover!(!ran && alone == Outcome::Passed, "it would have passed");
    }
}

fn is_refused(answer: &Result<Report, InvalidInput>) -> bool {
    answer.is_ok_and(|report| report.failed_stage == Some(FailedStage::Input))
}

/// What is said of the cycle, which follows the schedule; `None` for invalid local input and for
/// too little scratch, which is refused for no other reason.
fn checked(cycle: &Cycle<'_>) -> Option<Report> {
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
