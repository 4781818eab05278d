//! Stage v: trajectory with grid map (`spec/3-stages.md#stage-v-trajectory-with-grid-map`).

pub(crate) mod band;
pub(crate) mod bitmap;
pub(crate) mod disk;
pub(crate) mod search;

use crate::hardened::h06_closed_cells::closed_cells;
use crate::hardened::h14_fail_safe::path::Nodes;
use crate::input::cycle::{Cycle, DetectionList, Grid, Trajectory, TrajectoryPoint};
use crate::input::profile::HardenedRule;
use crate::report::{Rule, Witness};
use crate::stages::horizon::{Horizon, points_examined};
use crate::stages::v_grid_map::band::Band;
use crate::stages::v_grid_map::bitmap::Bitmap;
use crate::stages::v_grid_map::disk::{Disk, GridGeometry};
use crate::stages::v_grid_map::search::{DiskSearch, Places};

/// Why stage v fails, if it does. `detections`: the current ones (H-06).
pub(crate) fn trajectory_with_grid_map(
    cycle: &Cycle<'_>,
    trajectory: &Trajectory<'_>,
    grid: &Grid<'_>,
    detections: Option<&DetectionList<'_>>,
) -> Option<Witness> {
    let points = points_examined(cycle, trajectory.points, Horizon::Braking);
    let all = trajectory.points;
    let places = || (Nodes::new(cycle, all), all.len());
    let places = cycle.profile.has(HardenedRule::H04).then(places);
    if cycle.profile.has(HardenedRule::H06) {
        closed_cells(cycle, grid, (points, places), detections)
    } else {
        dilated_cells(cycle, grid, (points, places))
    }
}

/// The first disk whose centre may lie in a cell that an occupied one marks.
fn dilated_cells(
    cycle: &Cycle<'_>,
    grid: &Grid<'_>,
    (points, places): (&[TrajectoryPoint], Option<Places<'_, '_>>),
) -> Option<Witness> {
    let occupied = Bitmap { bits: grid.occupied, width: grid.width, height: grid.height };
    let search = DiskSearch::new(cycle, grid, points);
    let is_free = |band: &Band| band.is_free(&occupied);
    let hit = |grid: &GridGeometry, disk: &Disk<'_>| grid.marked(disk, &occupied, grid.dilation());
    let found = search.first(Rule::Occupied, is_free, hit);
    found.or_else(|| search.first_place(places?, Rule::Occupied, is_free, hit))
}
