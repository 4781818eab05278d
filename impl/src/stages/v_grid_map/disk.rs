//! One disk of the footprint on the grid: whether a cell of the dilated grid collides with it,
//! decided with error bounds (`spec/3-stages.md#stage-v-trajectory-with-grid-map`).

use crate::input::cycle::{Cycle, Grid};
use crate::numbers::plane::Vector;
use crate::numbers::rounding::Real;
use crate::stages::llcc::{Pose, vector};
use crate::stages::v_grid_map::bitmap::{Bitmap, NearCell};

/// A disk centre in the grid's frame, m, and where the CAV is.
pub(crate) struct Disk<'p> {
    pub(crate) column: Real,
    pub(crate) row: Real,
    pub(crate) pose: &'p Pose,
}

/// A cell, unless it is beyond the array, and its distance as the stage means it, m.
pub(crate) struct Hit {
    pub(crate) cell: Option<(i64, i64)>,
    pub(crate) distance: f64,
}

/// The frame and the cells of a grid, and the disks' radius.
pub(crate) struct GridGeometry {
    pub(crate) origin: Vector,
    pub(crate) direction: Vector,
    norm_squared: Real,
    pub(crate) resolution: Real,
    pub(crate) width: i64,
    pub(crate) height: i64,
    pub(crate) radius: Real,
    pub(crate) radius_squared: Real,
}

impl GridGeometry {
    /// With the radius of S5-02.
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

    /// Disk `i` of the footprint at a pose (S5-01): (2i+1) L/(2n) - L/2 from the rectangle's
    /// centre.
    pub(crate) fn disk<'p>(&self, cycle: &Cycle<'_>, pose: &'p Pose, i: i64) -> Disk<'p> {
        let n = cycle.parameters.n;
        let odd = Real::integer(i) + Real::integer(i) + Real::ONE;
        let share = odd.over(Real::integer(n) + Real::integer(n)) - Real::new(0.5);
        let shift = Real::new(cycle.ego.length) * share + Real::new(cycle.ego.center_offset);
        let centre = pose.at + vector(pose.heading).times(shift);
        let relative = centre - self.origin;
        Disk {
            // DOM-04
            column: relative.dot(self.direction).over(self.norm_squared),
            row: self.direction.cross(relative).over(self.norm_squared),
            pose,
        }
    }

    /// The largest number of squared cell widths that may be <= r^2 (S5-03).
    pub(crate) fn dilation(&self) -> i64 {
        let ratio = self.radius_squared.over(self.resolution.squared());
        let most = floor(ratio).saturating_add(1);
        let fits = |&steps: &i64| Real::integer(steps).possibly_at_most(ratio);
        [most, most.saturating_sub(1)].into_iter().find(fits).unwrap_or(most.saturating_sub(2))
    }

    /// Paper: the first occupied cell that marks a cell of the array in which the disk centre may
    /// lie (S5-04).
    pub(crate) fn marked(&self, disk: &Disk<'_>, occupied: &Bitmap<'_>, steps: i64) -> Option<Hit> {
        let column = disk.column.over(self.resolution);
        let row = disk.row.over(self.resolution);
        let place = |near: &NearCell| (near.row, near.column);
        let marks = cells_around(row, self.height)
            .filter_map(|k| {
                let columns = cells_around(column, self.width);
                // S5-03: cells of the array alone are marked, and outside is free (S5-06, I-07)
                columns.filter_map(|i| occupied.within(i, k, steps)).min_by_key(place)
            })
            .min_by_key(place)?;
        let distance = Real::integer(marks.squared).sqrt() * self.resolution;
        Some(Hit { cell: Some((marks.column, marks.row)), distance: distance.value() })
    }
}

/// The columns (or rows) of the array in whose closed interval the coordinate, in cells, may be
/// (S5-05).
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
pub(crate) fn floor(value: Real) -> i64 {
    libm::floor(value.value()) as i64
}
