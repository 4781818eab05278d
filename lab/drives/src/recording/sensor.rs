//! The local detectors and the local grid map, made from what is really there.

use mufasa_model::input::cycle::{Detection, DetectionList, Grid};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, Normal, Poisson};

use crate::geometry::{Point, Rectangle, add, direction, distance, dot, scale, sub};
use crate::options::{GridSize, Sensor};
use crate::recording::object::Seen;

/// Nothing is detected nearer than this, m: the CAV itself would be there.
const NEAREST: f64 = 4.0;
/// Side of a clutter detection, m.
const CLUTTER_SIZE: f64 = 0.5;
/// Clutter of one scan, at most; the domain allows 2048 detections.
const CLUTTER_MAX: f64 = 256.0;

/// One scan: every object within range with the sensor's probability, its position with the
/// sensor's noise; then clutter, even over the disk of its range. `scan` numbers the scans of a
/// drive and makes each independent of the others. A number that is no deviation, probability or
/// rate counts as 0.
pub(crate) fn scan(
    sensor: &Sensor,
    scan: u64,
    stamp_ns: i64,
    cav: Point,
    objects: &[Seen],
) -> DetectionList {
    let mut rng = ChaCha8Rng::seed_from_u64(sensor.seed);
    rng.set_stream(scan);
    let noise = Normal::new(0.0, finite(sensor.sigma_m)).ok();
    let noise = |rng: &mut ChaCha8Rng| noise.as_ref().map_or(0.0, |n| n.sample(rng));
    let mut items = Vec::new();
    for object in objects {
        // Drawn for every object, so that one out of range changes nothing for the others.
        let seen = rng.random::<f64>() < sensor.probability;
        let error = [noise(&mut rng), noise(&mut rng)];
        let Rectangle { center, heading, length, width } = object.shape;
        if seen && distance(center, cav) <= sensor.range_m {
            let [x, y] = add(center, error);
            let [cos, sin] = direction(heading);
            items.push(Detection { x, y, cos, sin, length, width });
        }
    }
    let rate = finite(sensor.clutter).min(CLUTTER_MAX);
    let clutter = Poisson::new(rate).map_or(0.0, |p| p.sample(&mut rng).min(4.0 * CLUTTER_MAX));
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "0 to 1024")]
    for _ in 0..clutter as u32 {
        let far = NEAREST.max(finite(sensor.range_m) * rng.random::<f64>().sqrt());
        let [x, y] = add(cav, scale(direction(rng.random::<f64>() * std::f64::consts::TAU), far));
        let (length, width) = (CLUTTER_SIZE, CLUTTER_SIZE);
        items.push(Detection { x, y, cos: 1.0, sin: 0.0, length, width });
    }
    DetectionList { stamp_ns, items }
}

fn finite(x: f64) -> f64 {
    if x.is_finite() { x.max(0.0) } else { 0.0 }
}

/// The grid map at a pose of the CAV: a cell is occupied exactly when it and the rectangle of
/// some object share area. A size outside the domain gives a grid that is empty of bits; the
/// monitor then names the field.
pub(crate) fn grid(
    size: GridSize,
    stamp_ns: i64,
    cav: Point,
    heading: f64,
    objects: &[Seen],
) -> Grid {
    let [cos, sin] = direction(heading);
    let (w, h) = (i64::from(size.width), i64::from(size.height));
    let extent = [f64::from(size.width), f64::from(size.height)].map(|n| n * size.resolution_m);
    let corner = [extent[0] / -3.0, extent[1] / -2.0];
    let [x, y] = add(cav, turn(corner, [cos, sin]));
    let cells = usize::try_from(w * h).unwrap_or(0);
    let valid = size.width <= 1 << 15 && size.height <= 1 << 15 && cells <= 1 << 24;
    let mut occupied = vec![0; if valid { cells.div_ceil(8) } else { 0 }];
    if valid && size.resolution_m > 0.0 {
        for object in objects {
            let center = turn(sub(object.shape.center, [x, y]), [cos, -sin]);
            let shape =
                Rectangle { center, heading: object.shape.heading - heading, ..object.shape };
            fill(&mut occupied, size, &shape);
        }
    }
    let resolution = size.resolution_m;
    Grid { stamp_ns, x, y, cos, sin, resolution, width: w, height: h, occupied, unknown: None }
}

/// The vector turned by the direction.
fn turn(p: Point, [c, s]: Point) -> Point {
    [p[0] * c - p[1] * s, p[0] * s + p[1] * c]
}

/// Marks the cells that share area with a rectangle of the grid's frame.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "columns and rows are clamped to the grid before"
)]
fn fill(occupied: &mut [u8], size: GridSize, shape: &Rectangle) {
    let cell = size.resolution_m;
    let bounds = Rectangle::around(&shape.corners(), 0.0);
    let range = |center: f64, length: f64, n: u32| {
        let n = f64::from(n);
        let low = ((center - length / 2.0) / cell).floor().clamp(0.0, n) as usize;
        let high = ((center + length / 2.0) / cell).ceil().clamp(0.0, n) as usize;
        low..high
    };
    let axes = [direction(shape.heading), direction(shape.heading + std::f64::consts::FRAC_PI_2)];
    let half = [shape.length / 2.0, shape.width / 2.0];
    for row in range(bounds.center[1], bounds.width, size.height) {
        for column in range(bounds.center[0], bounds.length, size.width) {
            #[expect(clippy::cast_precision_loss, reason = "below 2^15")]
            let middle = [(column as f64 + 0.5) * cell, (row as f64 + 0.5) * cell];
            let off = sub(middle, shape.center);
            // The axes of the grid are covered by the range of rows and columns.
            let apart = axes.iter().zip(half).any(|(axis, half)| {
                let reach = half + cell / 2.0 * (axis[0].abs() + axis[1].abs());
                dot(off, *axis).abs() >= reach
            });
            if !apart {
                let bit = row * size.width as usize + column;
                occupied[bit / 8] |= 1 << (bit % 8);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn car(x: f64, y: f64, heading: f64) -> Seen {
        let shape = Rectangle { center: [x, y], heading, length: 4.0, width: 2.0 };
        Seen { id: 1, shape, velocity: [0.0, 0.0] }
    }

    #[test]
    fn equal_seeds_give_equal_scans_and_others_differ() {
        let sensor = Sensor { clutter: 3.0, ..Sensor::default() };
        let objects = [car(10.0, 0.0, 0.0), car(79.0, 0.0, 0.0), car(90.0, 0.0, 0.0)];
        let first = scan(&sensor, 1, 0, [0.0, 0.0], &objects);
        assert_eq!(first, scan(&sensor, 1, 0, [0.0, 0.0], &objects));
        assert_ne!(first, scan(&sensor, 2, 0, [0.0, 0.0], &objects));
        let other = Sensor { seed: 2, ..sensor };
        assert_ne!(first, scan(&other, 1, 0, [0.0, 0.0], &objects));
        let near = first.items.iter().filter(|d| (d.x - 10.0).abs() < 0.5 && d.length > 1.0);
        assert_eq!(near.count(), 1);
        assert!(first.items.iter().all(|d| d.x.hypot(d.y) < 80.5));
    }

    #[test]
    fn a_blind_sensor_sees_clutter_only() {
        let sensor = Sensor { probability: 0.0, clutter: 0.0, ..Sensor::default() };
        assert!(scan(&sensor, 0, 0, [0.0, 0.0], &[car(10.0, 0.0, 0.0)]).items.is_empty());
        let odd = Sensor { sigma_m: f64::NAN, clutter: f64::INFINITY, ..Sensor::default() };
        let found = scan(&odd, 0, 0, [0.0, 0.0], &[car(10.0, 0.0, 0.0)]);
        assert!((found.items[0].x - 10.0).abs() < 1e-12);
    }

    #[test]
    fn the_grid_marks_the_cells_that_share_area_with_a_rectangle() {
        let size = GridSize { resolution_m: 1.0, width: 30, height: 20 };
        let bits = |heading: f64, car: Seen| {
            let grid = grid(size, 0, [0.0, 0.0], heading, &[car]);
            let mut cells = Vec::new();
            for row in 0..20usize {
                for column in 0..30usize {
                    let bit = row * 30 + column;
                    if grid.occupied[bit / 8] >> (bit % 8) & 1 == 1 {
                        cells.push((column, row));
                    }
                }
            }
            cells
        };
        // Origin (-10, -10): the car from (3, 4) to (7, 6) is columns 13 to 16, rows 14 and 15.
        let expected: Vec<_> = (14..16).flat_map(|r| (13..17).map(move |c| (c, r))).collect();
        assert_eq!(bits(0.0, car(5.0, 5.0, 0.0)), expected);
        // The same in a frame turned by a right angle, with the car turned and moved with it.
        let turned = std::f64::consts::FRAC_PI_2;
        let around = bits(turned, car(-5.01, 4.99, turned));
        assert!(expected.iter().all(|cell| around.contains(cell)), "{around:?}");
        // A diamond marks fewer cells than the square around it.
        let diamond = bits(0.0, car(5.0, 5.0, 0.8));
        assert!(diamond.contains(&(15, 15)) && !diamond.contains(&(13, 16)), "{diamond:?}");
        assert!(bits(0.0, car(500.0, 5.0, 0.0)).is_empty());
    }
}
