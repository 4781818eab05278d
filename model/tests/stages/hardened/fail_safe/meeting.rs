//! `spec/hardened/H-14.md#requirements-failure`: where and when an object meets the CAV.

use mufasa_model::input::cycle::Profile;
use mufasa_model::report::{Rule, Stage};
use mufasa_model::services::configuration::Configuration::MotRemote;

use crate::base::*;

const HARDENED: Profile = Profile::HARDENED;

/// H-14.27: beside a trajectory the CAV is no wider in the grid. With a = 0.5 m it would reach y = 1.
#[test]
fn a_trajectory_that_begins_beside_widens_nothing_in_the_grid() {
    let with = |cell: f64, width: f64| {
        let mut cycle = base(HARDENED, MotRemote);
        cycle.ego.width = width;
        cycle.trajectory = Some(straight(1, 0.0));
        cycle.trajectory.as_mut().expect("given").points[0].y = 0.5;
        (cycle.tracks, cycle.detections) = (None, None);
        mark(&mut cycle.grid.as_mut().expect("there is a grid").occupied, 9.5, cell);
        rule(&cycle, Stage::V)
    };
    assert_eq!(with(1.5, 1.0), None);
    assert_eq!(with(1.5, 2.0), Some(Rule::Occupied));
    assert_eq!(with(0.5, 1.0), Some(Rule::Occupied));
}
