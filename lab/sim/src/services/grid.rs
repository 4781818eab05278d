//! The occupancy grid map around a vehicle, from the rays of its lidar.
//!
//! A stand-in for the paper's grid mapping: log-odds of cells in a square that moves with the vehicle. It
//! cannot show dynamic grids (a moving object leaves a trail of two cycles), heights, or cells that are
//! wrong because the pose is.

use mufasa::input::cycle::{Ego, Grid};

use crate::pose::{Point, Pose};
use crate::services::detectors::scan::{Return, Scan};

/// Side of a cell, m.
const RESOLUTION: f64 = 0.5;
/// Cells a side: 60 m by 60 m.
const CELLS: usize = 120;
/// Every so many rays clear what they cross; all of them mark what they meet.
const CLEARING: usize = 2;
// Log-odds are in hundredths: a cell is occupied after one hit and free two cycles after the last.
/// Added to a cell that a ray ends in.
const HIT: i16 = 120;
/// Taken from a cell that rays only cross.
const FREE: i16 = 80;
/// Greatest log-odds of either sign.
const MOST: i16 = 200;
/// Above this a cell is occupied.
const OCCUPIED: i16 = 50;
/// Up to this, of either sign, a cell is unknown.
const UNKNOWN: i16 = 20;

/// A map that moves with its vehicle, aligned with the axes of the plane.
#[derive(Clone, Debug)]
pub struct OccupancyMap {
    /// Column and row of the first cell, counted from the origin of the plane.
    first: [i64; 2],
    /// Row after row.
    log_odds: Vec<i16>,
    /// What the rays of a scan do with each cell.
    observed: Vec<Observed>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Observed {
    Nothing,
    Free,
    Hit,
}

/// A grid as a cycle takes it.
#[derive(Clone, Debug, PartialEq)]
pub struct OwnedGrid {
    stamp_ns: i64,
    corner: Point,
    occupied: Vec<u8>,
    unknown: Vec<u8>,
}

impl OwnedGrid {
    /// As the record of a cycle; without the unknown cells they are free.
    pub fn borrow(&self, with_unknown: bool) -> Grid<'_> {
        Grid {
            stamp_ns: self.stamp_ns,
            x: self.corner.x,
            y: self.corner.y,
            cos: 1.0,
            sin: 0.0,
            resolution: RESOLUTION,
            width: index(CELLS),
            height: index(CELLS),
            occupied: &self.occupied,
            unknown: with_unknown.then_some(&self.unknown),
        }
    }
}

impl Default for OccupancyMap {
    /// A map that knows nothing.
    fn default() -> Self {
        let observed = vec![Observed::Nothing; CELLS * CELLS];
        Self { first: [0, 0], log_odds: vec![0; CELLS * CELLS], observed }
    }
}

impl OccupancyMap {
    /// Takes in a scan from on top of the vehicle, and gives the map of that time, ns. The vehicle's own
    /// rectangle is free.
    pub fn update(&mut self, stamp_ns: i64, ego: &Ego, scan: &Scan) -> OwnedGrid {
        let pose = Pose { at: Point::new(ego.x, ego.y), cos: ego.cos, sin: ego.sin };
        let middle = pose.ahead(ego.center_offset, 0.0);
        self.move_to(middle);
        self.observed.fill(Observed::Nothing);
        for (index, ray) in scan.rays.iter().enumerate() {
            if index % CLEARING == 0 {
                self.clear(scan.pose.at, ray);
            }
        }
        for ray in scan.rays.iter().filter(|ray| ray.met.is_some()) {
            // A little into what it met, so that noise does not put its edge into the cell before it.
            let distance = ray.distance + RESOLUTION / 8.0;
            let place = Point::new(
                scan.pose.at.x + distance * ray.cos,
                scan.pose.at.y + distance * ray.sin,
            );
            if let Some(cell) = self.at([column(place.x), column(place.y)]) {
                self.observed[cell] = Observed::Hit;
            }
        }
        self.learn();
        self.free_footprint(Pose { at: middle, ..pose }, ego);
        self.bitmaps(stamp_ns)
    }

    /// Moves the square so that a place is in its middle; cells keep what they know of their place.
    fn move_to(&mut self, middle: Point) {
        let (cells, half) = (CELLS, index(CELLS / 2));
        let first = [column(middle.x) - half, column(middle.y) - half];
        let moved = [first[0] - self.first[0], first[1] - self.first[1]];
        if moved == [0, 0] {
            return;
        }
        let mut log_odds = vec![0; cells * cells];
        for row in 0..cells {
            let Some(old_row) = within(index(row) + moved[1], cells) else { continue };
            // The columns that were there before.
            let from = within(moved[0], cells).unwrap_or(0);
            let to = within(-moved[0], cells).unwrap_or(0);
            let count = cells.saturating_sub(from.max(to));
            if moved[0].unsigned_abs() >= index(cells).unsigned_abs() {
                continue;
            }
            let source = &self.log_odds[old_row * cells + from..][..count];
            log_odds[row * cells + to..][..count].copy_from_slice(source);
        }
        (self.first, self.log_odds) = (first, log_odds);
    }

    /// Marks the cells that a ray crosses as free (Amanatides and Woo 1987).
    fn clear(&mut self, from: Point, ray: &Return) {
        let mut at = [column(from.x), column(from.y)];
        let axis = |from: f64, direction: f64, at: i64| {
            // Distance along the ray to the next border of a cell, and between two borders.
            let Some(per_metre) = (direction.abs() > 1e-9).then(|| 1.0 / direction.abs()) else {
                return (0, f64::INFINITY, f64::INFINITY);
            };
            let into = from / RESOLUTION - real(at);
            let rest = if direction > 0.0 { 1.0 - into } else { into };
            let sign = if direction > 0.0 { 1 } else { -1 };
            (sign, rest * RESOLUTION * per_metre, RESOLUTION * per_metre)
        };
        let (step_x, mut next_x, between_x) = axis(from.x, ray.cos, at[0]);
        let (step_y, mut next_y, between_y) = axis(from.y, ray.sin, at[1]);
        // By index: this is most of the work of a map.
        let (cells, Some(mut cell)) = (index(CELLS), self.at(at)) else { return };
        let row_of = if step_y > 0 { CELLS.cast_signed() } else { -CELLS.cast_signed() };
        (at[0], at[1]) = (at[0] - self.first[0], at[1] - self.first[1]);
        loop {
            self.observed[cell] = Observed::Free;
            if next_x.min(next_y) >= ray.distance {
                return;
            }
            if next_x < next_y {
                (at[0], next_x) = (at[0] + step_x, next_x + between_x);
                cell = cell.wrapping_add_signed(if step_x > 0 { 1 } else { -1 });
            } else {
                (at[1], next_y) = (at[1] + step_y, next_y + between_y);
                cell = cell.wrapping_add_signed(row_of);
            }
            if !(0..cells).contains(&at[0]) || !(0..cells).contains(&at[1]) {
                return;
            }
        }
    }

    /// Old knowledge fades, so that what is behind a passing car becomes unknown, and the scan is added.
    fn learn(&mut self) {
        for (log_odds, observed) in self.log_odds.iter_mut().zip(&self.observed) {
            let faded = *log_odds - (*log_odds >> 4);
            let learnt = match observed {
                Observed::Nothing => faded,
                Observed::Free => faded - FREE,
                Observed::Hit => faded + HIT,
            };
            *log_odds = learnt.clamp(-MOST, MOST);
        }
    }

    fn free_footprint(&mut self, middle: Pose, ego: &Ego) {
        let radius = 0.5 * Point::default().distance(Point::new(ego.length, ego.width));
        let low = [middle.at.x - radius, middle.at.y - radius].map(column);
        let high = [middle.at.x + radius, middle.at.y + radius].map(column);
        for row in low[1]..=high[1] {
            for column in low[0]..=high[0] {
                let [x, y] = [column, row].map(|it| (real(it) + 0.5) * RESOLUTION);
                let place = Point::new(x, y);
                let (ahead, left) = middle.local(place);
                let inside = ahead.abs() <= ego.length / 2.0 && left.abs() <= ego.width / 2.0;
                if let (true, Some(cell)) = (inside, self.at([column, row])) {
                    self.log_odds[cell] = -MOST;
                }
            }
        }
    }

    fn bitmaps(&self, stamp_ns: i64) -> OwnedGrid {
        let [x, y] = self.first.map(|it| real(it) * RESOLUTION);
        OwnedGrid {
            stamp_ns,
            corner: Point::new(x, y),
            occupied: self.packed(|cell| cell > OCCUPIED),
            unknown: self.packed(|cell| cell.abs() <= UNKNOWN),
        }
    }

    /// One bit for each cell.
    fn packed(&self, is: impl Fn(i16) -> bool) -> Vec<u8> {
        let byte = |cells: &[i16]| {
            (0..).zip(cells).fold(0, |byte, (bit, &cell)| byte | u8::from(is(cell)) << bit)
        };
        self.log_odds.chunks(8).map(byte).collect()
    }

    fn at(&self, [column, row]: [i64; 2]) -> Option<usize> {
        let column = within(column - self.first[0], CELLS)?;
        Some(within(row - self.first[1], CELLS)? * CELLS + column)
    }
}

/// Column of an x coordinate, or row of a y coordinate.
#[allow(clippy::cast_possible_truncation)] // places are within 2^24 m
fn column(place: f64) -> i64 {
    (place / RESOLUTION).floor() as i64
}

fn within(index: i64, cells: usize) -> Option<usize> {
    usize::try_from(index).ok().filter(|&index| index < cells)
}

fn index(cells: usize) -> i64 {
    i64::try_from(cells).unwrap_or(i64::MAX)
}

#[allow(clippy::cast_precision_loss)] // places are within 2^24 m
fn real(column: i64) -> f64 {
    column as f64
}
