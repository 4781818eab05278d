//! Stage v with closed cells, unknown ones and the border of the grid (H-06 of
//! `spec/hardened/H-06.md`).

mod covered;

use crate::hardened::h04_gap::places::Places;
use crate::hardened::h06_closed_cells::covered::{Covered, plain_square, square};
use crate::input::cycle::{Cycle, DetectionList, Grid, Trajectory, TrajectoryPoint};
use crate::numbers::range::{float, integer, larger, smaller};
use crate::numbers::rectangle::possibly_touch;
use crate::numbers::rounding::Real;
use crate::report::{Rule, Witness};
use crate::services::configuration::Configuration;
use crate::stages::horizon::{Horizon, points_examined};
use crate::stages::llcc::footprint;
use crate::stages::llcc::sweep::MovingRectangle;
use crate::stages::v_grid_map::band::{Band, CellFrame};
use crate::stages::v_grid_map::bitmap::Bitmap;
use crate::stages::v_grid_map::disk::{Disk, GridGeometry, Hit, floor};
use crate::stages::v_grid_map::search::DiskSearch;

/// The first disk that may touch an occupied cell, else an unknown one, else a place outside the
/// grid. At the points that the paper examines, then at the places of H-04; `detections`: the current ones,
/// with which the last two do not count, and no cell that one of them covers.
pub(crate) fn closed_cells(
    cycle: &Cycle<'_>,
    grid: &Grid<'_>,
    (trajectory, places): (&Trajectory<'_>, Option<&Places<'_, '_>>),
    detections: Option<&DetectionList<'_>>,
) -> Option<Witness> {
    let points = points_examined(cycle, trajectory.points, Horizon::Braking);
    let items = detections.map_or(&[][..], |list| list.items);
    let covered = Covered { grid, items };
    let examined = Examined { cycle, points, places, covered };
    let occupied = Bitmap { bits: grid.occupied, width: grid.width, height: grid.height };
    let found = examined.touched(Rule::Occupied, &occupied);
    // H-06.5, H-06.6
    if detections.is_some() {
        return found;
    }
    let unknown = grid.unknown.map(|bits| Bitmap { bits, ..occupied });
    let unknown = || unknown.and_then(|unknown| examined.touched(Rule::Unknown, &unknown));
    found.or_else(unknown).or_else(|| examined.beyond_the_grid())
}

/// Where the CAV is examined, on a grid.
struct Examined<'c, 'a> {
    cycle: &'c Cycle<'a>,
    /// The points that the paper names.
    points: &'c [TrajectoryPoint],
    places: Option<&'c Places<'c, 'a>>,
    covered: Covered<'c, 'a>,
}

impl Examined<'_, '_> {
    /// The first disk that may touch a set cell, at the points, then at the places. Beside a detection a
    /// cell has to touch the CAV's rectangle, too, and none that is covered counts; but not at the points
    /// where the paper examines the grid beside every other stage. Where nothing is detected, the disks
    /// are all that is left.
    fn touched(&self, rule: Rule, cells: &Bitmap<'_>) -> Option<Witness> {
        // H-06.2; H-06.4: in `MotRemote` at the points, too
        let at_places = !self.covered.items.is_empty();
        let at_points = at_places && self.cycle.configuration != Configuration::MotRemote;
        let at = |cycle, asks_rectangle| {
            let grid = self.covered.grid;
            let mut search = DiskSearch::new(cycle, grid);
            if asks_rectangle {
                search.frame = CellFrame::with_rectangle(cycle, grid);
            }
            let is_free = move |band: &Band| {
                let mut latest = 0;
                band.is_free_but(cells, |i, k| {
                    asks_rectangle && self.covered.has(i, k, &mut latest)
                })
            };
            let hit = move |grid: &GridGeometry, disk: &Disk<'_>| {
                self.hit(cycle, (grid, disk), cells, asks_rectangle)
            };
            (search, is_free, hit)
        };
        let (search, is_free, hit) = at(self.cycle, at_points);
        let found = search.first(self.points, rule, is_free, hit);
        found.or_else(|| {
            let places = self.places?;
            let (search, is_free, hit) = at(&places.wide, at_places);
            search.first_place(places, rule, is_free, hit)
        })
    }

    /// What the disk hits.
    fn hit(
        &self,
        cycle: &Cycle<'_>,
        (grid, disk): (&GridGeometry, &Disk<'_>),
        cells: &Bitmap<'_>,
        asks_rectangle: bool,
    ) -> Option<Hit> {
        let covered = &self.covered;
        let cav = MovingRectangle::footprint(&cycle.ego, &disk.pose.plainly());
        let mut latest = 0;
        grid.touched(disk, cells, |i, k| {
            // H-06.2
            if !asks_rectangle {
                return grid.hit(disk, i, k);
            }
            // H-06.3
            if cav.certainly_apart(&plain_square(covered.grid, i, k))
                || covered.has(i, k, &mut latest)
            {
                return None;
            }
            let cell = || square(covered.grid, i, k);
            let touches = || possibly_touch(&footprint(&cycle.ego, disk.pose), &cell());
            grid.hit(disk, i, k).filter(|_| touches())
        })
    }

    /// The first disk that may reach beyond the grid.
    fn beyond_the_grid(&self) -> Option<Witness> {
        let grid = self.covered.grid;
        let is_inside = |band: &Band| band.is_within(grid.width, grid.height);
        let search = |cycle| DiskSearch::new(cycle, grid);
        let (rule, hit) = (Rule::Outside, GridGeometry::outside);
        let found = search(self.cycle).first(self.points, rule, is_inside, hit);
        found.or_else(|| {
            let places = self.places?;
            search(&places.wide).first_place(places, rule, is_inside, hit)
        })
    }
}

impl GridGeometry {
    /// The first set cell of the rows and columns that the disk may touch at which `hit` finds
    /// something.
    fn touched(
        &self,
        disk: &Disk<'_>,
        cells: &Bitmap<'_>,
        mut hit: impl FnMut(i64, i64) -> Option<Hit>,
    ) -> Option<Hit> {
        let (first, last) = self.reach(disk.row, self.radius);
        (first.max(0)..=last.min(self.height.saturating_sub(1))).find_map(|k| {
            let (from, to) = self.columns_near(disk, k)?;
            cells.set_in_row(k, from, to).find_map(|i| hit(i, k))
        })
    }

    /// The first and the last column that the disk may touch in row `k`. Plain doubles, in cells; 1e-3 is more
    /// than they err, also at the limits of the domain.
    fn columns_near(&self, disk: &Disk<'_>, k: i64) -> Option<(i64, i64)> {
        let scale = 1.0 / self.resolution.value();
        let [x, y, r] = [disk.column, disk.row, self.radius].map(|it| it.value() * scale);
        let (r, below) = (r + 1e-3, float(k) - y);
        let gap = larger(larger(below, -1.0 - below), 0.0);
        if gap > r {
            return None;
        }
        let half = libm::sqrt(r * r - gap * gap) + 1e-3;
        let (width, from, to) = (float(self.width), x - half - 1.0, x + half);
        if to < 0.0 || from > width {
            return None;
        }
        // The nearest integers to these are not above the least and not below the greatest column.
        let (from, to) = (larger(from, 0.0) + 0.499, smaller(to, width) - 0.499);
        Some((integer(from), integer(larger(to, 0.0))))
    }

    /// Places outside the grid may be at distance <= r (H-06.6).
    fn outside(&self, disk: &Disk<'_>) -> Option<Hit> {
        let end = |count: i64| Real::integer(count) * self.resolution;
        let columns = disk.column.min(end(self.width) - disk.column);
        let rows = disk.row.min(end(self.height) - disk.row);
        let within = columns.min(rows).max(Real::ZERO);
        let reaches = within.possibly_at_most(self.radius);
        reaches.then(|| Hit { cell: None, distance: within.value() })
    }

    /// The cell, if its closed square may be at distance <= r (H-06.1).
    fn hit(&self, disk: &Disk<'_>, i: i64, k: i64) -> Option<Hit> {
        let apart = self.gap(disk.column, i).squared() + self.gap(disk.row, k).squared();
        let touches = apart.possibly_at_most(self.radius_squared);
        touches.then(|| Hit { cell: Some((i, k)), distance: apart.sqrt().value() })
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
