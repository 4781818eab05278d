//! H-06: a disk collides with every cell whose closed square it reaches; what is unknown or outside the
//! grid counts as occupied, unless detections are current. With at least one current detection the CAV's
//! rectangle has to reach the cell, too, and no detection may cover it: those iv and H-14 examine. In
//! `MotRemote` this holds at the places of H-14 alone: at its points the paper examines the grid beside
//! every other stage.

use crate::input::scene::{Grid, Object, Point, Scene};
use crate::numbers::cells::{Cell, Hit, around, centre, distance_to_cell};
use crate::numbers::real::Real;
use crate::numbers::rectangle::{Rectangle, may_share_a_point, share_a_point};
use crate::numbers::vector::{Frame, Vector};
use crate::report::Rule;
use crate::services::configuration::Configuration;
use crate::stages::v_grid_map::Disk;

/// Whether a disk of the CAV hits something.
pub type Test<'a> = Box<dyn Fn(&Disk) -> Option<Hit> + 'a>;

/// The rules in the order in which they are asked of all disks of a trajectory.
pub fn rules<'a>(
    scene: &'a Scene,
    trajectory: &'a [Point],
    grid: &'a Grid,
) -> Vec<(Rule, Test<'a>)> {
    let is_detected = scene.detections.as_ref().is_some_and(|list| !list.items.is_empty());
    let in_paper = scene.configuration == Configuration::MotRemote;
    let touched = |is_kind: fn(&Grid, Cell) -> bool| -> Test<'a> {
        Box::new(move |disk| {
            touched_cells(scene, grid, disk, is_kind).find(|hit| {
                let is_of_paper = disk.point < trajectory.len();
                let is_exact = is_detected && !(in_paper && is_of_paper);
                let square = hit.cell.map(|cell| square(grid, cell));
                let collides = |square: Rectangle| {
                    may_share_a_point(&scene.reads, disk.cav, &square)
                        && !is_covered(scene, &square)
                };
                !is_exact || square.is_some_and(collides)
            })
        })
    };
    let occupied = (Rule::Occupied, touched(Grid::is_occupied));
    if scene.detections.is_some() {
        return vec![occupied];
    }
    let outside: Test = Box::new(|disk| touched_border(scene, grid, disk));
    vec![occupied, (Rule::Unknown, touched(Grid::is_unknown)), (Rule::Outside, outside)]
}

/// The closed square of a cell.
fn square(grid: &Grid, cell: Cell) -> Rectangle {
    let middle = centre(cell, &grid.resolution);
    let direction = grid.frame.direction.clone();
    let frame = Frame { origin: grid.frame.point(&middle.x, &middle.y), direction };
    Rectangle::new(frame, &grid.resolution, &grid.resolution)
}

/// A current detection, 1/4 m longer and wider on each side, shares a point with the square.
fn is_covered(scene: &Scene, square: &Rectangle) -> bool {
    let quarter = Real::from_integer(1) / Real::from_integer(4);
    let grown = |half: &Real| scene.reads.lowered(&(half + &quarter));
    let covers = |it: &Object| share_a_point(&it.rectangle().with_halves(grown), square);
    scene.detections.iter().flat_map(|list| &list.items).any(covers)
}

/// The cells of a kind whose closed square is at distance <= r from the centre, by row and column.
fn touched_cells(
    scene: &Scene,
    grid: &Grid,
    disk: &Disk,
    is_kind: fn(&Grid, Cell) -> bool,
) -> impl Iterator<Item = Hit> {
    let (centre, r) = (disk.centre, disk.r);
    let near = around(centre, &scene.reads.raised(r), &grid.resolution);
    grid.cells(near).filter(move |cell| is_kind(grid, *cell)).filter_map(move |(i, k)| {
        let cell = [i, k].map(|number| Real::from_integer(number.into()));
        let distance = distance_to_cell(centre, cell.each_ref(), &grid.resolution);
        scene.reads.may_be_at_most(&distance, r).then_some(Hit { cell: Some((i, k)), distance })
    })
}

/// A place outside the grid is at distance <= r.
fn touched_border(scene: &Scene, grid: &Grid, disk: &Disk) -> Option<Hit> {
    let (Vector { x, y }, r) = (disk.centre, disk.r);
    let side = |cells: i64| Real::from_integer(cells.into()) * &grid.resolution;
    let inside = [x.clone(), side(grid.width) - x, y.clone(), side(grid.height) - y];
    let distance = inside.into_iter().min()?.max(Real::zero());
    scene.reads.may_be_at_most(&distance, r).then_some(Hit { cell: None, distance })
}
