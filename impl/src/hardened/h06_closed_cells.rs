//! Stage v with closed cells, unknown ones and the border of the grid (H-06 of
//! `spec/3-stages.md#hardened-profile`).

use crate::input::cycle::{Cycle, Detection, Ego, Grid, TrajectoryPoint};
use crate::numbers::plane::Vector;
use crate::numbers::range::{float, integer, larger, smaller};
use crate::numbers::rectangle::{Rectangle, certainly_touch, possibly_touch};
use crate::numbers::rounding::Real;
use crate::report::{Rule, Witness};
use crate::services::configuration::Configuration;
use crate::stages::horizon::PointsExamined;
use crate::stages::llcc::footprint;
use crate::stages::llcc::sweep::MovingRectangle;
use crate::stages::v_grid_map::band::Band;
use crate::stages::v_grid_map::bitmap::Bitmap;
use crate::stages::v_grid_map::disk::{Disk, GridGeometry, Hit, floor};
use crate::stages::v_grid_map::search::DiskSearch;

/// The first disk that may touch an occupied cell, else an unknown one, else a place outside the
/// grid. `beside_iv`: the current detections, when stage iv ran in this cycle, so that the last two
/// do not count.
pub(crate) fn closed_cells(
    cycle: &Cycle<'_>,
    grid: &Grid<'_>,
    examined: &PointsExamined<'_, '_>,
    beside_iv: Option<&[Detection]>,
) -> Option<Witness> {
    let everywhere = |find: &mut dyn FnMut(&DiskSearch<'_, '_>) -> Option<Witness>| {
        let found = find(&DiskSearch::new(cycle, grid, examined.points));
        let beyond =
            || examined.first_beyond(|cycle, points| find(&DiskSearch::new(cycle, grid, points)));
        found.or_else(beyond)
    };
    let touched = |rule, cells: &Bitmap<'_>, covered: &mut Covered<'_>| {
        everywhere(&mut |search| {
            let ego = &search.cycle.ego;
            search.cells(rule, cells, |grid, disk| {
                grid.touched(disk, cells, |i, k| covered.is_passed(grid, [i, k], ego, disk.at))
            })
        })
    };
    let occupied = Bitmap { bits: grid.occupied, width: grid.width, height: grid.height };
    if let Some(detections) = beside_iv {
        // In MotRemote the paper's stage v runs, too, whatever was detected.
        let detections = match cycle.configuration {
            Configuration::Local | Configuration::MotRemote => &[],
            Configuration::AllRemote | Configuration::PlanRemote => detections,
        };
        return touched(Rule::Occupied, &occupied, &mut Covered::by(detections, grid));
    }
    let mut none = Covered::by(&[], grid);
    let found = touched(Rule::Occupied, &occupied, &mut none);
    let unknown = grid.unknown.map(|bits| Bitmap { bits, ..occupied });
    let unknown = || unknown.and_then(|unknown| touched(Rule::Unknown, &unknown, &mut none));
    let is_inside = |band: &Band| band.is_within(grid.width, grid.height);
    let outside =
        || everywhere(&mut |search| search.first(Rule::Outside, is_inside, GridGeometry::outside));
    found.or_else(unknown).or_else(outside)
}

/// The cells that the rectangle of a detection covers in part. Stage iv has examined it, so that
/// against them stands the CAV's rectangle, not its disks.
struct Covered<'d> {
    detections: &'d [Detection],
    grid: &'d Grid<'d>,
    /// The detection that covered the last cell, as an index: mostly it covers the next one, too.
    last: usize,
}

impl<'d> Covered<'d> {
    const fn by(detections: &'d [Detection], grid: &'d Grid<'d>) -> Self {
        Self { detections, grid, last: 0 }
    }

    /// Whether the closed square of the cell certainly shares a point with a detection, and none
    /// with the CAV's rectangle.
    fn is_passed(
        &mut self,
        geometry: &GridGeometry,
        cell: [i64; 2],
        ego: &Ego,
        at: &TrajectoryPoint,
    ) -> bool {
        let plain = self.plain_cell(cell);
        let is_apart = MovingRectangle::footprint(ego, at).certainly_apart(&plain, 0.0)
            || !possibly_touch(&footprint(ego, at), &geometry.cell(self.grid, cell));
        is_apart && self.is_seen(geometry, cell, &plain)
    }

    /// Whether the cell certainly shares a point with a detection.
    fn is_seen(
        &mut self,
        geometry: &GridGeometry,
        cell: [i64; 2],
        plain: &MovingRectangle,
    ) -> bool {
        let touches = |detection: &Detection| {
            let detection = MovingRectangle::detection(detection);
            !plain.certainly_apart(&detection, 0.0)
                && certainly_touch(
                    &geometry.cell(self.grid, cell),
                    &detection.displaced(Vector::ZERO),
                )
        };
        if self.detections.get(self.last).is_some_and(touches) {
            return true;
        }
        let found = self.detections.iter().position(touches);
        self.last = found.unwrap_or(0);
        found.is_some()
    }

    /// The cell in plain doubles; its centre errs by less than 2^-25 m.
    fn plain_cell(&self, cell: [i64; 2]) -> MovingRectangle {
        let &Grid { x, y, cos, sin, resolution, .. } = self.grid;
        let [a, b] = cell.map(|index| (float(index) + 0.5) * resolution);
        MovingRectangle {
            centre: [x + (a * cos - b * sin), y + (a * sin + b * cos)],
            direction: [cos, sin],
            velocity: [0.0, 0.0],
            size: [resolution, resolution],
        }
    }
}

impl GridGeometry {
    /// The first cell of the bitmap whose closed square may be at distance <= r, but for those that
    /// are passed.
    fn touched(
        &self,
        disk: &Disk<'_>,
        cells: &Bitmap<'_>,
        mut is_passed: impl FnMut(i64, i64) -> bool,
    ) -> Option<Hit> {
        let (first, last) = self.reach(disk.row, self.radius);
        (first.max(0)..=last.min(self.height.saturating_sub(1))).find_map(|k| {
            if self.row_is_free(disk, k, cells) {
                return None;
            }
            let (from, to) = self.reach_in_row(disk, k);
            let mut next = cells.first_in_row(k, from, to);
            while let Some(i) = next {
                let hit = self.hit(disk, i, k);
                if hit.is_some() && !is_passed(i, k) {
                    return hit;
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
    fn cell(&self, grid: &Grid<'_>, [i, k]: [i64; 2]) -> Rectangle {
        let middle = |index| (Real::integer(index) + Real::new(0.5)) * self.resolution;
        let turned = Vector { x: -self.direction.y, y: self.direction.x };
        let centre = self.origin + self.direction.times(middle(i)) + turned.times(middle(k));
        let (length, width) = (grid.resolution, grid.resolution);
        Rectangle { centre, direction: self.direction, length, width }
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
