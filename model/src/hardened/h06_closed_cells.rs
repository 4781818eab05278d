//! H-06: a disk collides with every cell whose closed square it reaches; what is unknown or outside the
//! grid counts as occupied, unless detections are current. In `AllRemote` and `PlanRemote`, where the paper
//! does not examine the grid when another stage ran, with at least one current detection the CAV's
//! rectangle has to reach the cell, too.

use crate::input::scene::{Grid, Scene};
use crate::numbers::cells::{Cell, Hit, around, centre, distance_to_cell};
use crate::numbers::real::Real;
use crate::numbers::rectangle::{Rectangle, may_share_a_point};
use crate::numbers::vector::{Frame, Vector};
use crate::report::Rule;
use crate::services::configuration::Configuration;

/// What the CAV (its rectangle), a disk of it with its centre (in the frame of the grid) and the radius r must
/// not reach.
pub type Test<'a> = Box<dyn Fn(&Rectangle, &Vector, &Real) -> Option<Hit> + 'a>;

/// The rules in the order in which they are asked of all disks.
pub fn rules<'a>(scene: &'a Scene, grid: &'a Grid) -> Vec<(Rule, Test<'a>)> {
    let is_detected = scene.detections.as_ref().is_some_and(|list| !list.items.is_empty());
    let is_exact = is_detected && scene.configuration != Configuration::MotRemote;
    let touched = |is_kind: fn(&Grid, Cell) -> bool| -> Test<'a> {
        Box::new(move |cav, centre, r| {
            touched_cells(scene, grid, centre, r, is_kind).find(|hit| {
                let square = hit.cell.map(|cell| square(grid, cell));
                let reaches = |square| may_share_a_point(&scene.reads, cav, &square);
                !is_exact || square.is_some_and(reaches)
            })
        })
    };
    let occupied = (Rule::Occupied, touched(Grid::is_occupied));
    if scene.detections.is_some() {
        return vec![occupied];
    }
    let outside: Test = Box::new(|_, centre, r| touched_border(scene, grid, centre, r));
    vec![occupied, (Rule::Unknown, touched(Grid::is_unknown)), (Rule::Outside, outside)]
}

/// The closed square of a cell.
fn square(grid: &Grid, cell: Cell) -> Rectangle {
    let middle = centre(cell, &grid.resolution);
    let direction = grid.frame.direction.clone();
    let frame = Frame { origin: grid.frame.point(&middle.x, &middle.y), direction };
    Rectangle::new(frame, &grid.resolution, &grid.resolution)
}

/// The cells of a kind whose closed square is at distance <= r from the centre, by row and column.
fn touched_cells(
    scene: &Scene,
    grid: &Grid,
    centre: &Vector,
    r: &Real,
    is_kind: fn(&Grid, Cell) -> bool,
) -> impl Iterator<Item = Hit> {
    let near = around(centre, &scene.reads.raised(r), &grid.resolution);
    grid.cells(near).filter(move |cell| is_kind(grid, *cell)).filter_map(move |(i, k)| {
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
