//! H-06: a disk collides with every cell whose closed square it reaches; what is unknown or outside the
//! grid counts as occupied, unless stage iv ran in this cycle.

use crate::input::scene::{Grid, Scene};
use crate::numbers::cells::{Cell, Hit, around, distance_to_cell};
use crate::numbers::real::Real;
use crate::numbers::vector::Vector;
use crate::report::Rule;

/// What a disk with its centre (in the frame of the grid) and the radius r must not reach.
pub type Test = fn(&Scene, &Grid, &Vector, &Real) -> Option<Hit>;

/// The rules in the order in which they are asked of all disks.
pub fn rules(stage_iv_ran: bool) -> Vec<(Rule, Test)> {
    let occupied: (Rule, Test) = (Rule::Occupied, |scene, grid, centre, r| {
        touched_cell(scene, grid, centre, r, Grid::is_occupied)
    });
    let unknown: (Rule, Test) = (Rule::Unknown, |scene, grid, centre, r| {
        touched_cell(scene, grid, centre, r, Grid::is_unknown)
    });
    let outside: (Rule, Test) = (Rule::Outside, touched_border);
    if stage_iv_ran { vec![occupied] } else { vec![occupied, unknown, outside] }
}

/// The first cell of a kind whose closed square is at distance <= r from the centre.
fn touched_cell(
    scene: &Scene,
    grid: &Grid,
    centre: &Vector,
    r: &Real,
    is_kind: fn(&Grid, Cell) -> bool,
) -> Option<Hit> {
    let near = around(centre, &scene.reads.raised(r), &grid.resolution);
    grid.cells(near).filter(|cell| is_kind(grid, *cell)).find_map(|(i, k)| {
        let cell = [i, k].map(|number| Real::from_integer(number.into()));
        let distance = distance_to_cell(centre, cell.each_ref(), &grid.resolution);
        scene.reads.may_be_at_most(&distance, r).then_some(Hit { cell: Some((i, k)), distance })
    })
}

/// A place outside the grid is at distance <= r.
fn touched_border(scene: &Scene, grid: &Grid, centre: &Vector, r: &Real) -> Option<Hit> {
    let side = |cells: i64| Real::from_integer(cells.into()) * &grid.resolution;
    let inside = [
        centre.x.clone(),
        side(grid.width) - &centre.x,
        centre.y.clone(),
        side(grid.height) - &centre.y,
    ];
    let distance = inside.into_iter().min()?.max(Real::zero());
    scene.reads.may_be_at_most(&distance, r).then_some(Hit { cell: None, distance })
}
