//! From metres on the map to px on the page.

use mufasa_model::input::cycle::{Cycle, Ego};

/// Width of a picture, px.
pub const PAGE_WIDTH: f64 = 1200.0;
/// Left and right border, px.
pub const MARGIN: f64 = 20.0;
/// Height of the title above the map, px.
pub const TITLE_HEIGHT: f64 = 78.0;

/// Largest and smallest height of the map, px.
const MAP_HEIGHT: [f64; 2] = [280.0, 700.0];
/// Room around what must be seen, m.
const PADDING: f64 = 4.0;
/// Smallest size of the window along and across the driving direction, m.
const LEAST: [f64; 2] = [36.0, 14.0];
/// Largest size of the window along and across the driving direction, m: beyond it a car is
/// too small to be seen.
const MOST: [f64; 2] = [150.0, 85.0];

/// A place on the map with a direction, and the size of the rectangle around it.
#[derive(Clone, Copy, Debug)]
pub struct Rectangle {
    /// Centre, m.
    pub centre: [f64; 2],
    /// Direction (cos, sin).
    pub direction: [f64; 2],
    /// Length and width, m.
    pub size: [f64; 2],
}

impl Rectangle {
    /// The CAV's rectangle when its reference point is at `position`.
    pub fn of_ego(ego: &Ego, position: [f64; 2], direction: [f64; 2]) -> Self {
        let [x, y] = position;
        let [cos, sin] = direction;
        let centre = [x + ego.center_offset * cos, y + ego.center_offset * sin];
        Self { centre, direction, size: [ego.length, ego.width] }
    }

    /// Corners in turn, m.
    pub fn corners(&self) -> [[f64; 2]; 4] {
        let [length, width] = self.size;
        [(0.5, 0.5), (0.5, -0.5), (-0.5, -0.5), (-0.5, 0.5)]
            .map(|(along, across)| self.point([along * length, across * width]))
    }

    /// The point (a, b) of the rectangle's frame, m.
    pub fn point(&self, [a, b]: [f64; 2]) -> [f64; 2] {
        let ([x, y], [cos, sin]) = (self.centre, self.direction);
        [x + a * cos - b * sin, y + a * sin + b * cos]
    }
}

/// The part of the map that a picture shows, and where it is on the page.
pub struct Frame {
    origin: [f64; 2],
    direction: [f64; 2],
    /// Upper left corner of the window: along the direction, to the left of it; m.
    corner: [f64; 2],
    /// px per m.
    pub scale: f64,
    /// The window on the page: its upper left corner and its size, px.
    pub place: [f64; 2],
    /// See `place`.
    pub size: [f64; 2],
}

impl Frame {
    /// A window of the map as maps are drawn, north up: its middle and its size, m, px per m, and its upper left
    /// corner on the page, px.
    pub fn north_up(middle: [f64; 2], size: [f64; 2], scale: f64, place: [f64; 2]) -> Self {
        let corner = [-size[0] / 2.0, size[1] / 2.0];
        let size = size.map(|it| it * scale);
        Self { origin: middle, direction: [1.0, 0.0], corner, scale, place, size }
    }

    /// The smallest sensible window around the CAV, which drives to the right, that holds the `musts`, and of the
    /// `wishes` those that are near.
    pub fn new(cycle: &Cycle, musts: &[[f64; 2]], wishes: &[[f64; 2]]) -> Self {
        let (origin, direction) = pose(cycle);
        let mut low: [f64; 2] = [-6.0, -5.0];
        let mut high: [f64; 2] = [10.0, 5.0];
        let along = |p: [f64; 2]| turn(p, origin, direction).filter(|p| p[0].hypot(p[1]) < 400.0);
        for point in musts.iter().filter_map(|p| along(*p)) {
            for axis in 0..2 {
                low[axis] = low[axis].min(point[axis]);
                high[axis] = high[axis].max(point[axis]);
            }
        }
        let near = |p: &[f64; 2]| {
            (0..2).all(|axis| p[axis] > low[axis] - 15.0 && p[axis] < high[axis] + 15.0)
        };
        let wished: Vec<_> = wishes.iter().filter_map(|p| along(*p)).filter(near).collect();
        for point in wished {
            for axis in 0..2 {
                low[axis] = low[axis].min(point[axis]);
                high[axis] = high[axis].max(point[axis]);
            }
        }
        for axis in 0..2 {
            let size = (high[axis] - low[axis] + 2.0 * PADDING).clamp(LEAST[axis], MOST[axis]);
            // When the window is cut, the CAV stays in it.
            let middle = f64::midpoint(low[axis], high[axis])
                .clamp(-size / 2.0 + PADDING, size / 2.0 - PADDING);
            (low[axis], high[axis]) = (middle - size / 2.0, middle + size / 2.0);
        }
        Self::fit(origin, direction, low, high)
    }

    fn fit(origin: [f64; 2], direction: [f64; 2], low: [f64; 2], high: [f64; 2]) -> Self {
        let width = PAGE_WIDTH - 2.0 * MARGIN;
        let size = [high[0] - low[0], high[1] - low[1]];
        let scale = (width / size[0]).min(MAP_HEIGHT[1] / size[1]);
        let height = (size[1] * scale).max(MAP_HEIGHT[0]);
        let middle = [f64::midpoint(low[0], high[0]), f64::midpoint(low[1], high[1])];
        let corner = [middle[0] - width / scale / 2.0, middle[1] + height / scale / 2.0];
        let (place, size) = ([MARGIN, TITLE_HEIGHT], [width, height]);
        Self { origin, direction, corner, scale, place, size }
    }

    /// Where a place of the map is on the page, px; `None` when it is too far to be drawn.
    pub fn at(&self, place: [f64; 2]) -> Option<[f64; 2]> {
        let [along, left] = turn(place, self.origin, self.direction)?;
        let x = self.place[0] + (along - self.corner[0]) * self.scale;
        let y = self.place[1] + (self.corner[1] - left) * self.scale;
        (x.abs() < 1e5 && y.abs() < 1e5).then_some([x, y])
    }

    /// The place of the map at a point of the page.
    pub fn place_at(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let along = (x - self.place[0]) / self.scale + self.corner[0];
        let left = self.corner[1] - (y - self.place[1]) / self.scale;
        let [cos, sin] = self.direction;
        [self.origin[0] + along * cos - left * sin, self.origin[1] + along * sin + left * cos]
    }

    /// Where a place is on the page, if it is inside the window.
    pub fn seen(&self, place: [f64; 2]) -> Option<[f64; 2]> {
        let inside = |at: [f64; 2], axis: usize| {
            (self.place[axis]..=self.place[axis] + self.size[axis]).contains(&at[axis])
        };
        self.at(place).filter(|at| inside(*at, 0) && inside(*at, 1))
    }

    /// Corners of a rectangle on the page.
    pub fn corners(&self, rectangle: &Rectangle) -> [Option<[f64; 2]>; 4] {
        rectangle.corners().map(|corner| self.at(corner))
    }

    /// Corners of the window on the map.
    pub fn window(&self) -> [[f64; 2]; 4] {
        let ([left, top], [width, height]) = (self.place, self.size);
        [[0.0, 0.0], [width, 0.0], [width, height], [0.0, height]]
            .map(|[x, y]| self.place_at([left + x, top + y]))
    }

    /// Direction of the map's y axis on the page (right, down).
    pub fn north(&self) -> [f64; 2] {
        [self.direction[1], -self.direction[0]]
    }
}

/// Position and direction of the CAV, or a stand-in when they are not numbers.
fn pose(cycle: &Cycle) -> ([f64; 2], [f64; 2]) {
    let ego = &cycle.ego;
    let origin = [ego.x, ego.y].map(|v| if v.is_finite() { v } else { 0.0 });
    let norm = ego.cos.hypot(ego.sin);
    let direction =
        if norm.is_finite() && norm > 0.5 { [ego.cos / norm, ego.sin / norm] } else { [1.0, 0.0] };
    (origin, direction)
}

fn turn(place: [f64; 2], origin: [f64; 2], [cos, sin]: [f64; 2]) -> Option<[f64; 2]> {
    let [x, y] = [place[0] - origin[0], place[1] - origin[1]];
    let turned = [x * cos + y * sin, y * cos - x * sin];
    turned.iter().all(|v| v.is_finite()).then_some(turned)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn frame() -> Frame {
        Frame::fit([100.0, 200.0], [0.0, 1.0], [-10.0, -8.0], [48.0, 8.0])
    }

    #[test]
    fn the_cav_drives_to_the_right_and_left_is_up() {
        let frame = frame();
        let [x0, y0] = frame.at([100.0, 200.0]).unwrap();
        let [x1, y1] = frame.at([100.0, 210.0]).unwrap();
        let [x2, y2] = frame.at([95.0, 200.0]).unwrap();
        assert!(x1 > x0 && (y1 - y0).abs() < 1e-6);
        assert!(y2 < y0 && (x2 - x0).abs() < 1e-6);
    }

    #[test]
    fn a_place_comes_back_from_the_page() {
        let frame = frame();
        let [x, y] = frame.place_at(frame.at([103.0, 207.0]).unwrap());
        assert!((x - 103.0).abs() < 1e-6 && (y - 207.0).abs() < 1e-6);
    }

    #[test]
    fn what_is_not_a_number_is_not_drawn() {
        assert_eq!(frame().at([f64::NAN, 0.0]), None);
        assert_eq!(frame().at([f64::INFINITY, 0.0]), None);
        assert_eq!(frame().at([1e300, 0.0]), None);
    }
}
