//! Stage v with closed cells, unknown ones and the border of the grid (H-06 of
//! `spec/3-stages.md#hardened-profile`).

use crate::hardened::h14_fail_safe::path::Nodes;
use crate::input::cycle::{Cycle, DetectionList, Grid, TrajectoryPoint};
use crate::numbers::plane::Vector;
use crate::numbers::range::{float, integer, larger, smaller};
use crate::numbers::rectangle::{Rectangle, possibly_touch};
use crate::numbers::rounding::Real;
use crate::report::{Rule, Witness};
use crate::services::configuration::Configuration;
use crate::stages::llcc::footprint;
use crate::stages::llcc::sweep::MovingRectangle;
use crate::stages::v_grid_map::band::Band;
use crate::stages::v_grid_map::bitmap::Bitmap;
use crate::stages::v_grid_map::disk::{Disk, GridGeometry, Hit, floor};
use crate::stages::v_grid_map::search::DiskSearch;

/// The first disk that may touch an occupied cell, else an unknown one, else a place outside the
/// grid. `points`: those that the paper examines, and all of the trajectory; `detections`: the current
/// ones, with which the last two do not count.
pub(crate) fn closed_cells(
    cycle: &Cycle<'_>,
    grid: &Grid<'_>,
    (points, all): (&[TrajectoryPoint], &[TrajectoryPoint]),
    detections: Option<&DetectionList<'_>>,
) -> Option<Witness> {
    let places = (Nodes::new(cycle, all), all.len());
    let asks_rectangle = rectangle_counts(cycle, detections);
    let search = DiskSearch::new(cycle, grid, points);
    let touched = |rule, cells: &Bitmap<'_>| {
        let search = DiskSearch::new(cycle, grid, points);
        let search = if asks_rectangle { search.with_rectangle() } else { search };
        let hit = |geometry: &GridGeometry, disk: &Disk<'_>| {
            let cav = MovingRectangle::footprint(&cycle.ego, &disk.pose.plainly());
            geometry.touched(disk, cells, |i, k| {
                if asks_rectangle && cav.certainly_apart(&plain_cell(grid, i, k), 0.0) {
                    return None;
                }
                let touches =
                    || possibly_touch(&footprint(&cycle.ego, disk.pose), &geometry.cell(i, k));
                geometry.hit(disk, i, k).filter(|_| !asks_rectangle || touches())
            })
        };
        let is_free = |band: &Band| band.is_free(cells);
        search.first(rule, is_free, hit).or_else(|| search.first_place(places, rule, is_free, hit))
    };
    let occupied = Bitmap { bits: grid.occupied, width: grid.width, height: grid.height };
    let found = touched(Rule::Occupied, &occupied);
    if detections.is_some() {
        return found;
    }
    let unknown = grid.unknown.map(|bits| Bitmap { bits, ..occupied });
    let unknown = || unknown.and_then(|unknown| touched(Rule::Unknown, &unknown));
    let is_inside = |band: &Band| band.is_within(grid.width, grid.height);
    let outside = || {
        let found = search.first(Rule::Outside, is_inside, GridGeometry::outside);
        found
            .or_else(|| search.first_place(places, Rule::Outside, is_inside, GridGeometry::outside))
    };
    found.or_else(unknown).or_else(outside)
}

/// Where the paper does not examine the grid beside another stage, a cell has to touch the CAV's
/// rectangle, too; where nothing is detected, the disks are all that is left.
fn rectangle_counts(cycle: &Cycle<'_>, detections: Option<&DetectionList<'_>>) -> bool {
    let detects = detections.is_some_and(|list| !list.items.is_empty());
    match cycle.configuration {
        Configuration::AllRemote | Configuration::PlanRemote => detects,
        Configuration::Local | Configuration::MotRemote => false,
    }
}

/// The closed square of a cell in plain doubles: its centre is rounded five times, which leaves it
/// as near as `sweep` needs it.
fn plain_cell(grid: &Grid<'_>, i: i64, k: i64) -> MovingRectangle {
    let &Grid { x, y, cos, sin, resolution, .. } = grid;
    let [along, across] = [i, k].map(|index| (float(index) + 0.5) * resolution);
    MovingRectangle {
        centre: [x + along * cos - across * sin, y + along * sin + across * cos],
        direction: [cos, sin],
        velocity: [0.0, 0.0],
        size: [resolution, resolution],
    }
}

impl GridGeometry {
    /// The first set cell of the rows and columns that the disk may touch at which `hit` finds
    /// something.
    fn touched(
        &self,
        disk: &Disk<'_>,
        cells: &Bitmap<'_>,
        hit: impl Fn(i64, i64) -> Option<Hit>,
    ) -> Option<Hit> {
        let (first, last) = self.reach(disk.row, self.radius);
        (first.max(0)..=last.min(self.height.saturating_sub(1))).find_map(|k| {
            if self.row_is_free(disk, k, cells) {
                return None;
            }
            let (from, to) = self.reach_in_row(disk, k);
            let mut next = cells.first_in_row(k, from, to);
            while let Some(i) = next {
                let found = hit(i, k);
                if found.is_some() {
                    return found;
                }
                next = cells.first_in_row(k, i.saturating_add(1), to);
            }
            None
        })
    }

    /// Whether certainly no cell of the row that the disk may touch is set. Plain doubles, in cells;
    /// 1e-3 is more than they err, also at the limits of the domain.
    fn row_is_free(&self, disk: &Disk<'_>, k: i64, cells: &Bitmap<'_>) -> bool {
        let scale = 1.0 / self.resolution.value();
        let [x, y, r] = [disk.column, disk.row, self.radius].map(|it| it.value() * scale);
        let (r, below) = (r + 1e-3, float(k) - y);
        let gap = larger(larger(below, -1.0 - below), 0.0);
        if gap > r {
            return true;
        }
        let half = libm::sqrt(r * r - gap * gap) + 1e-3;
        let (width, from, to) = (float(self.width), x - half - 1.0, x + half + 1.0);
        if to < 0.0 || from > width {
            return true;
        }
        cells.row_is_free(k, integer(larger(from - 0.5, 0.0)), integer(smaller(to + 0.5, width)))
    }

    /// Places outside the grid may be at distance <= r.
    fn outside(&self, disk: &Disk<'_>) -> Option<Hit> {
        let end = |count: i64| Real::integer(count) * self.resolution;
        let columns = disk.column.min(end(self.width) - disk.column);
        let rows = disk.row.min(end(self.height) - disk.row);
        let within = columns.min(rows).max(Real::ZERO);
        let reaches = within.possibly_at_most(self.radius);
        reaches.then(|| Hit { cell: None, distance: within.value() })
    }

    /// The cell, if its closed square may be at distance <= r.
    fn hit(&self, disk: &Disk<'_>, i: i64, k: i64) -> Option<Hit> {
        let apart = self.gap(disk.column, i).squared() + self.gap(disk.row, k).squared();
        let touches = apart.possibly_at_most(self.radius_squared);
        touches.then(|| Hit { cell: Some((i, k)), distance: apart.sqrt().value() })
    }

    /// The closed square of the cell.
    fn cell(&self, i: i64, k: i64) -> Rectangle {
        let middle = |index| (Real::integer(index) + Real::new(0.5)) * self.resolution;
        let turned = Vector { x: -self.direction.y, y: self.direction.x };
        let centre = self.origin + self.direction.times(middle(i)) + turned.times(middle(k));
        let side = self.resolution.value();
        Rectangle { centre, direction: self.direction, length: side, width: side }
    }

    /// The first and the last column that the disk may touch in row `k`.
    fn reach_in_row(&self, disk: &Disk<'_>, k: i64) -> (i64, i64) {
        let chord_squared = self.radius_squared - self.gap(disk.row, k).squared();
        self.reach(disk.column, chord_squared.max(Real::ZERO).sqrt())
    }

    /// The first and the last column (or row) that may be as near; at most two too many on either
    /// side.
    fn reach(&self, centre: Real, distance: Real) -> (i64, i64) {
        let first = floor((centre - distance).over(self.resolution));
        let last = floor((centre + distance).over(self.resolution));
        (first.saturating_sub(1), last.saturating_add(1))
    }

    /// How far the coordinate is from the closed interval of a column (or row), m.
    fn gap(&self, centre: Real, index: i64) -> Real {
        let from = Real::integer(index) * self.resolution;
        let to = Real::integer(index.saturating_add(1)) * self.resolution;
        (from - centre).max(centre - to).max(Real::ZERO)
    }
}
