//! Stage v: paper Sec. IV-F, "Trajectory Validation with a Grid Map", within Eq. (4)
//! (`spec/3-stages.md#stage-v-trajectory-with-grid-map`, H-04, H-06):
//!
//! the footprint is covered by disks of one radius r; the grid is dilated by r; no disk centre at a
//! trajectory point within s_b lies in a marked cell

use crate::hardened::h06_closed_cells::{self, Place};
use crate::hardened::h14_fail_safe::path;
use crate::input::profile::HardenedRule;
use crate::input::scene::{Grid, Point, Scene};
use crate::numbers::cells::{self, Cell, Hit, around, mark_at};
use crate::numbers::real::Real;
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
    let (ego, n) = (&scene.ego, Real::from_integer(scene.parameters.n.into()));
    let s_b = s_b(&ego.v_now, &scene.parameters.a_b);
    let r = disk_radius(&ego.length, &ego.width, &n);
    let first = |rule: Rule, collides: &dyn Fn(&Place, &Vector) -> Option<Hit>| {
        places(scene, trajectory, &s_b).find_map(|(i, pose)| {
            let place = Place { cav: cav(scene, &pose), is_of_paper: i < trajectory.len() };
            disk_centres(scene, grid, &place.cav.frame).iter().enumerate().find_map(
                |(d, centre)| {
                    let Hit { cell, distance } = collides(&place, centre)?;
                    let witness = Witness::new(rule, &distance, &r).at_point(i);
                    Some(Witness { disk: Some(d), cell, ..witness })
                },
            )
        })
    };
    if scene.profile.has(HardenedRule::H06) {
        (h06_closed_cells::rules(scene, grid).into_iter())
            .find_map(|(rule, reaches)| first(rule, &|place, centre| reaches(place, centre, &r)))
    } else {
        first(Rule::Occupied, &|_, centre| {
            mark_at(&scene.reads, centre, &grid.resolution, |cell| mark(scene, grid, &r, cell))
        })
    }
}

/// The places that are examined, with their number: the points within s, and then (H-04) those of H-14.
fn places<'a>(
    scene: &'a Scene,
    trajectory: &'a [Point],
    s: &Real,
) -> impl Iterator<Item = (usize, Frame)> {
    let points = points_within(scene, trajectory, s).iter().map(|point| point.pose.clone());
    let asks_places = scene.profile.has(HardenedRule::H04);
    let places = asks_places.then(|| path::places(scene, trajectory).map(|place| place.pose));
    points.enumerate().chain((trajectory.len()..).zip(places.into_iter().flatten()))
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
