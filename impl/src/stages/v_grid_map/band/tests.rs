//! A cell within reach of a disk, or touched by a rectangle, is in the band.

use std::vec::Vec;

use super::{Band, CellFrame};
use crate::input::cycle::{Cycle, Ego, Grid, Route, TrajectoryPoint};
use crate::input::parameters::Parameters;
use crate::input::profile::Profile;
use crate::numbers::plane::Vector;
use crate::numbers::rectangle::{Rectangle, possibly_touch};
use crate::random::Random;
use crate::services::configuration::Configuration;
use crate::stages::llcc::{Pose, footprint};
use crate::stages::v_grid_map::bitmap::Bitmap;

fn grid(random: &mut Random, occupied: &'static [u8]) -> Grid<'static> {
    let (sin, cos) = random.number(3.2).sin_cos();
    let (x, y) = (random.number(100.0), random.number(100.0));
    let resolution = 0.3 + random.number(0.2);
    Grid { stamp_ns: 0, x, y, cos, sin, resolution, width: 90, height: 70, occupied, unknown: None }
}

fn cycle(random: &mut Random, grid: Grid<'static>) -> Cycle<'static> {
    let ego = Ego {
        x: 0.0,
        y: 0.0,
        cos: 1.0,
        sin: 0.0,
        speed: 1.0,
        length: 4.0 + random.number(2.0),
        width: 2.0 + random.number(1.0),
        center_offset: random.number(2.0),
    };
    let n = 1 + random.below(6) as i64;
    Cycle {
        profile: Profile::PAPER,
        parameters: Parameters { n, ..Parameters::default() },
        now_ns: 0,
        configuration: Configuration::AllRemote,
        ego,
        trajectory: None,
        tracks: None,
        detections: None,
        lead: None,
        route: Route { closed: false, cross_sections: &[] },
        grid: Some(grid),
        detection_history: &[],
    }
}

/// Centres of all disks in cells, straight from the text.
fn disks(cycle: &Cycle<'_>, grid: &Grid<'_>, point: &TrajectoryPoint) -> Vec<[f64; 2]> {
    let (ego, n) = (&cycle.ego, cycle.parameters.n);
    let centre = |i: i64| {
        let along = (2 * i + 1) as f64 * ego.length / (2 * n) as f64 - ego.length / 2.0;
        let along = along + ego.center_offset;
        let (x, y) = (point.x + along * point.cos - grid.x, point.y + along * point.sin - grid.y);
        let (column, row) = (x * grid.cos + y * grid.sin, y * grid.cos - x * grid.sin);
        [column / grid.resolution, row / grid.resolution]
    };
    (0..n).map(centre).collect()
}

/// A cell near a disk of one of the points, here or there: whether the band is free of it, and
/// whether a disk reaches it, which must not both be.
fn try_cell(
    random: &mut Random,
    cycle: &Cycle<'_>,
    grid: &Grid<'_>,
    points: &[TrajectoryPoint],
) -> (bool, bool) {
    let band = Band::new(&CellFrame::new(cycle, grid), points.iter().copied());
    let all: Vec<_> = points.iter().flat_map(|point| disks(cycle, grid, point)).collect();
    let [x, y] = all[random.below(all.len() as u64) as usize];
    let mut around = |at: f64, count: i64| {
        (at + random.number(12.0)).floor().clamp(0.0, (count - 1) as f64) as i64
    };
    let (column, row) = (around(x, 90), around(y, 70));
    let mut bits = [0; 90 * 70 / 8 + 1];
    let bit = (row * 90 + column) as usize;
    bits[bit / 8] |= 1 << (bit % 8);
    let is_free = band.is_free(&Bitmap { bits: &bits, width: 90, height: 70 });
    let disk = (cycle.ego.length / cycle.parameters.n as f64).hypot(cycle.ego.width) / 2.0;
    let reach = disk / grid.resolution + 0.5_f64.sqrt();
    let (mut outside, mut reached) = (false, false);
    for [x, y] in all {
        let apart = (x - column as f64 - 0.5).hypot(y - row as f64 - 0.5);
        reached |= apart <= reach;
        let inside = x > reach && y > reach && x < 90.0 - reach && y < 70.0 - reach;
        outside |= !inside;
    }
    assert!(!(reached && is_free), "{column} {row} {band:?}");
    assert!(!(outside && band.is_within(90, 70)), "{band:?}");
    (is_free, reached)
}

#[test]
fn what_a_disk_can_reach_is_in_the_band() {
    let mut random = Random::new(21);
    let (mut free, mut near) = (0, 0);
    for _ in 0..20_000 {
        let grid = grid(&mut random, &[]);
        let cycle = cycle(&mut random, grid);
        let side = grid.resolution * 60.0;
        let (a, b) = (side * (0.5 + random.number(0.8)), side * 0.5);
        let start = [grid.x + a * grid.cos - b * grid.sin, grid.y + a * grid.sin + b * grid.cos];
        let points: Vec<TrajectoryPoint> = (0..=random.below(4))
            .map(|i| {
                let (sin, cos) = (0.3 * i as f64 + random.number(0.2)).sin_cos();
                let (x, y) = (start[0] + i as f64 * 1.3, start[1] + random.number(0.5));
                TrajectoryPoint { t_ns: i as i64, x, y, cos, sin }
            })
            .collect();
        let (is_free, reached) = try_cell(&mut random, &cycle, &grid, &points);
        free += u32::from(is_free);
        near += u32::from(reached);
    }
    assert!(free > 1_000 && near > 200, "{free} {near}");
}

#[test]
fn what_a_rectangle_can_touch_is_in_the_band() {
    let mut random = Random::new(23);
    let (mut free, mut touched) = (0, 0);
    for _ in 0..20_000 {
        let mut grid = grid(&mut random, &[]);
        // As far from a unit vector as the domain allows.
        let stretch = 1.0 + random.number(4.9e-7);
        (grid.cos, grid.sin) = (grid.cos * stretch, grid.sin * stretch);
        let cycle = cycle(&mut random, grid);
        let cell = |column: i64, row: i64| {
            let [a, b] = [column, row].map(|index| (index as f64 + 0.5) * grid.resolution);
            let (cos, sin) = (grid.cos, grid.sin);
            let centre = Vector::new(grid.x + a * cos - b * sin, grid.y + a * sin + b * cos);
            let side = grid.resolution;
            Rectangle { centre, direction: Vector::new(cos, sin), length: side, width: side }
        };
        let start = cell(random.below(90) as i64, random.below(70) as i64).centre;
        let [x, y] = [start.x, start.y].map(|it| it.value() + random.number(3.0));
        let points: Vec<TrajectoryPoint> = (0..=random.below(3))
            .map(|i| {
                let (sin, cos) = (0.2 * i as f64 + random.number(3.2)).sin_cos();
                TrajectoryPoint { t_ns: i as i64, x: x + i as f64, y, cos, sin }
            })
            .collect();
        let band = Band::new(&CellFrame::with_rectangle(&cycle, &grid), points.iter().copied());
        for _ in 0..20 {
            let (column, row) = (random.below(90) as i64, random.below(70) as i64);
            let mut bits = [0; 90 * 70 / 8 + 1];
            let bit = (row * 90 + column) as usize;
            bits[bit / 8] |= 1 << (bit % 8);
            let cells = Bitmap { bits: &bits, width: 90, height: 70 };
            let is_free = band.is_free(&cells);
            let left_out = |other: i64| move |i, k| (i, k) == (column, row + other);
            assert!(band.is_free_but(&cells, left_out(0)));
            assert_eq!(band.is_free_but(&cells, left_out(1)), is_free);
            let square = cell(column, row);
            let touches = |point| possibly_touch(&footprint(&cycle.ego, &Pose::of(point)), &square);
            let touches = points.iter().any(touches);
            assert!(!(touches && is_free), "{column} {row} {band:?}");
            free += u32::from(is_free);
            touched += u32::from(touches);
        }
    }
    assert!(free > 1_000 && touched > 1_000, "{free} {touched}");
}

/// Bands almost along a row or a column, where a small component divides, of which one end is in
/// the grid and the other one up to 10,000 km away.
#[test]
fn a_band_almost_upright_is_wide_enough() {
    let mut random = Random::new(22);
    let (mut free, mut near) = (0, 0);
    for case in 0..20_000 {
        let grid = Grid { cos: 1.0, sin: 0.0, ..grid(&mut random, &[]) };
        let cycle = cycle(&mut random, grid);
        let (slope, length) = (
            [3e-7, 1.1e-6, 1e-5, 1e-3][case % 4] * (1.0 + random.number(0.5)),
            [3.0, 1e2, 1e4, 1e7][random.below(4) as usize],
        );
        let swap = |[x, y]: [f64; 2]| if case % 8 < 4 { [x, y] } else { [y, x] };
        let [cos, sin] = swap([slope, 1.0]);
        let inside = [grid.x, grid.y].map(|at| at + grid.resolution * (30.0 + random.number(20.0)));
        let ends = [[0.0, 0.0], swap([length * slope, length])];
        let mut points = ends.map(|[x, y]| {
            let [x, y] = [inside[0] - x, inside[1] - y];
            TrajectoryPoint { t_ns: 0, x, y, cos, sin }
        });
        if case % 16 < 8 {
            points.reverse();
        }
        let (is_free, reached) = try_cell(&mut random, &cycle, &grid, &points);
        free += u32::from(is_free);
        near += u32::from(reached);
    }
    assert!(free > 1_000 && near > 200, "{free} {near}");
}
