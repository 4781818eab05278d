//! H-04, H-06 and H-10: where the CAV is examined in the grid.

use mufasa_model::input::cycle::Profile;
use mufasa_model::report::{FailedStage, Outcome, Rule, Stage};
use mufasa_model::services::configuration::Configuration::{
    self, AllRemote, MotRemote, PlanRemote,
};

use crate::base::*;
use crate::near::*;

const HARDENED: Profile = Profile::HARDENED;

const NEAR: &[Near] = &[("half width of the CAV at a cell + m", PlanRemote, HARDENED, |c, e| {
    // The cell begins at y = 1, and disks reach it.
    mark(&mut c.grid.as_mut().expect("there is a grid").occupied, 3.5, 1.5);
    c.tracks = None;
    c.ego.width = 2.0 + 2.0 * e;
})];

#[test]
fn margins_move_what_reaches_a_cell() {
    margins_move(NEAR);
}

/// H-04: the places of H-14 are examined in the grid, after the points that the paper names.
#[test]
fn h_04_the_grid_is_examined_up_to_s_stop() {
    for configuration in [MotRemote, AllRemote, PlanRemote] {
        let with = |profile: Profile, x: f64| {
            let mut cycle = base(profile, configuration);
            cycle.trajectory = Some(straight(1, 0.0));
            (cycle.tracks, cycle.detections) = (None, None);
            mark(&mut cycle.grid.as_mut().expect("there is a grid").occupied, x, 0.5);
            match outcome(&cycle, Stage::V) {
                Outcome::Failed(witness) => Some((witness.rule, witness.point)),
                _ => None,
            }
        };
        // The foremost disk is 1.5 m ahead and reaches 1.118 m: 9 m from 6.5 m on, 11 m not from s_stop = 7.65 m.
        assert_eq!(with(HARDENED, 9.5), Some((Rule::Occupied, Some(1 + 26))), "{configuration:?}");
        assert_eq!(with(HARDENED, 11.5), None, "{configuration:?}");
        assert_eq!(with(Profile::PAPER, 9.5), None, "{configuration:?}");
        // The paper's point comes first, whose number is its own.
        assert_eq!(with(HARDENED, 2.5), Some((Rule::Occupied, Some(0))), "{configuration:?}");
    }
}

/// H-10, F-34: v runs on a current grid in AllRemote and PlanRemote, whatever else ran.
#[test]
fn nothing_that_ran_calls_off_the_grid() {
    let ran = |profile: Profile, configuration: Configuration| {
        let cycle = base(profile, configuration);
        [Stage::Iii, Stage::Iv, Stage::V].map(|stage| passes(&cycle, stage))
    };
    assert_eq!(ran(HARDENED, AllRemote), [true, false, true]);
    assert_eq!(ran(HARDENED, PlanRemote), [true, false, true]);
    assert_eq!(ran(HARDENED, MotRemote), [false, true, true]);
    assert_eq!(ran(Profile::PAPER, AllRemote), [true, false, false]);
    assert_eq!(ran(Profile::PAPER, PlanRemote), [true, false, false]);
    for configuration in [AllRemote, PlanRemote] {
        let mut blind = base(HARDENED, configuration);
        (blind.tracks, blind.detections) = (tracks(vec![]), detections(vec![]));
        assert_eq!(failed(&blind), None);
        let grid = blind.grid.as_mut().expect("there is a grid");
        mark(&mut grid.occupied, 8.5, 0.5);
        assert_eq!(failed(&blind), Some(FailedStage::Stage(Stage::V)), "{configuration:?}");
        blind.profile = Profile::PAPER;
        assert_eq!(failed(&blind), None);
    }
}
