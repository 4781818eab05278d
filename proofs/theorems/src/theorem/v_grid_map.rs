//! Stage v: disks, cells, and what the two ways to compare them can miss (H-06, F-08).

use crate::claim::{Theorem, Wrong};
use crate::numbers::cells::distance_to_cell;
use crate::numbers::real::Real;
use crate::numbers::real::formula::{
    Formula, at_most, equal, forget_of_what_roots_are, given, less,
};
use crate::numbers::vector::Vector;
use crate::stages::v_grid_map::{disk_offset, disk_radius};
use crate::theorem::lemma::{squares_order, triangle};
use crate::theorem::rectangle::vector;

/// The theorems of this file.
pub const THEOREMS: &[Theorem] = &[
    Theorem {
        id: "a_disk_covers_its_part_of_the_footprint",
        // S5-01, S5-02.
        statement: "a point of the footprint between i L/n and (i+1) L/n from its rear is in disk i",
        domain: "every real n > 0 and i, all L, W > 0",
        claim: || part_is_covered(&Real::from_integer(1)),
        wrong: Wrong {
            statement: "in disk i of 0.99 r",
            claim: || part_is_covered(&Real::ratio(99, 100)),
        },
    },
    Theorem {
        id: "the_parts_of_the_disks_are_the_whole_footprint",
        statement: "the part of disk 0 begins at -L/2, that of disk i+1 where that of i ends, that of \
                    disk n-1 ends at L/2",
        domain: "every real n > 0 and i, all L > 0; with it the disks cover the footprint for every n",
        claim: || parts_join(0),
        wrong: Wrong { statement: "the part of disk 1 begins at -L/2", claim: || parts_join(1) },
    },
    Theorem {
        id: "a_disk_that_reaches_into_a_cell_is_near_it",
        statement: "H-06: a point of a closed cell at distance <= r from the centre of a disk makes the \
                    distance of centre and cell <= r",
        domain: "every cell, all resolutions > 0, centres, r >= 0",
        claim: || {
            let (Cell { resolution, column, row, within }, centre, r) = reached();
            let distance = distance_to_cell(&centre, [&column, &row], &resolution);
            given(squares_order(&distance, &(&within - &centre).length()));
            at_most(&distance, &r)
        },
        wrong: Wrong {
            statement: "makes the distance of centre and corner (i, k) <= r",
            claim: || {
                let (Cell { resolution, column, row, .. }, centre, r) = reached();
                let corner = Vector { x: &column * &resolution, y: &row * &resolution };
                at_most(&(&corner - &centre).length(), &r)
            },
        },
    },
    Theorem {
        id: "a_point_of_a_cell_is_near_its_centre",
        statement: "a point of a cell is at most sqrt(2)/2 cell widths from the cell's centre",
        domain: "every cell, all resolutions > 0",
        claim: || {
            let cell = Cell::new("cell");
            let (offset, half_diagonal) = (&cell.within - &cell.centre(), cell.half_diagonal());
            given(squares_order(&offset.length(), &half_diagonal));
            at_most(&offset.length(), &half_diagonal)
        },
        wrong: Wrong {
            statement: "at most 0.707 cell widths",
            claim: || {
                let cell = Cell::new("cell");
                let offset = &cell.within - &cell.centre();
                at_most(&offset.length(), &(&cell.resolution * Real::ratio(707, 1000)))
            },
        },
    },
    Theorem {
        id: "dilation_between_cell_centres_misses_less_than_sqrt_2_cells",
        statement: "F-08: when the cells' centres are farther apart than r, no point of the occupied \
                    cell is sqrt(2) cell widths or more inside the disk",
        domain: "all cells and resolutions > 0, r >= 0",
        claim: missed_by_less_than_two_half_diagonals,
        wrong: Wrong { statement: "1.4 cell widths or more", claim: missed_by_less_than_1_4 },
    },
    Theorem {
        id: "dilation_between_cell_centres_misses_up_to_sqrt_2_cells",
        statement: "F-08: a centre d inside the cell diagonal to an occupied one, r = sqrt(2) widths - d: \
                    unmarked, and the occupied cell's corner is deeper than sqrt(2) widths - 3 d in \
                    the disk; so sqrt(2) is the supremum",
        domain: "all resolutions > 0, 0 < d < resolution",
        claim: || missed_by(3),
        wrong: Wrong { statement: "deeper than sqrt(2) widths - d", claim: || missed_by(1) },
    },
];

/// A cell of which a point is within r of a centre, the centre and r.
fn reached() -> (Cell, Vector, Real) {
    let (cell, centre, r) = (Cell::new("cell"), vector("centre"), Real::variable("r"));
    given(at_most(&Real::zero(), &r));
    given(at_most(&(&cell.within - &centre).length(), &r));
    (cell, centre, r)
}

fn part_is_covered(share: &Real) -> Formula {
    let [n, i, length, width] = ["n", "i", "L", "W"].map(Real::variable);
    for number in [&n, &length, &width] {
        given(less(&Real::zero(), number));
    }
    let half = Real::ratio(1, 2);
    let [x, y] = ["x", "y"].map(Real::variable);
    let [begin, end] = part(&i, &n, &length);
    for (low, coordinate, high) in [(&begin, &x, &end), (&-(&width * &half), &y, &(&width * &half))]
    {
        given(at_most(low, coordinate));
        given(at_most(coordinate, high));
    }
    let centre = Vector { x: disk_offset(&i, &n, &length), y: Real::zero() };
    let r = disk_radius(&length, &width, &n) * share;
    at_most(&(&Vector { x, y } - &centre).squared(), &r.square())
}

/// Where the part of a disk begins and ends on the long axis: L/n each way around its centre.
fn part(i: &Real, n: &Real, length: &Real) -> [Real; 2] {
    let half = length / (Real::from_integer(2) * n);
    let centre = disk_offset(i, n, length);
    [&centre - &half, centre + half]
}

fn parts_join(first: i128) -> Formula {
    let [n, i, length] = ["n", "i", "L"].map(Real::variable);
    for number in [&n, &length] {
        given(less(&Real::zero(), number));
    }
    let one = Real::from_integer(1);
    let part = |i: &Real| part(i, &n, &length);
    let [first, this, next, last] =
        [&Real::from_integer(first), &i, &(&i + &one), &(&n - &one)].map(part);
    let half = &length * Real::ratio(1, 2);
    Formula::All(vec![equal(&first[0], &-&half), equal(&this[1], &next[0]), equal(&last[1], &half)])
}

/// A cell and a point in it.
struct Cell {
    resolution: Real,
    column: Real,
    row: Real,
    within: Vector,
}

impl Cell {
    fn new(name: &str) -> Self {
        let resolution = Real::named("resolution");
        given(less(&Real::zero(), &resolution));
        let [column, row] = ["column", "row"].map(|axis| Real::variable(&format!("{axis} {name}")));
        let coordinate = |axis: &str, place: &Real| {
            let share = Real::variable(&format!("share of {name} {axis}"));
            given(at_most(&Real::zero(), &share));
            given(at_most(&share, &Real::from_integer(1)));
            (place + share) * &resolution
        };
        let within = Vector { x: coordinate("x", &column), y: coordinate("y", &row) };
        Self { resolution, column, row, within }
    }

    fn centre(&self) -> Vector {
        let half = Real::ratio(1, 2);
        Vector {
            x: (&self.column + &half) * &self.resolution,
            y: (&self.row + &half) * &self.resolution,
        }
    }

    /// From the centre to a corner, m.
    fn half_diagonal(&self) -> Real {
        &self.resolution * root_of_2() * Real::ratio(1, 2)
    }
}

/// sqrt(2), m per m of a cell's side.
fn root_of_2() -> Real {
    Real::from_integer(2).sqrt()
}

/// The paper's rule: centre in one cell, an occupied other one; not marked, so r is less than the
/// distance of the cells' centres. Depth of a point of the occupied cell in the disk.
fn missed_by_less_than_two_half_diagonals() -> Formula {
    forget_of_what_roots_are();
    let (own, occupied) = (Cell::new("own"), Cell::new("occupied"));
    let r = Real::variable("r");
    given(less(&r, &(&occupied.centre() - &own.centre()).length()));
    // From centre to centre over the two points.
    let from_own = &own.within - &own.centre();
    let to_occupied = &occupied.centre() - &occupied.within;
    let gap = &occupied.within - &own.within;
    given(triangle(&(&from_own + &gap), &to_occupied));
    given(triangle(&from_own, &gap));
    for offset in [&from_own, &to_occupied] {
        given(at_most(&offset.length(), &own.half_diagonal()));
    }
    less(&(&r - gap.length()), &(own.half_diagonal() * Real::from_integer(2)))
}

/// The same of two diagonal cells.
fn missed_by_less_than_1_4() -> Formula {
    let [own, occupied] = [("own", -1), ("occupied", 0)].map(|(name, place)| {
        let cell = Cell::new(name);
        for coordinate in [&cell.column, &cell.row] {
            given(equal(coordinate, &Real::from_integer(place)));
        }
        cell
    });
    let r = Real::variable("r");
    given(less(&r, &(&own.resolution * root_of_2())));
    let gap = &occupied.within - &own.within;
    less(&(&r - gap.length()), &(&own.resolution * Real::ratio(14, 10)))
}

/// The disk's centre is d to the left and below of the corner (0, 0) of the occupied cell.
fn missed_by(times: i128) -> Formula {
    let [resolution, d] = ["resolution", "d"].map(Real::variable);
    given(less(&Real::zero(), &d));
    given(less(&d, &resolution));
    let zero = || Real::zero();
    let half = &resolution * Real::ratio(1, 2);
    let [own, occupied] =
        [-&half, half].map(|coordinate| Vector { x: coordinate.clone(), y: coordinate });
    let r = root_of_2() * &resolution - &d;
    let gap = (&Vector { x: zero(), y: zero() } - &Vector { x: -&d, y: -&d }).length();
    let sought = root_of_2() * &resolution - Real::from_integer(times) * &d;
    Formula::All(vec![less(&r, &(&occupied - &own).length()), less(&sought, &(r - gap))])
}
