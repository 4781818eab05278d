//! `spec/3-stages.md#hardened-profile`: what the vectors of the rules leave out.

use mufasa_model::input::cycle::{Cycle, Profile, Trajectory};
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

/// H-11: equal headings need no time to turn, others do, however little they differ.
#[test]
fn h_11_no_turn_on_the_spot_is_small_enough() {
    let mut cycle = base(Profile::Hardened, PlanRemote);
    cycle.ego.speed = 0.0;
    cycle.tracks = tracks(vec![]);
    let points = vec![at_time(0, 0.0, 0.0), at_time(1, 0.0, 0.0)];
    cycle.trajectory = Some(Trajectory { stamp_ns: NOW, points });
    assert_eq!(rule(&cycle, Stage::Ii), None);
    cycle.trajectory.as_mut().expect("there is one").points[1].sin = 1e-9;
    assert_eq!(rule(&cycle, Stage::Ii), Some(Rule::StepTurn), "0.1 * 1 ns = 1e-10");
}
