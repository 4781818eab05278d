//! Which cells a current detection covers (H-06 of `spec/hardened/H-06.md`).

use crate::hardened::detection_history::explained::Explaining;
use crate::hardened::h14_fail_safe::motion::Motion;
use crate::input::cycle::{Detection, DetectionList, Grid};
use crate::numbers::plane::Vector;
use crate::numbers::range::float;
use crate::numbers::rectangle::{Rectangle, certainly_touch};
use crate::numbers::rounding::Real;
use crate::numbers::time::{elapsed_ns, seconds};
use crate::stages::llcc::sweep::MovingRectangle;

/// Detections over a grid.
pub(super) struct Covered<'c, 'a> {
    pub(super) grid: &'c Grid<'a>,
    pub(super) items: &'c [Detection],
    /// Where they came from, where H-14 examines that (H-06.7).
    explaining: Option<&'c Explaining<'c, 'c, 'a>>,
    /// From their stamp to that of the grid, ns.
    since_ns: i64,
    /// So far the velocity that a track states may lead astray in that time, m.
    astray: f64,
}

impl<'c, 'a> Covered<'c, 'a> {
    pub(super) fn new(
        grid: &'c Grid<'a>,
        list: Option<&'c DetectionList<'a>>,
        explaining: Option<&'c Explaining<'c, 'c, 'a>>,
    ) -> Self {
        let items = list.map_or(&[][..], |list| list.items);
        let stamp_ns = list.map_or(grid.stamp_ns, |list| list.stamp_ns);
        let since_ns = elapsed_ns(stamp_ns, grid.stamp_ns);
        let astray = explaining.map_or(0.0, |it| it.misstated() * seconds(since_ns).abs());
        Self { grid, items, explaining, since_ns, astray }
    }

    /// Whether a cell certainly shares a point with some detection, grown (H-06.3). `latest`: which
    /// one covered a cell last; it often covers the next one, too.
    pub(super) fn has(&self, i: i64, k: i64, latest: &mut Latest) -> bool {
        let (plain, square) = (plain_square(self.grid, i, k), || square(self.grid, i, k));
        if latest.is_some_and(|it| certainly_covers(&it, &plain, square)) {
            return true;
        }
        let mut near = self.items.iter().map(grown).enumerate();
        let found = near.find_map(|(detection, grown)| {
            if self.is_far(detection, &grown, &plain) {
                return None;
            }
            let motion = self.motion(detection, grown);
            certainly_covers(&motion, &plain, square).then_some(motion)
        });
        *latest = found.or(*latest);
        found.is_some()
    }

    /// Most are, and need not be looked for in a list.
    fn is_far(&self, detection: usize, grown: &MovingRectangle, cell: &MovingRectangle) -> bool {
        let stated = self.explaining.and_then(|it| Some((it.stated(detection)?, self.astray)));
        let (velocity, astray) = stated.unwrap_or_default();
        let moving = Motion::new(MovingRectangle { velocity, ..*grown }, self.since_ns);
        cell.certainly_far(&moving.plainly(), cell.reach() + grown.reach() + astray)
    }

    /// How it moves until the grid is measured.
    fn motion(&self, detection: usize, grown: MovingRectangle) -> Motion {
        let stands = Motion::new(grown, self.since_ns);
        self.explaining.and_then(|it| it.moving(detection, &stands)).unwrap_or(stands)
    }
}

/// What covered a cell last.
pub(super) type Latest = Option<Motion>;

/// Whether the cell certainly shares a point with a detection, grown and moved on. What is detected fills its cells:
/// plain doubles tell most.
fn certainly_covers(
    motion: &Motion,
    plain: &MovingRectangle,
    square: impl FnOnce() -> Rectangle,
) -> bool {
    let moved = motion.plainly();
    let by = || motion.velocity().times(Real::seconds(motion.age_ns));
    moved.certainly_contains(plain.centre)
        || !plain.certainly_apart(&moved) && certainly_touch(&motion.now.displaced(by()), &square())
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
