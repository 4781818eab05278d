//! Stage v: trajectory with grid map (`spec/3-stages.md#stage-v-trajectory-with-grid-map`).

pub(crate) mod band;
pub(crate) mod bitmap;
pub(crate) mod disk;
pub(crate) mod search;

use crate::hardened::h06_closed_cells::closed_cells;
use crate::input::cycle::{Cycle, DetectionList, Grid, Trajectory, TrajectoryPoint};
use crate::input::profile::Profile;
use crate::report::{Rule, Witness};
use crate::stages::horizon::{Horizon, points_examined};
use crate::stages::v_grid_map::bitmap::Bitmap;
use crate::stages::v_grid_map::search::DiskSearch;

/// Why stage v fails, if it does. `detections`: the current ones (H-06).
pub(crate) fn trajectory_with_grid_map(
    cycle: &Cycle<'_>,
    trajectory: &Trajectory<'_>,
    grid: &Grid<'_>,
    detections: Option<&DetectionList<'_>>,
) -> Option<Witness> {
    let points = points_examined(cycle, trajectory.points, Horizon::Braking);
    match cycle.profile {
        Profile::Paper => dilated_cells(cycle, grid, points),
        Profile::Hardened => closed_cells(cycle, grid, (points, trajectory.points), detections),
    }
}

/// The first disk whose centre may lie in a cell that an occupied one marks.
fn dilated_cells(
    cycle: &Cycle<'_>,
    grid: &Grid<'_>,
    points: &[TrajectoryPoint],
) -> Option<Witness> {
    let occupied = Bitmap { bits: grid.occupied, width: grid.width, height: grid.height };
    let search = DiskSearch::new(cycle, grid, points);
    search.cells(Rule::Occupied, &occupied, |grid, disk| {
        grid.marked(disk, &occupied, grid.dilation())
    })
}
