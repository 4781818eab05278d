//! Stage v: trajectory with grid map (`spec/3-stages.md#stage-v-trajectory-with-grid-map`, H-06).

use std::ops::RangeInclusive;

use crate::input::profile::Profile;
use crate::input::scene::{Grid, Point, Scene};
use crate::numbers::real::Real;
use crate::numbers::vector::Vector;
use crate::report::{Reading, Rule, Witness};
use crate::stages::distances::{points_examined, s_b};
use crate::stages::llcc::centre;

/// Compares the disks that cover the footprint with the grid; `None` passes. `stage_iv_ran`: in
/// this cycle, so that unknown cells and places outside the grid count as free (H-06).
pub fn grid(
    scene: &Scene,
    trajectory: &[Point],
    grid: &Grid,
    stage_iv_ran: bool,
) -> Option<Witness> {
    let s = s_b(&scene.ego.v_now, &scene.parameters.a_b);
    let disks: Vec<Vec<Disk>> = points_examined(scene, trajectory, &s)
        .iter()
        .map(|point| disks(scene, point).iter().map(|c| Disk::new(scene, grid, c)).collect())
        .collect();
    let first = |rule: Rule, hit: &dyn Fn(&Disk) -> Option<Hit>| {
        disks.iter().enumerate().find_map(|(i, disks)| {
            disks.iter().enumerate().find_map(|(d, disk)| {
                let hit = hit(disk)?;
                Some(Witness {
                    point: Some(i),
                    disk: Some(d),
                    cell: hit.cell,
                    ..Witness::new(rule, &hit.distance, &disk.r)
                })
            })
        })
    };
    match scene.profile {
        Profile::Paper => first(Rule::Occupied, &|disk| disk.in_dilated_cell(scene)),
        Profile::Hardened => {
            let free = !stage_iv_ran;
            first(Rule::Occupied, &|disk| disk.touches_cell(Grid::is_occupied))
                .or_else(|| {
                    first(Rule::Unknown, &|disk| {
                        free.then(|| disk.touches_cell(Grid::is_unknown)).flatten()
                    })
                })
                .or_else(|| {
                    first(Rule::Outside, &|disk| free.then(|| disk.touches_outside()).flatten())
                })
        }
    }
}

/// The centres of the n disks on the long axis of the CAV's rectangle.
fn disks(scene: &Scene, point: &Point) -> Vec<Vector> {
    let rectangle = centre(scene, point);
    let offset = |i: i64| {
        let [i, n] = [i, scene.parameters.n].map(|number| Real::from_integer(number.into()));
        disk_offset(&i, &n, &scene.ego.length)
    };
    (0..scene.parameters.n).map(|i| rectangle.point(&offset(i), &Real::zero())).collect()
}

/// (2i+1) L/(2n) - L/2: from the rectangle's centre to that of the disk i of n, m.
pub fn disk_offset(i: &Real, n: &Real, length: &Real) -> Real {
    let two = Real::from_integer(2);
    (&two * i + Real::from_integer(1)) * length / (&two * n) - length / two
}

/// r = sqrt((L/n)^2 + W^2) / 2, m.
pub fn disk_radius(length: &Real, width: &Real, n: &Real) -> Real {
    ((length / n).square() + width.square()).sqrt() / Real::from_integer(2)
}

/// Distance of a point in the frame of the grid to the closed square of a cell, m.
pub fn distance_to_cell(point: &Vector, [column, row]: [&Real; 2], resolution: &Real) -> Real {
    let outside = |coordinate: &Real, cell: &Real| {
        let (near, far) = (cell * resolution, (cell + Real::from_integer(1)) * resolution);
        (near - coordinate).max(coordinate - far).max(Real::zero())
    };
    (outside(&point.x, column).square() + outside(&point.y, row).square()).sqrt()
}

/// A disk in the frame of the grid.
struct Disk<'a> {
    grid: &'a Grid,
    centre: Vector,
    r: Real,
    /// r + m
    reach: Real,
}

struct Hit {
    cell: Option<(i64, i64)>,
    distance: Real,
}

impl<'a> Disk<'a> {
    fn new(scene: &Scene, grid: &'a Grid, centre: &Vector) -> Self {
        let n = Real::from_integer(scene.parameters.n.into());
        let r = disk_radius(&scene.ego.length, &scene.ego.width, &n);
        let reach = &r + &scene.m;
        Self { grid, centre: grid.frame.coordinates(centre), r, reach }
    }

    /// The centre lies in a cell of the dilated grid. A cell of the array is marked when its centre
    /// is at distance <= r from the centre of some occupied cell. Strictly: the square of half side
    /// delta around the centre meets a marked cell; laxly: marked cells cover it.
    fn in_dilated_cell(&self, scene: &Scene) -> Option<Hit> {
        let marks = |cells: [RangeInclusive<i64>; 2]| -> Vec<Option<Hit>> {
            let [columns, rows] = cells;
            let cell = |row: i64| columns.clone().map(move |column| (column, row));
            rows.flat_map(cell).map(|cell| self.mark(cell)).collect()
        };
        let delta = &scene.parameters.delta;
        match scene.reading {
            Reading::Exact => marks(self.closed_cells(&Real::zero())).into_iter().flatten().next(),
            Reading::Strict => marks(self.closed_cells(delta)).into_iter().flatten().next(),
            Reading::Lax => {
                let cover: Option<Vec<Hit>> = marks(self.open_cells(delta)).into_iter().collect();
                cover?.into_iter().next()
            }
        }
    }

    /// Columns and rows whose closed cells meet the closed square around the centre.
    fn closed_cells(&self, half_side: &Real) -> [RangeInclusive<i64>; 2] {
        [&self.centre.x, &self.centre.y].map(|c| {
            let (least, most) = (c - half_side, c + half_side);
            self.ceil(&least) - 1..=self.floor(&most)
        })
    }

    /// Columns and rows whose open cells meet the open square around the centre.
    fn open_cells(&self, half_side: &Real) -> [RangeInclusive<i64>; 2] {
        [&self.centre.x, &self.centre.y].map(|c| {
            let (least, most) = (c - half_side, c + half_side);
            self.floor(&least)..=self.ceil(&most) - 1
        })
    }

    fn floor(&self, coordinate: &Real) -> i64 {
        (coordinate / &self.grid.resolution).floor()
    }

    fn ceil(&self, coordinate: &Real) -> i64 {
        -(-coordinate / &self.grid.resolution).floor()
    }

    /// The first occupied cell that marks a cell of the array, by row and column.
    fn mark(&self, (column, row): (i64, i64)) -> Option<Hit> {
        let grid = self.grid;
        if !(0..grid.width).contains(&column) || !(0..grid.height).contains(&row) {
            return None;
        }
        let w = self.floor(&self.reach).max(-1);
        cells(grid, column - w..=column + w, row - w..=row + w, Grid::is_occupied).find_map(
            |(i, k)| {
                let squared = (i128::from(i) - i128::from(column)).pow(2)
                    + (i128::from(k) - i128::from(row)).pow(2);
                let distance = Real::from_integer(squared).sqrt() * &grid.resolution;
                (distance <= self.reach).then_some(Hit { cell: Some((i, k)), distance })
            },
        )
    }

    /// H-06: the first cell of a kind whose closed square is at distance <= r from the centre.
    fn touches_cell(&self, is_kind: fn(&Grid, i64, i64) -> bool) -> Option<Hit> {
        let range =
            |c: &Real| self.floor(&(c - &self.reach)) - 1..=self.floor(&(c + &self.reach)) + 1;
        let (columns, rows) = (range(&self.centre.x), range(&self.centre.y));
        cells(self.grid, columns, rows, is_kind).find_map(|(i, k)| {
            let cell = [i, k].map(|number| Real::from_integer(number.into()));
            let distance = distance_to_cell(&self.centre, cell.each_ref(), &self.grid.resolution);
            (distance <= self.reach).then_some(Hit { cell: Some((i, k)), distance })
        })
    }

    /// H-06: a place outside the grid is at distance <= r.
    fn touches_outside(&self) -> Option<Hit> {
        let side = |cells: i64| Real::from_integer(cells.into()) * &self.grid.resolution;
        let inside = [
            self.centre.x.clone(),
            side(self.grid.width) - &self.centre.x,
            self.centre.y.clone(),
            side(self.grid.height) - &self.centre.y,
        ];
        let distance = inside.into_iter().min()?.max(Real::zero());
        (distance <= self.reach).then_some(Hit { cell: None, distance })
    }
}

/// The cells of a kind inside the array and the ranges, by row and column.
fn cells(
    grid: &Grid,
    columns: RangeInclusive<i64>,
    rows: RangeInclusive<i64>,
    is_kind: fn(&Grid, i64, i64) -> bool,
) -> impl Iterator<Item = (i64, i64)> {
    let rows = (*rows.start()).max(0)..=(*rows.end()).min(grid.height - 1);
    let columns = (*columns.start()).max(0)..=(*columns.end()).min(grid.width - 1);
    rows.flat_map(move |row| columns.clone().map(move |column| (column, row)))
        .filter(move |&(column, row)| is_kind(grid, column, row))
}
