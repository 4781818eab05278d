//! Stage v: trajectory with grid map (`spec/3-stages.md#stage-v-trajectory-with-grid-map`).

pub(crate) mod band;
pub(crate) mod bitmap;
pub(crate) mod disk;
pub(crate) mod search;

use crate::input::cycle::{Cycle, Grid, Trajectory};
use crate::report::{Rule, Witness};
use crate::stages::horizon::{Horizon, points_examined};
use crate::stages::v_grid_map::band::Band;
use crate::stages::v_grid_map::bitmap::Bitmap;
use crate::stages::v_grid_map::disk::{Disk, GridGeometry, Hit};
use crate::stages::v_grid_map::search::DiskSearch;

/// Why stage v fails, if it does: the first disk whose centre may lie in a cell that an occupied one marks.
pub(crate) fn trajectory_with_grid_map(
    cycle: &Cycle<'_>,
    trajectory: &Trajectory<'_>,
    grid: &Grid<'_>,
) -> Option<Witness> {
    // S5-04
    let points = points_examined(cycle, trajectory.points, Horizon::Braking);
    let (search, dilated) = (DiskSearch::new(cycle, grid), DilatedCells::new(grid));
    search.first(
        points,
        Rule::Occupied,
        |band| dilated.is_free(band),
        |grid, disk| dilated.hit(grid, disk),
    )
}

/// The occupied cells, each of which marks what is as near as the radius.
#[derive(Clone, Copy, Debug)]
pub(crate) struct DilatedCells<'a> {
    occupied: Bitmap<'a>,
}

impl<'a> DilatedCells<'a> {
    /// What is unknown is not among them (S5-06, I-07).
    pub(crate) const fn new(grid: &Grid<'a>) -> Self {
        let &Grid { occupied: bits, width, height, .. } = grid;
        Self { occupied: Bitmap { bits, width, height } }
    }

    /// Whether certainly no disk in the band is in a marked cell.
    pub(crate) fn is_free(&self, band: &Band) -> bool {
        band.is_free(&self.occupied)
    }

    /// What marks the cell in which the centre of the disk may lie.
    pub(crate) fn hit(&self, grid: &GridGeometry, disk: &Disk<'_>) -> Option<Hit> {
        grid.marked(disk, &self.occupied, grid.dilation())
    }
}
