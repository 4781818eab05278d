//! Which cells a current detection covers (H-06 of `spec/hardened/H-06.md`).

use crate::input::cycle::{Detection, Grid};
use crate::numbers::plane::Vector;
use crate::numbers::range::float;
use crate::numbers::rectangle::{Rectangle, certainly_touch};
use crate::numbers::rounding::Real;
use crate::stages::llcc::sweep::MovingRectangle;
use crate::stages::llcc::vector;

/// Detections over a grid.
pub(super) struct Covered<'c, 'a> {
    pub(super) grid: &'c Grid<'a>,
    pub(super) items: &'c [Detection],
}

impl Covered<'_, '_> {
    /// Whether a cell certainly shares a point with some detection, grown (H-06.3). `latest`: which
    /// one covered a cell last; it often covers the next one, too.
    pub(super) fn has(&self, i: i64, k: i64, latest: &mut usize) -> bool {
        let (plain, square) = (plain_square(self.grid, i, k), || square(self.grid, i, k));
        let covers =
            |at: usize| self.items.get(at).is_some_and(|it| certainly_covers(it, &plain, square));
        if covers(*latest) {
            return true;
        }
        let found = (0..self.items.len()).find(|&at| covers(at));
        *latest = found.unwrap_or(*latest);
        found.is_some()
    }
}

/// Whether the cell certainly shares a point with the detection's rectangle, grown. Within 1e-6 m of its edge plain doubles
/// do not tell.
fn certainly_covers(
    detection: &Detection,
    plain: &MovingRectangle,
    square: impl FnOnce() -> Rectangle,
) -> bool {
    let grown = grown(detection);
    if plain.certainly_far(&grown, plain.reach() + grown.reach()) {
        return false;
    }
    plain.certainly_touches(&grown)
        || !plain.certainly_apart(&grown)
            && certainly_touch(&grown.displaced(vector([0.0; 2])), &square())
}

/// The detection's rectangle with half length and half width greater by 1/4 m, or by a rounding less.
fn grown(detection: &Detection) -> MovingRectangle {
    let larger = |size: f64| {
        let sum = size + 0.5;
        // The difference is exact, so it tells whether the sum was rounded up: by at most 2^-53 of it.
        if sum - 0.5 > size { sum * (1.0 - f64::EPSILON) } else { sum }
    };
    let given = MovingRectangle::detection(detection);
    MovingRectangle { size: given.size.map(larger), ..given }
}

/// The closed square of a cell.
pub(super) fn square(grid: &Grid<'_>, i: i64, k: i64) -> Rectangle {
    let &Grid { x, y, cos, sin, resolution, .. } = grid;
    let middle = |index| (Real::integer(index) + Real::new(0.5)) * Real::new(resolution);
    let (direction, turned) = (Vector::new(cos, sin), Vector::new(-sin, cos));
    let centre = Vector::new(x, y) + direction.times(middle(i)) + turned.times(middle(k));
    Rectangle { centre, direction, length: resolution, width: resolution }
}

/// The closed square of a cell in plain doubles: its centre is rounded five times, which leaves it
/// as near as `sweep` needs it.
pub(super) fn plain_square(grid: &Grid<'_>, i: i64, k: i64) -> MovingRectangle {
    let &Grid { x, y, cos, sin, resolution, .. } = grid;
    let [along, across] = [i, k].map(|index| (float(index) + 0.5) * resolution);
    MovingRectangle {
        centre: [x + along * cos - across * sin, y + along * sin + across * cos],
        direction: [cos, sin],
        velocity: [0.0, 0.0],
        size: [resolution, resolution],
    }
}

#[cfg(test)]
mod tests;
