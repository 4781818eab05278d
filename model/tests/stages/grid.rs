//! `spec/3-stages.md#stage-v-trajectory-with-grid-map`, H-06

use mufasa_model::input::cycle::{Cycle, Profile};
use mufasa_model::report::{Rule, Stage};
use mufasa_model::services::configuration::Configuration::MotRemote;

use crate::base::*;

/// Cells of 1 m; disks of the CAV at -1.5, -0.5, 0.5, 1.5 m with r = sqrt(5)/2.
fn with(profile: Profile, occupied: &[(f64, f64)]) -> Cycle {
    let mut cycle = base(profile, MotRemote);
    let grid = cycle.grid.as_mut().expect("there is a grid");
    for &(x, y) in occupied {
        mark(&mut grid.occupied, x, y);
    }
    cycle
}

fn shifted(mut cycle: Cycle, y: f64) -> Cycle {
    for point in &mut cycle.trajectory.as_mut().expect("there is one").points {
        point.y += y;
    }
    cycle
}

/// spec/3-stages.md#stage-v-trajectory-with-grid-map.1: the four neighbours of an occupied cell are
/// nearer than r = 1.118 cells, the diagonal ones (1.414) are not.
#[test]
fn cells_within_r_of_an_occupied_cell_are_marked() {
    let passes_at = |y: f64| passes(&shifted(with(Profile::Paper, &[(3.5, 2.5)]), y), Stage::V);
    assert!(!passes_at(2.5));
    assert!(!passes_at(1.5));
    assert!(passes_at(0.5));
    assert!(!passes_at(3.5 - 0.999));
    // Only the diagonal neighbour is reached: the last disk ends in column 7, the obstacle is in 8.
    let corner = |x: f64| passes(&shifted(with(Profile::Paper, &[(x, 1.5)]), 0.5), Stage::V);
    assert!(!corner(7.5), "disk at 6 + 1.5, cell above it");
    assert!(corner(8.5));
}

/// spec/3-stages.md#stage-v-trajectory-with-grid-map.1: at distance exactly r a cell is marked.
#[test]
fn a_cell_at_distance_r_is_marked() {
    // L/n = 6 and W = 8: r = 5; from the disk at 9.5 the cell at (12.5, 4.5) is 3 and 4 cells off.
    let with_width = |width: f64| {
        let mut cycle = shifted(with(Profile::Paper, &[(12.5, 4.5)]), 0.5);
        cycle.trajectory.as_mut().expect("there is one").points[0].x = 0.5;
        cycle.ego.speed = 0.0;
        (cycle.ego.length, cycle.ego.width) = (24.0, width);
        cycle
    };
    let found = witness(&with_width(8.0), Stage::V);
    assert_eq!((found.rule, found.point, found.disk), (Rule::Occupied, Some(0), Some(3)));
    assert_eq!(found.cell, Some((62, 54)));
    assert_eq!(found.compared.map(f64::to_bits), [5.0, 5.0].map(f64::to_bits));
    assert!(passes(&with_width(8.0f64.next_down()), Stage::V));
}

/// spec/3-stages.md#stage-v-trajectory-with-grid-map.2, I-03: a disk centre on the border of cells
/// lies in each of them.
#[test]
fn a_centre_on_a_border_lies_in_both_cells() {
    // y = 0 is the border of the rows [-1, 0] and [0, 1]; the obstacle in [1, 2] marks [0, 1].
    let obstacle = with(Profile::Paper, &[(3.5, 1.5)]);
    assert!(!passes(&obstacle, Stage::V));
    assert!(passes(&shifted(obstacle, -1e-300), Stage::V));
}

/// spec/3-stages.md#stage-v-trajectory-with-grid-map.2: up to s_b(v_now), 6.25 m at 10 m/s.
#[test]
fn points_beyond_s_b_do_not_count() {
    // The foremost disk centre is at 6 + 1.5 m; a cell marks its neighbour.
    assert!(!passes(&with(Profile::Paper, &[(8.5, 0.5)]), Stage::V));
    assert!(passes(&with(Profile::Paper, &[(9.5, 0.5)]), Stage::V));
}

/// spec/3-stages.md#stage-v-trajectory-with-grid-map.3, I-07: unknown cells and places outside the
/// grid are free in the paper profile.
#[test]
fn unknown_and_outside_are_free_in_paper() {
    let mut cycle = with(Profile::Paper, &[]);
    let grid = cycle.grid.as_mut().expect("there is a grid");
    grid.unknown = Some(vec![0xff; grid.occupied.len()]);
    assert!(passes(&cycle, Stage::V));
    let grid = cycle.grid.as_mut().expect("there is a grid");
    (grid.x, grid.y) = (500.0, 500.0);
    assert!(passes(&cycle, Stage::V));
}

/// The grid has a frame of its own, whose direction need not be of length 1.
#[test]
fn the_grid_is_rotated() {
    let mut cycle = with(Profile::Paper, &[]);
    let grid = cycle.grid.as_mut().expect("there is a grid");
    // Rows go north: the cell (column i, row k) covers x from -k-1 to -k, y from i to i + 1.
    (grid.x, grid.y, grid.cos, grid.sin) = (50.0, -50.0, 0.0, 1.0);
    let bit = 45 * 200 + 50;
    grid.occupied[bit / 8] |= 1 << (bit % 8);
    assert_eq!(witness(&cycle, Stage::V).cell, Some((50, 45)));
    // x from 4 to 5, y from 0 to 1: the first disk centre there or beside it is 1.5 m ahead of 2.
    assert_eq!(witness(&cycle, Stage::V).point, Some(2));
}

/// H-06: a cell collides when its closed square is at distance <= r from a disk centre (F-08).
#[test]
fn hardened_compares_with_the_whole_cell() {
    let with_width = |width: f64| {
        let mut cycle = with(Profile::Hardened, &[(3.5, 5.5)]);
        (cycle.ego.length, cycle.ego.width) = (24.0, width);
        cycle
    };
    let found = witness(&with_width(8.0), Stage::V);
    assert_eq!((found.rule, found.cell), (Rule::Occupied, Some((53, 55))));
    assert_eq!(found.compared.map(f64::to_bits), [5.0, 5.0].map(f64::to_bits));
    assert!(passes(&with_width(8.0f64.next_down()), Stage::V));
}

/// H-06: unknown cells count as occupied, unless stage iv ran; a cell both occupied and unknown is
/// occupied.
#[test]
fn hardened_unknown_is_occupied_unless_stage_iv_ran() {
    let mut cycle = with(Profile::Hardened, &[]);
    let grid = cycle.grid.as_mut().expect("there is a grid");
    let mut unknown = vec![0; grid.occupied.len()];
    mark(&mut unknown, 3.5, 1.5);
    grid.unknown = Some(unknown);
    assert!(passes(&cycle, Stage::V), "stage iv ran");
    cycle.detections = None;
    let found = witness(&cycle, Stage::V);
    assert_eq!((found.rule, found.cell), (Rule::Unknown, Some((53, 51))));
    mark(&mut cycle.grid.as_mut().expect("there is a grid").occupied, 3.5, 1.5);
    assert_eq!(witness(&cycle, Stage::V).rule, Rule::Occupied);
}

/// H-06: places outside the grid count as occupied, unless stage iv ran.
#[test]
fn hardened_outside_is_occupied_unless_stage_iv_ran() {
    let with_border = |y: f64, width: f64| {
        let mut cycle = with(Profile::Hardened, &[]);
        cycle.detections = None;
        (cycle.ego.length, cycle.ego.width) = (24.0, width);
        cycle.grid.as_mut().expect("there is a grid").y = y;
        cycle
    };
    assert_eq!(witness(&with_border(-5.0, 8.0), Stage::V).rule, Rule::Outside);
    assert!(passes(&with_border(-5.0, 8.0f64.next_down()), Stage::V));
    let mut iv_ran = with_border(-1.0, 8.0);
    iv_ran.detections = detections(vec![detection(60.0, 0.0)]);
    assert!(passes(&iv_ran, Stage::V));
    // The trajectory leaves the grid altogether.
    assert_eq!(witness(&with_border(20.0, 2.0), Stage::V).rule, Rule::Outside);
}
