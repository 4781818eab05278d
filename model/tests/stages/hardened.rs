//! `spec/3-stages.md#hardened-profile`: what the vectors of the rules leave out.

mod fail_safe;
mod history;
mod left_out;
mod places;
mod start;
mod steps;

use mufasa_model::input::cycle::{Cycle, Profile};
use mufasa_model::report::{FailedStage, Input, Outcome, Reason, Rule, Stage};
use mufasa_model::services::configuration::Configuration::{self, MotRemote, PlanRemote};

use crate::base::*;

/// H-04: where stage iv does not run the gap is compared with s_react, and that is no run of stage iv.
#[test]
fn h_04_a_larger_gap_is_no_run_of_stage_iv() {
    // s_stop = 2.5 + 3/32 + 10.75^2 / 16, and s_b(10) = 6.25.
    const S_REACT: f64 = 9.816_406_25 - 6.25;
    let with = |configuration: Configuration, gap: f64, change: fn(&mut Cycle)| {
        let mut cycle = base(Profile::HARDENED, configuration);
        cycle.parameters.tau = 0.25;
        cycle.lead = lead(gap, V_NOW);
        change(&mut cycle);
        cycle
    };
    // Stage iii ran, with detections: still compared, still reported as skipped.
    let far = S_REACT.next_up();
    assert_eq!(rule(&with(PlanRemote, S_REACT, |_| ()), Stage::Iv), Some(Rule::Gap));
    let skipped = outcome(&with(PlanRemote, far, |_| ()), Stage::Iv);
    assert_eq!(skipped, Outcome::Skipped(Reason::OtherStageRan));
    // A lead that is faster by far needs no gap but one.
    let fast: fn(&mut Cycle) = |c| c.lead.as_mut().expect("set").speed = 20.0;
    assert_eq!(rule(&with(PlanRemote, 0.0, fast), Stage::Iv), Some(Rule::Gap));
    assert_eq!(rule(&with(PlanRemote, f64::MIN_POSITIVE, fast), Stage::Iv), None);
    // Where stage iv runs, s_follow is asked.
    let blind: fn(&mut Cycle) = |c| c.tracks = None;
    assert_eq!(rule(&with(PlanRemote, far, blind), Stage::Iv), Some(Rule::Gap));
    assert_eq!(rule(&with(MotRemote, far, |_| ()), Stage::Iv), Some(Rule::Gap));
    // A larger gap is no obstacle check, and nothing without a trajectory.
    let blind = with(MotRemote, far, |c| (c.detections, c.grid) = (None, None));
    assert_eq!(failed(&blind), Some(FailedStage::NoObstacleCheck));
    let no_plan = with(MotRemote, 1.0, |c| (c.detections, c.trajectory) = (None, None));
    assert_eq!(
        outcome(&no_plan, Stage::Iv),
        Outcome::Skipped(Reason::NoCurrent(Input::Trajectory))
    );
}

/// H-06: the CAV's rectangle stands against occupied cells, where detections are current and the paper does
/// not examine the grid.
#[test]
fn h_06_the_rectangle_reaches_fewer_cells_than_the_disks() {
    let with = |occupied: [f64; 2], change: fn(&mut Cycle)| {
        let mut cycle = base(Profile::HARDENED, PlanRemote);
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

/// H-06: where detections are current, if of nothing, unknown cells and what is outside the grid are free.
#[test]
fn h_06_unknown_cells_are_free_where_detections_are_current() {
    for configuration in [MotRemote, PlanRemote, Configuration::AllRemote] {
        let with = |is_current: bool| {
            let mut cycle = base(Profile::HARDENED, configuration);
            cycle.tracks = None;
            cycle.detections = detections(vec![]);
            cycle.detections.as_mut().expect("set").stamp_ns -=
                i64::from(!is_current) * 200_000_000;
            let grid = cycle.grid.as_mut().expect("there is a grid");
            let mut unknown = vec![0; grid.occupied.len()];
            mark(&mut unknown, 3.5, 0.5);
            grid.unknown = Some(unknown);
            rule(&cycle, Stage::V)
        };
        assert_eq!([with(true), with(false)], [None, Some(Rule::Unknown)], "{configuration:?}");
    }
}

/// H-06: a cell both occupied and unknown is occupied.
#[test]
fn h_06_occupied_comes_before_unknown() {
    let mut cycle = base(Profile::HARDENED, MotRemote);
    cycle.detections = None;
    let grid = cycle.grid.as_mut().expect("there is a grid");
    let mut unknown = vec![0; grid.occupied.len()];
    mark(&mut unknown, 3.5, 1.5);
    grid.unknown = Some(unknown);
    assert_eq!(rule(&cycle, Stage::V), Some(Rule::Unknown));
    mark(&mut cycle.grid.as_mut().expect("there is a grid").occupied, 3.5, 1.5);
    assert_eq!(rule(&cycle, Stage::V), Some(Rule::Occupied));
}
