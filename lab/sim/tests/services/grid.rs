//! The occupancy grid: occupied where edges are seen, free before them, unknown behind.

use core::f64::consts::TAU;

use mufasa::input::cycle::Grid;
use mufasa_sim::pose::{Point, Pose};
use mufasa_sim::services::detectors::scan::Sweep;
use mufasa_sim::services::detectors::scene::{Scene, Seen};
use mufasa_sim::services::grid::{OccupancyMap, OwnedGrid, Settings};

use super::scene::{car, ego_at};

fn bit(bits: &[u8], index: i64) -> bool {
    let index = usize::try_from(index).expect("inside");
    bits[index / 8] >> (index % 8) & 1 == 1
}

/// Occupied and unknown, of the cell around a place.
fn cell(grid: &Grid<'_>, x: f64, y: f64) -> (bool, bool) {
    assert_eq!((grid.cos, grid.sin), (1.0, 0.0));
    let column = ((x - grid.x) / grid.resolution).floor() as i64;
    let row = ((y - grid.y) / grid.resolution).floor() as i64;
    assert!((0..grid.width).contains(&column) && (0..grid.height).contains(&row));
    let index = row * grid.width + column;
    (bit(grid.occupied, index), bit(grid.unknown.expect("asked for"), index))
}

const FREE: (bool, bool) = (false, false);
const OCCUPIED: (bool, bool) = (true, false);
const UNKNOWN: (bool, bool) = (false, true);

fn update(map: &mut OccupancyMap, pose: Pose, objects: &[Seen]) -> OwnedGrid {
    let sensor = Pose { at: pose.ahead(1.4, 0.0), ..pose };
    let scan = Sweep::new(60.0, TAU, 720).scan(&Scene { objects, walls: &[] }, sensor, None);
    map.update(7, &ego_at(pose, 0.0), &scan)
}

#[test]
fn edges_are_occupied_what_lies_between_is_free_and_what_lies_behind_unknown() {
    for angle in [0.0, 0.7, 2.0, -2.5] {
        let mut map = OccupancyMap::new(Settings::default());
        let pose = Pose::new(Point::new(103.2, -57.9), angle);
        let other = Pose { at: pose.ahead(18.0, 0.0), ..pose };
        let mut grid = update(&mut map, pose, &[car(1, other, 0.0)]);
        for _ in 0..3 {
            grid = update(&mut map, pose, &[car(1, other, 0.0)]);
        }
        let grid = grid.borrow(true);
        assert_eq!((grid.stamp_ns, grid.width, grid.height), (7, 120, 120));
        // Its rear edge, but for the ends, whose cells it hardly reaches into.
        for step in -7..=7 {
            let place = other.ahead(-2.25 + 0.05, 0.1 * f64::from(step));
            assert_eq!(cell(&grid, place.x, place.y), OCCUPIED, "{angle} {step}");
        }
        for step in 4..28 {
            for left in [-0.6, 0.0, 0.6] {
                let place = pose.ahead(0.5 * f64::from(step), left);
                assert_eq!(cell(&grid, place.x, place.y), FREE, "{angle} {step} {left}");
            }
        }
        let behind = other.ahead(4.0, 0.0);
        assert_eq!(cell(&grid, behind.x, behind.y), UNKNOWN);
        // Nothing else is occupied.
        let (mut occupied, mut outside) = (0, 0);
        for row in 0..120 {
            for column in 0..120 {
                let at = |index| (f64::from(index) + 0.5) * 0.5;
                let place = Point::new(grid.x + at(column), grid.y + at(row));
                if cell(&grid, place.x, place.y).0 {
                    let (ahead, left) = other.local(place);
                    occupied += 1;
                    outside += i32::from(ahead.abs() > 2.25 + 0.36 || left.abs() > 0.9 + 0.36);
                }
            }
        }
        assert!(occupied >= 4 && outside == 0, "{occupied} {outside}");
    }
}

#[test]
fn the_own_footprint_is_free() {
    let mut map = OccupancyMap::new(Settings::default());
    let pose = Pose::new(Point::new(10.0, 20.0), 0.4);
    // Bumper to bumper: its edge is in cells that the ego covers, too.
    let touching = Pose { at: pose.ahead(1.4 + 2.4 + 2.25, 0.0), ..pose };
    let grid = update(&mut map, pose, &[car(1, touching, 0.0)]);
    let grid = grid.borrow(true);
    let mut occupied = 0;
    for row in 0..120 {
        for column in 0..120 {
            let at = |index| (f64::from(index) + 0.5) * 0.5;
            let place = Point::new(grid.x + at(column), grid.y + at(row));
            let (ahead, left) = pose.local(place);
            let state = cell(&grid, place.x, place.y);
            occupied += i32::from(state.0);
            if (ahead - 1.4).abs() <= 2.4 && left.abs() <= 0.95 {
                assert_eq!(state, FREE, "{ahead} {left}");
            }
        }
    }
    assert!(occupied > 0);
}

#[test]
fn what_moves_away_is_free_two_scans_later_and_places_stay_when_the_map_moves() {
    let mut map = OccupancyMap::new(Settings::default());
    let still = Pose::new(Point::new(12.0, 8.0), 0.0);
    for cycle in 0..40 {
        let pose = Pose::new(Point::new(0.3 * f64::from(cycle), 0.0), 0.0);
        let moving = Pose::new(Point::new(15.0 + 0.6 * f64::from(cycle), 0.0), 0.0);
        let grid = update(&mut map, pose, &[car(1, moving, 12.0), car(2, still, 0.0)]);
        let grid = grid.borrow(true);
        if cycle < 4 {
            continue;
        }
        // The rear edge three cycles ago, 1.8 m behind: free again.
        let rear = moving.at.x - 2.25;
        assert_eq!(cell(&grid, rear - 1.8, 0.0), FREE, "{cycle}");
        assert!(cell(&grid, rear + 0.05, 0.0).0, "{cycle}");
        // The edge towards the road of what stands, seen from where the map has moved to.
        assert_eq!(cell(&grid, 12.0, 7.15), OCCUPIED, "{cycle}");
    }
}

#[test]
fn what_is_known_stays_in_its_place_when_the_map_moves_any_way() {
    for (x, y) in [(3.0, 0.0), (-3.0, 0.0), (0.0, 4.0), (0.0, -4.0), (2.6, -7.3)] {
        let mut map = OccupancyMap::new(Settings::default());
        let object = car(1, Pose::new(Point::new(12.0, 8.0), 0.0), 0.0);
        for _ in 0..3 {
            update(&mut map, Pose::new(Point::default(), 0.0), &[object]);
        }
        // A scan that sees hardly anything: one ray.
        let pose = Pose::new(Point::new(x, y), 0.0);
        let scan = Sweep::new(5.0, 0.1, 1).scan(&Scene { objects: &[], walls: &[] }, pose, None);
        let grid = map.update(8, &ego_at(pose, 0.0), &scan);
        let grid = grid.borrow(true);
        assert_eq!(cell(&grid, 12.0, 7.15), OCCUPIED, "{x} {y}");
        assert_eq!(cell(&grid, 12.0, 5.5), FREE, "{x} {y}");
        // Far from the vehicle, then beyond the map.
        let beyond = [28.6 * x.signum(), 28.6 * y.signum()];
        let new = Point::new(pose.at.x + beyond[0], pose.at.y + beyond[1]);
        assert_eq!(cell(&grid, new.x, new.y), UNKNOWN, "{x} {y}");
    }
}
