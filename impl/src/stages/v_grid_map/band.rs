//! Stage v decided for many trajectory points at once: a turned rectangle that contains all their
//! disks, or all of the CAV's rectangles, and by so much more that a cell whose centre is outside marks no
//! place of theirs and shares no point with them. When no cell in it is set, none of these points collides;
//! else half of the points are tried.
//!
//! Plain doubles: within the grid coordinates are below 2^21 cells, and each is rounded less than
//! 16 times; `MARGIN` is more than that. Farther off, errors stay below 2^-14 cells up to the
//! limits of the domain, 2^33 cells.

use crate::input::cycle::{Cycle, Grid, TrajectoryPoint};
use crate::numbers::range::{EMPTY, extend, float, integer, larger, smaller};
use crate::stages::v_grid_map::bitmap::Bitmap;

/// In cells.
const MARGIN: f64 = 1e-3;

/// The frame of the grid in cells, with the disks or the CAV's rectangle at a pose.
#[derive(Clone, Copy, Debug)]
pub(crate) struct CellFrame {
    origin: [f64; 2],
    /// (cos, sin) / (cos^2 + sin^2) / resolution.
    axis: [f64; 2],
    /// From a pose to the centres of the last and of the first disk, or to the rear and the front, m.
    ends: [f64; 2],
    /// Half the width of a rectangle, 0 for disks, m.
    beside: f64,
    /// As far as a disk reaches: its radius (0 for a rectangle) and half the diagonal of a cell.
    reach: f64,
}

impl CellFrame {
    /// With the radius of S5-02.
    pub(crate) fn new(cycle: &Cycle<'_>, grid: &Grid<'_>) -> Self {
        let ego = &cycle.ego;
        let disks = f64::from(i32::try_from(cycle.parameters.n).unwrap_or(i32::MAX));
        let part = ego.length / disks;
        let radius = 0.5 * libm::sqrt(part * part + ego.width * ego.width);
        let scale = 1.0 / ((grid.cos * grid.cos + grid.sin * grid.sin) * grid.resolution);
        let half = 0.5 * (ego.length - part);
        Self {
            origin: [grid.x, grid.y],
            axis: [grid.cos * scale, grid.sin * scale],
            ends: [ego.center_offset - half, ego.center_offset + half],
            beside: 0.0,
            reach: radius / grid.resolution + core::f64::consts::FRAC_1_SQRT_2 + MARGIN,
        }
    }

    /// With the CAV's rectangle, which in this frame is as wide as on the ground: both are given by
    /// directions that are not normalised.
    pub(crate) fn with_rectangle(cycle: &Cycle<'_>, grid: &Grid<'_>) -> Self {
        let ego = &cycle.ego;
        let half = 0.5 * ego.length;
        Self {
            ends: [ego.center_offset - half, ego.center_offset + half],
            beside: 0.5 * ego.width,
            reach: core::f64::consts::FRAC_1_SQRT_2 + MARGIN,
            ..Self::new(cycle, grid)
        }
    }

    /// From the middle of an end to its corner on the left, in cells.
    fn aside(&self, point: &TrajectoryPoint) -> [f64; 2] {
        let (x, y) = (-self.beside * point.sin, self.beside * point.cos);
        let [cos, sin] = self.axis;
        [x * cos + y * sin, y * cos - x * sin]
    }

    /// The centres of the last and of the first disk, or of rear and front, in cells.
    fn centres(&self, point: &TrajectoryPoint) -> [[f64; 2]; 2] {
        let ([gx, gy], [cos, sin]) = (self.origin, self.axis);
        self.ends.map(|along| {
            let (x, y) = (point.x + along * point.cos - gx, point.y + along * point.sin - gy);
            [x * cos + y * sin, y * cos - x * sin]
        })
    }
}

/// A turned rectangle around all disks, or all rectangles, at some points.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Band {
    origin: [f64; 2],
    along: [f64; 2],
    /// The ranges along the band and across it, from the origin.
    ranges: [[f64; 2]; 2],
    /// The same for columns and rows, from the corner of the grid.
    upright: [[f64; 2]; 2],
}

impl Band {
    pub(crate) fn new(
        frame: &CellFrame,
        points: impl Iterator<Item = TrajectoryPoint> + Clone,
    ) -> Self {
        let origin = points.clone().next().map_or([0.0; 2], |point| frame.centres(&point)[0]);
        let [x, y] = points.clone().last().map_or(origin, |point| frame.centres(&point)[1]);
        let (dx, dy) = (x - origin[0], y - origin[1]);
        let length = libm::sqrt(dx * dx + dy * dy);
        let along = if length > 1e-3 { [dx / length, dy / length] } else { [1.0, 0.0] };
        let (mut ranges, mut upright) = ([EMPTY; 2], [EMPTY; 2]);
        let turn = |[x, y]: [f64; 2]| [x * along[0] + y * along[1], y * along[0] - x * along[1]];
        for point in points {
            let aside = if frame.beside > 0.0 { frame.aside(&point) } else { [0.0; 2] };
            for [x, y] in frame.centres(&point) {
                let turned = turn([x - origin[0], y - origin[1]]);
                extend(&mut ranges, turned, turn(aside).map(f64::abs));
                extend(&mut upright, [x, y], aside.map(f64::abs));
            }
        }
        let widen = |[least, most]: [f64; 2]| [least - frame.reach, most + frame.reach];
        Self { origin, along, ranges: ranges.map(widen), upright: upright.map(widen) }
    }

    /// Whether it lies within so many columns and rows.
    pub(crate) fn is_within(&self, width: i64, height: i64) -> bool {
        let [[left, right], [bottom, top]] = self.upright;
        left > 0.0 && bottom > 0.0 && right < float(width) && top < float(height)
    }

    /// Whether no cell in it is set; cells outside the bitmap are not.
    pub(crate) fn is_free(&self, cells: &Bitmap<'_>) -> bool {
        self.is_free_but(cells, |_, _| false)
    }

    /// As `is_free`, but for cells that are left out.
    pub(crate) fn is_free_but(
        &self,
        cells: &Bitmap<'_>,
        mut left_out: impl FnMut(i64, i64) -> bool,
    ) -> bool {
        let [[left, right], [bottom, top]] = self.upright;
        let ([x, y], [cos, sin]) = (self.origin, self.along);
        let [[back, front], [aside, beside]] = self.ranges;
        // back <= dx cos + dy sin <= front, and aside <= dy cos - dx sin <= beside
        let strips = [Strip::new(cos, sin, back, front), Strip::new(-sin, cos, aside, beside)];
        let (width, height) = (float(cells.width), float(cells.height));
        if right < 0.0 || top < 0.0 || left > width || bottom > height {
            return true;
        }
        // The rows whose centres are between.
        let rows = integer(larger(bottom, 0.0))..integer(smaller(top, height));
        rows.into_iter().all(|row| {
            let dy = float(row) + 0.5 - y;
            let (mut from, mut to) = (left, right);
            for strip in &strips {
                let shift = x + strip.gradient * dy;
                from = larger(from, strip.least + shift);
                to = smaller(to, strip.most + shift);
            }
            if from > to || to < 0.0 {
                return true;
            }
            // At least the columns whose centres are between.
            let (from, to) = (larger(from, 1.0) - 1.0, smaller(to, width));
            let (from, to) = (integer(from), integer(to));
            cells.row_is_free(row, from, to)
                || cells.set_in_row(row, from, to).all(|column| left_out(column, row))
        })
    }
}

/// The dx with least <= dx - gradient dy <= most.
struct Strip {
    gradient: f64,
    least: f64,
    most: f64,
}

impl Strip {
    /// least <= a dx + b dy <= most; when a is almost 0, any dx.
    ///
    /// A small `a` makes everything here large, and rounding with it: the least and the most dx, and
    /// the gradient times dy, are at most 2^34 / a in size up to the limits of the domain, so that a
    /// few roundings add up to less than 2^-15 / a. But the range from `least` to `most` is wider by
    /// `MARGIN` at either end than what it has to contain (see `CellFrame::reach`), which is
    /// `MARGIN` / a of dx, and more than that.
    fn new(a: f64, b: f64, least: f64, most: f64) -> Self {
        if a.abs() < 1e-6 {
            return Self { gradient: 0.0, least: f64::MIN, most: f64::MAX };
        }
        let (least, most) = (least / a, most / a);
        let (least, most) = (smaller(least, most) - MARGIN, larger(least, most) + MARGIN);
        Self { gradient: -b / a, least, most }
    }
}

#[cfg(test)]
mod tests;
