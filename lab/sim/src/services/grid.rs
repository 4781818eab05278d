//! The occupancy grid map around a vehicle, from the rays of its lidar.
//!
//! A stand-in for the paper's grid mapping: log-odds of cells in a square that moves with the vehicle. It
//! cannot show dynamic grids (a moving object leaves a trail of two cycles), heights, or cells that are
//! wrong because the pose is.

use mufasa::input::cycle::{Ego, Grid};

use crate::pose::{Point, Pose};
use crate::services::detectors::scan::{Met, Return, Scan};

/// Size of a grid and how fast it learns. Log-odds are in hundredths.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// Side of a cell, m.
    pub resolution: f64,
    /// Cells a side.
    pub cells: usize,
    /// Every so many rays clear what they cross; all of them mark what they meet.
    pub clearing: usize,
    /// Added to a cell that a ray ends in.
    pub hit: i16,
    /// Taken from a cell that rays only cross.
    pub free: i16,
    /// Greatest log-odds of either sign.
    pub most: i16,
    /// Above this a cell is occupied.
    pub occupied: i16,
    /// Up to this, of either sign, a cell is unknown.
    pub unknown: i16,
}

impl Default for Settings {
    /// 60 m by 60 m; a cell is occupied after one hit and free two cycles after the last.
    fn default() -> Self {
        Self {
            resolution: 0.5,
            cells: 120,
            clearing: 2,
            hit: 120,
            free: 80,
            most: 200,
            occupied: 50,
            unknown: 20,
        }
    }
}

/// A map that moves with its vehicle, aligned with the axes of the plane.
#[derive(Clone, Debug)]
pub struct OccupancyMap {
    settings: Settings,
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
    resolution: f64,
    cells: i64,
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
            resolution: self.resolution,
            width: self.cells,
            height: self.cells,
            occupied: &self.occupied,
            unknown: with_unknown.then_some(&self.unknown),
        }
    }
}

impl OccupancyMap {
    /// A map that knows nothing.
    pub fn new(settings: Settings) -> Self {
        let count = settings.cells * settings.cells;
        Self {
            settings,
            first: [0, 0],
            log_odds: vec![0; count],
            observed: vec![Observed::Nothing; count],
        }
    }

    /// Takes in a scan from on top of the vehicle, and gives the map of that time, ns. The vehicle's own
    /// rectangle is free.
    pub fn update(&mut self, stamp_ns: i64, ego: &Ego, scan: &Scan) -> OwnedGrid {
        let pose = Pose { at: Point::new(ego.x, ego.y), cos: ego.cos, sin: ego.sin };
        let middle = pose.ahead(ego.center_offset, 0.0);
        self.move_to(middle);
        self.observed.fill(Observed::Nothing);
        for (index, ray) in scan.rays.iter().enumerate() {
            if index % self.settings.clearing == 0 {
                self.clear(scan.pose.at, ray);
            }
        }
        for ray in scan.rays.iter().filter(|ray| ray.met != Met::Nothing) {
            // A little into what it met, so that noise does not put its edge into the cell before it.
            let distance = ray.distance + self.settings.resolution / 8.0;
            let place = Point::new(
                scan.pose.at.x + distance * ray.cos,
                scan.pose.at.y + distance * ray.sin,
            );
            if let Some(cell) = self.cell(place) {
                self.observed[cell] = Observed::Hit;
            }
        }
        self.learn();
        self.free_footprint(Pose { at: middle, ..pose }, ego);
        self.bitmaps(stamp_ns)
    }

    /// Moves the square so that a place is in its middle; cells keep what they know of their place.
    fn move_to(&mut self, middle: Point) {
        let (cells, half) = (self.settings.cells, index(self.settings.cells / 2));
        let first = [self.column(middle.x) - half, self.column(middle.y) - half];
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
        let resolution = self.settings.resolution;
        let mut at = [self.column(from.x), self.column(from.y)];
        let axis = |from: f64, direction: f64, at: i64| {
            // Distance along the ray to the next border of a cell, and between two borders.
            let Some(per_metre) = (direction.abs() > 1e-9).then(|| 1.0 / direction.abs()) else {
                return (0, f64::INFINITY, f64::INFINITY);
            };
            let into = from / resolution - real(at);
            let rest = if direction > 0.0 { 1.0 - into } else { into };
            let sign = if direction > 0.0 { 1 } else { -1 };
            (sign, rest * resolution * per_metre, resolution * per_metre)
        };
        let (step_x, mut next_x, between_x) = axis(from.x, ray.cos, at[0]);
        let (step_y, mut next_y, between_y) = axis(from.y, ray.sin, at[1]);
        // By index: this is most of the work of a map.
        let (cells, Some(mut cell)) = (index(self.settings.cells), self.at(at)) else { return };
        let row_of = if step_y > 0 {
            self.settings.cells.cast_signed()
        } else {
            -self.settings.cells.cast_signed()
        };
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
        let Settings { hit, free, most, .. } = self.settings;
        for (log_odds, observed) in self.log_odds.iter_mut().zip(&self.observed) {
            let faded = *log_odds - (*log_odds >> 4);
            let learnt = match observed {
                Observed::Nothing => faded,
                Observed::Free => faded - free,
                Observed::Hit => faded + hit,
            };
            *log_odds = learnt.clamp(-most, most);
        }
    }

    fn free_footprint(&mut self, middle: Pose, ego: &Ego) {
        let resolution = self.settings.resolution;
        let radius = 0.5 * Point::default().distance(Point::new(ego.length, ego.width));
        let low = [middle.at.x - radius, middle.at.y - radius].map(|place| self.column(place));
        let high = [middle.at.x + radius, middle.at.y + radius].map(|place| self.column(place));
        for row in low[1]..=high[1] {
            for column in low[0]..=high[0] {
                let place =
                    Point::new((real(column) + 0.5) * resolution, (real(row) + 0.5) * resolution);
                let (ahead, left) = middle.local(place);
                let inside = ahead.abs() <= ego.length / 2.0 && left.abs() <= ego.width / 2.0;
                if let (true, Some(cell)) = (inside, self.at([column, row])) {
                    self.log_odds[cell] = -self.settings.most;
                }
            }
        }
    }

    fn bitmaps(&self, stamp_ns: i64) -> OwnedGrid {
        let Settings { resolution, cells, occupied, unknown, .. } = self.settings;
        let [column, row] = self.first;
        OwnedGrid {
            stamp_ns,
            corner: Point::new(real(column) * resolution, real(row) * resolution),
            resolution,
            cells: index(cells),
            occupied: self.packed(|cell| cell > occupied),
            unknown: self.packed(|cell| cell.abs() <= unknown),
        }
    }

    /// One bit for each cell.
    fn packed(&self, is: impl Fn(i16) -> bool) -> Vec<u8> {
        let byte = |cells: &[i16]| {
            (0..).zip(cells).fold(0, |byte, (bit, &cell)| byte | u8::from(is(cell)) << bit)
        };
        self.log_odds.chunks(8).map(byte).collect()
    }

    /// Column of an x coordinate, or row of a y coordinate.
    #[allow(clippy::cast_possible_truncation)] // places are within 2^24 m
    fn column(&self, place: f64) -> i64 {
        (place / self.settings.resolution).floor() as i64
    }

    fn cell(&self, place: Point) -> Option<usize> {
        self.at([self.column(place.x), self.column(place.y)])
    }

    fn at(&self, [column, row]: [i64; 2]) -> Option<usize> {
        let cells = self.settings.cells;
        let column = within(column - self.first[0], cells)?;
        let row = within(row - self.first[1], cells)?;
        Some(row * cells + column)
    }
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
