//! `spec/3-stages.md#hardened-profile`: what the vectors of the rules leave out.

mod history;
mod left_out;
mod moving;
mod places;
mod records;
mod start;
mod steps;
mod waiting;

use mufasa_model::input::cycle::{Cycle, Profile};
use mufasa_model::report::{FailedStage, Input, Outcome, Reason, Rule, Stage};
use mufasa_model::services::configuration::Configuration::{self, MotRemote, PlanRemote};

use crate::base::*;

/// H-04: the gap is compared although stage iv does not run, and that is no run of stage iv.
#[test]
fn h_04_a_larger_gap_is_no_run_of_stage_iv() {
    let with = |configuration: Configuration, gap: f64, change: fn(&mut Cycle)| {
        let mut cycle = base(Profile::Hardened, configuration);
        // s_follow = s_CAV = 1.5 * 10 at equal speeds.
        cycle.parameters.safety_time = 1.5;
        cycle.lead = lead(gap, V_NOW);
        change(&mut cycle);
        cycle
    };
    // Stage iii ran, with detections: still compared, still reported as skipped.
    assert_eq!(rule(&with(PlanRemote, 15.0, |_| ()), Stage::Iv), Some(Rule::Gap));
    let far = with(PlanRemote, 16.0, |_| ());
    assert_eq!(outcome(&far, Stage::Iv), Outcome::Skipped(Reason::OtherStageRan));
    // A larger gap is no obstacle check, and nothing without a trajectory.
    let blind = with(MotRemote, 16.0, |c| (c.detections, c.grid) = (None, None));
    assert_eq!(failed(&blind), Some(FailedStage::NoObstacleCheck));
    let no_plan = with(MotRemote, 1.0, |c| (c.detections, c.trajectory) = (None, None));
    assert_eq!(
        outcome(&no_plan, Stage::Iv),
        Outcome::Skipped(Reason::NoCurrent(Input::Trajectory))
    );
}

/// H-06: the CAV's rectangle stands against occupied cells, where stage iv ran and the paper does not examine the
/// grid.
#[test]
fn h_06_the_rectangle_reaches_fewer_cells_than_the_disks() {
    let with = |occupied: [f64; 2], change: fn(&mut Cycle)| {
        let mut cycle = base(Profile::Hardened, PlanRemote);
        // The disks reach y = 1.16, the rectangle 0.95.
        cycle.ego.width = 1.9;
        let grid = cycle.grid.as_mut().expect("there is a grid");
        mark(&mut grid.occupied, occupied[0], occupied[1]);
        cycle.tracks = None;
        change(&mut cycle);
        rule(&cycle, Stage::V)
    };
    assert_eq!(with([3.5, 1.5], |_| ()), None);
    assert_eq!(with([3.5, 0.5], |_| ()), Some(Rule::Occupied));
    assert_eq!(with([3.5, 1.5], |c| c.ego.width = 2.0), Some(Rule::Occupied));
    let mot: fn(&mut Cycle) = |c| c.configuration = MotRemote;
    assert_eq!(with([3.5, 1.5], mot), Some(Rule::Occupied));
    let old: fn(&mut Cycle) = |c| c.detections.as_mut().expect("given").stamp_ns -= 200_000_000;
    assert_eq!(with([3.5, 1.5], old), Some(Rule::Occupied));
}

/// H-06: a cell both occupied and unknown is occupied.
#[test]
fn h_06_occupied_comes_before_unknown() {
    let mut cycle = base(Profile::Hardened, MotRemote);
    cycle.detections = None;
    let grid = cycle.grid.as_mut().expect("there is a grid");
    let mut unknown = vec![0; grid.occupied.len()];
    mark(&mut unknown, 3.5, 1.5);
    grid.unknown = Some(unknown);
    assert_eq!(rule(&cycle, Stage::V), Some(Rule::Unknown));
    mark(&mut cycle.grid.as_mut().expect("there is a grid").occupied, 3.5, 1.5);
    assert_eq!(rule(&cycle, Stage::V), Some(Rule::Occupied));
}
