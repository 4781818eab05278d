//! Cells of a square lattice (`spec/3-stages.md#stage-v-trajectory-with-grid-map`): the cell (column i,
//! row k) is the square from (i, k) to (i + 1, k + 1) times the resolution.

use std::ops::RangeInclusive;

use crate::numbers::reading::{Comparisons, Reading};
use crate::numbers::real::Real;
use crate::numbers::vector::Vector;

/// Column and row.
pub type Cell = (i64, i64);

/// Columns and rows.
pub type Cells = [RangeInclusive<i64>; 2];

/// A disk on a cell, or beyond the border of the grid (no cell): how far the cell is, m.
#[derive(Clone, Debug)]
pub struct Hit {
    /// The cell.
    pub cell: Option<Cell>,
    /// Its distance, m.
    pub distance: Real,
}

/// Centre of a cell, m.
pub fn centre((column, row): Cell, resolution: &Real) -> Vector {
    let half = Real::from_integer(1) / Real::from_integer(2);
    let middle = |i: i64| (Real::from_integer(i.into()) + &half) * resolution;
    Vector { x: middle(column), y: middle(row) }
}

/// Distance of a point to the closed square of a cell, m.
pub fn distance_to_cell(point: &Vector, [column, row]: [&Real; 2], resolution: &Real) -> Real {
    let outside = |coordinate: &Real, cell: &Real| {
        let (near, far) = (cell * resolution, (cell + Real::from_integer(1)) * resolution);
        (near - coordinate).max(coordinate - far).max(Real::zero())
    };
    (outside(&point.x, column).square() + outside(&point.y, row).square()).sqrt()
}

/// What `mark` says of the cells that a point lies in, a point on a border in each of them. In the
/// strict and the lax reading the point is a square of half side delta: strictly one marked cell that
/// it meets is enough, laxly marked cells cover it.
pub fn mark_at(
    reads: &Comparisons,
    point: &Vector,
    resolution: &Real,
    mark: impl Fn(Cell) -> Option<Hit>,
) -> Option<Hit> {
    match reads.reading {
        Reading::Exact => by_row(met(point, &Real::zero(), resolution)).find_map(mark),
        Reading::Strict => by_row(met(point, &reads.delta, resolution)).find_map(mark),
        Reading::Lax => {
            let cover: Option<Vec<Hit>> =
                by_row(met_inside(point, &reads.delta, resolution)).map(mark).collect();
            cover?.into_iter().next()
        }
    }
}

/// The cells in order of row and column.
pub fn by_row([columns, rows]: Cells) -> impl Iterator<Item = Cell> {
    rows.flat_map(move |row| columns.clone().map(move |column| (column, row)))
}

/// All cells whose closed squares come as near to a point as `reach`, and one more on each side.
pub fn around(point: &Vector, reach: &Real, resolution: &Real) -> Cells {
    [&point.x, &point.y].map(|c| {
        let (least, most) = (floor(&(c - reach), resolution), floor(&(c + reach), resolution));
        least - 1..=most + 1
    })
}

/// The cells whose closed squares meet the closed square of this half side around a point.
fn met(point: &Vector, half_side: &Real, resolution: &Real) -> Cells {
    [&point.x, &point.y].map(|c| {
        let (least, most) = (c - half_side, c + half_side);
        -floor(&-least, resolution) - 1..=floor(&most, resolution)
    })
}

/// The cells whose open squares meet the open square of this half side around a point.
fn met_inside(point: &Vector, half_side: &Real, resolution: &Real) -> Cells {
    [&point.x, &point.y].map(|c| {
        let (least, most) = (c - half_side, c + half_side);
        floor(&least, resolution)..=-floor(&-most, resolution) - 1
    })
}

fn floor(coordinate: &Real, resolution: &Real) -> i64 {
    (coordinate / resolution).floor()
}
