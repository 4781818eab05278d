//! Stage v: paper Sec. IV-F, "Trajectory Validation with a Grid Map", within Eq. (4)
//! (`spec/3-stages.md#stage-v-trajectory-with-grid-map`):
//!
//! the footprint is covered by disks of one radius r; the grid is dilated by r; no disk centre at a
//! trajectory point within s_b lies in a marked cell

use crate::input::scene::{Grid, Point, Scene};
use crate::numbers::cells::{self, Cell, Hit, around, mark_at};
use crate::numbers::real::Real;
use crate::numbers::rectangle::Rectangle;
use crate::numbers::vector::{Frame, Vector};
use crate::report::{Rule, Witness};
use crate::stages::distances::s_b;
use crate::stages::horizon::points_within;
use crate::stages::llcc::cav;

/// Checks the trajectory in the dilated grid; `None` passes.
pub fn trajectory_with_grid_map(
    scene: &Scene,
    trajectory: &[Point],
    grid: &Grid,
) -> Option<Witness> {
    let places = places(scene, trajectory).enumerate();
    first_hit(scene, grid, Rule::Occupied, places, |disk| dilated(scene, grid, disk))
}

/// The CAV at the poses within s_b(v_now).
pub fn places(scene: &Scene, trajectory: &[Point]) -> impl Iterator<Item = Rectangle> {
    let s_b = s_b(&scene.ego.v_now, &scene.parameters.a_b);
    points_within(scene, trajectory, &s_b).iter().map(|point| cav(scene, &point.pose))
}

/// A disk of the CAV at one of the places that are examined.
#[derive(Debug)]
pub struct Disk<'a> {
    /// The number of the place.
    pub point: usize,
    /// The CAV there.
    pub cav: &'a Rectangle,
    /// The centre of the disk, in the frame of the grid.
    pub centre: &'a Vector,
    /// Its radius, m.
    pub r: &'a Real,
}

/// The first of the numbered places, and of its disks, that `hits` something.
pub fn first_hit(
    scene: &Scene,
    grid: &Grid,
    rule: Rule,
    mut places: impl Iterator<Item = (usize, Rectangle)>,
    hits: impl Fn(&Disk) -> Option<Hit>,
) -> Option<Witness> {
    places.find_map(|(point, cav)| {
        let r = radius(scene, &cav.half_width);
        disk_centres(scene, grid, &cav.frame).iter().enumerate().find_map(|(d, centre)| {
            let Hit { cell, distance } = hits(&Disk { point, cav: &cav, centre, r: &r })?;
            let witness = Witness::new(rule, &distance, &r).at_point(point);
            Some(Witness { disk: Some(d), cell, ..witness })
        })
    })
}

/// The centre of a disk lies in a cell that the dilated grid marks.
pub fn dilated(scene: &Scene, grid: &Grid, disk: &Disk) -> Option<Hit> {
    let mark = |cell| mark(scene, grid, disk.r, cell);
    mark_at(&scene.reads, disk.centre, &grid.resolution, mark)
}

/// (2i+1) L/(2n) - L/2: from the rectangle's centre to that of the disk i of n, m (S5-01).
pub fn disk_offset(i: &Real, n: &Real, length: &Real) -> Real {
    let two = Real::from_integer(2);
    (&two * i + Real::from_integer(1)) * length / (&two * n) - length / two
}

/// r = sqrt((L/n)^2 + W^2) / 2, m (S5-02).
pub fn disk_radius(length: &Real, width: &Real, n: &Real) -> Real {
    ((length / n).square() + width.square()).sqrt() / Real::from_integer(2)
}

/// The radius for a CAV of this half width, m.
pub fn radius(scene: &Scene, half_width: &Real) -> Real {
    let n = Real::from_integer(scene.parameters.n.into());
    disk_radius(&scene.ego.length, &(Real::from_integer(2) * half_width), &n)
}

/// The centres of the n disks on the long axis of the CAV's rectangle, in the frame of the grid.
fn disk_centres(scene: &Scene, grid: &Grid, cav: &Frame) -> Vec<Vector> {
    let disk = |i: i64| {
        let [i, n] = [i, scene.parameters.n].map(|number| Real::from_integer(number.into()));
        let along = disk_offset(&i, &n, &scene.ego.length);
        grid.frame.coordinates(&cav.point(&along, &Real::zero()))
    };
    (0..scene.parameters.n).map(disk).collect()
}

/// The grid dilated by r marks the cells of the array whose centre is at distance <= r from the centre
/// of some occupied cell: what marks this cell is the first such, by row and column.
fn mark(scene: &Scene, grid: &Grid, r: &Real, cell: Cell) -> Option<Hit> {
    if !grid.holds(cell) {
        return None;
    }
    let centre = |cell: Cell| cells::centre(cell, &grid.resolution);
    // No cell that is not around the centre is so near.
    let near = around(&centre(cell), &scene.reads.raised(r), &grid.resolution);
    grid.cells(near).filter(|other| grid.is_occupied(*other)).find_map(|occupied| {
        let distance = centre(cell).distance(&centre(occupied));
        let marks = scene.reads.may_be_at_most(&distance, r);
        marks.then_some(Hit { cell: Some(occupied), distance })
    })
}
