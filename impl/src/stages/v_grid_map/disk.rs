//! One disk of the footprint on the grid: whether a cell collides with it, decided with error bounds
//! (`spec/3-stages.md#stage-v-trajectory-with-grid-map`, H-06).

use crate::input::cycle::{Cycle, Grid, TrajectoryPoint};
use crate::numbers::plane::Vector;
use crate::numbers::range::{float, integer, larger, smaller};
use crate::numbers::rounding::Real;
use crate::stages::v_grid_map::bitmap::{Bitmap, Near};

/// A disk centre in the grid's frame, m.
pub(crate) struct Disk {
    column: Real,
    row: Real,
}

/// A cell, unless it is beyond the array, and its distance as the stage means it, m.
pub(crate) struct Hit {
    pub(crate) cell: Option<(i64, i64)>,
    pub(crate) distance: f64,
}

/// The frame and the cells of a grid, and the disks' radius.
pub(crate) struct Map {
    origin: Vector,
    direction: Vector,
    norm_squared: Real,
    resolution: Real,
    width: i64,
    height: i64,
    pub(crate) radius: Real,
    radius_squared: Real,
}

impl Map {
    pub(crate) fn new(cycle: &Cycle<'_>, grid: &Grid<'_>) -> Self {
        let direction = Vector::new(grid.cos, grid.sin);
        let part = Real::new(cycle.ego.length).over(Real::integer(cycle.parameters.n));
        let diagonal_squared = part.squared() + Real::new(cycle.ego.width).squared();
        let radius_squared = diagonal_squared * Real::new(0.25);
        Self {
            origin: Vector::new(grid.x, grid.y),
            direction,
            norm_squared: direction.dot(direction),
            resolution: Real::new(grid.resolution),
            width: grid.width,
            height: grid.height,
            radius: radius_squared.sqrt(),
            radius_squared,
        }
    }

    /// Disk `i` of the footprint at a point: (2i+1) L/(2n) - L/2 from the rectangle's centre.
    pub(crate) fn disk(&self, cycle: &Cycle<'_>, point: &TrajectoryPoint, i: i64) -> Disk {
        let n = cycle.parameters.n;
        let odd = Real::integer(i) + Real::integer(i) + Real::ONE;
        let share = odd.over(Real::integer(n) + Real::integer(n)) - Real::new(0.5);
        let shift = Real::new(cycle.ego.length) * share + Real::new(cycle.ego.center_offset);
        let centre = Vector::new(point.x, point.y) + Vector::new(point.cos, point.sin).times(shift);
        let relative = centre - self.origin;
        Disk {
            column: relative.dot(self.direction).over(self.norm_squared),
            row: self.direction.cross(relative).over(self.norm_squared),
        }
    }

    /// The largest number of squared cell widths that may be <= r^2.
    pub(crate) fn dilation(&self) -> i64 {
        let ratio = self.radius_squared.over(self.resolution.squared());
        let most = floor(ratio).saturating_add(1);
        let fits = |&steps: &i64| Real::integer(steps).possibly_at_most(ratio);
        [most, most.saturating_sub(1)].into_iter().find(fits).unwrap_or(most.saturating_sub(2))
    }

    /// Paper: the first occupied cell that marks a cell of the array in which the disk centre may
    /// lie.
    pub(crate) fn marked(&self, disk: &Disk, occupied: &Bitmap<'_>, steps: i64) -> Option<Hit> {
        let column = disk.column.over(self.resolution);
        let row = disk.row.over(self.resolution);
        let place = |near: &Near| (near.row, near.column);
        let marks = cells_around(row, self.height)
            .filter_map(|k| {
                let columns = cells_around(column, self.width);
                columns.filter_map(|i| occupied.within(i, k, steps)).min_by_key(place)
            })
            .min_by_key(place)?;
        let distance = Real::integer(marks.squared).sqrt() * self.resolution;
        Some(Hit { cell: Some((marks.column, marks.row)), distance: distance.value() })
    }

    /// H-06: the first cell of the bitmap whose closed square may be at distance <= r.
    pub(crate) fn touched(&self, disk: &Disk, cells: &Bitmap<'_>) -> Option<Hit> {
        let (first, last) = self.reach(disk.row, self.radius);
        (first.max(0)..=last.min(self.height.saturating_sub(1))).find_map(|k| {
            if self.row_is_free(disk, k, cells) {
                return None;
            }
            let (from, to) = self.reach_in_row(disk, k);
            let mut next = cells.first_in_row(k, from, to);
            while let Some(i) = next {
                let hit = self.hit(disk, i, k);
                if hit.is_some() {
                    return hit;
                }
                next = cells.first_in_row(k, i.saturating_add(1), to);
            }
            None
        })
    }

    /// Whether certainly no cell of the row that the disk may touch is set. Plain doubles, in cells;
    /// 1e-3 is more than they err, also at the limits of the domain.
    fn row_is_free(&self, disk: &Disk, k: i64, cells: &Bitmap<'_>) -> bool {
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

    /// H-06: places outside the grid may be at distance <= r.
    pub(crate) fn outside(&self, disk: &Disk) -> Option<Hit> {
        let end = |count: i64| Real::integer(count) * self.resolution;
        let columns = disk.column.min(end(self.width) - disk.column);
        let rows = disk.row.min(end(self.height) - disk.row);
        let within = columns.min(rows).max(Real::ZERO);
        let reaches = within.possibly_at_most(self.radius);
        reaches.then(|| Hit { cell: None, distance: within.value() })
    }

    /// The cell, if its closed square may be at distance <= r.
    fn hit(&self, disk: &Disk, i: i64, k: i64) -> Option<Hit> {
        let apart = self.gap(disk.column, i).squared() + self.gap(disk.row, k).squared();
        let touches = apart.possibly_at_most(self.radius_squared);
        touches.then(|| Hit { cell: Some((i, k)), distance: apart.sqrt().value() })
    }

    /// The first and the last column that the disk may touch in row `k`.
    fn reach_in_row(&self, disk: &Disk, k: i64) -> (i64, i64) {
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

/// The columns (or rows) of the array in whose closed interval the coordinate, in cells, may be.
fn cells_around(coordinate: Real, count: i64) -> impl Iterator<Item = i64> {
    let middle = floor(coordinate);
    (middle.saturating_sub(1)..=middle.saturating_add(1)).filter(move |&index| {
        0 <= index
            && index < count
            && Real::integer(index).possibly_at_most(coordinate)
            && coordinate.possibly_at_most(Real::integer(index.saturating_add(1)))
    })
}

/// An integer at most 1 from the floor of the number.
#[allow(clippy::cast_possible_truncation, reason = "coordinates in cells stay below 2^40")]
fn floor(value: Real) -> i64 {
    libm::floor(value.value()) as i64
}
