//! Whole lists at a first look, and ids that may have been there before.

use crate::input::cycle::{CrossSection, Detection, Track, Trajectory, TrajectoryPoint};
use crate::input::domain::place::{HORIZON_NS, POSITION, SIZE, VELOCITY};
use crate::input::domain::screen::Screen;
use crate::numbers::plane::same_point;
use crate::numbers::time::elapsed_ns;

/// Whether all cross sections are clearly valid; here and below the checks of single values decide, and
/// say what is wrong, when it is not so.
pub(super) fn cross_sections_are_fine(cross_sections: &[CrossSection]) -> bool {
    let [_, most] = POSITION;
    let mut screen = Screen::default();
    let mut before = [f64::NAN; 2];
    for &CrossSection { x, y, left, right } in cross_sections {
        [[x, y], left, right].into_iter().for_each(|place| screen.sizes(place, most));
        screen.holds(!same_point(before, [x, y]));
        before = [x, y];
    }
    screen.passes()
}

pub(super) fn detections_are_fine(items: &[Detection]) -> bool {
    let [_, most] = POSITION;
    let mut screen = Screen::default();
    for &Detection { x, y, cos, sin, length, width } in items {
        screen.sizes([x, y], most);
        screen.direction([cos, sin]);
        screen.ranges([length, width], SIZE);
    }
    screen.passes()
}

/// Ids that increase are different. (A first id of -2^63 is left to the other check.)
pub(super) fn tracks_are_fine(items: &[Track]) -> bool {
    let ([_, farthest], [_, fastest]) = (POSITION, VELOCITY);
    let mut screen = Screen::default();
    let mut before = i64::MIN;
    for &Track { id, x, y, cos, sin, vx, vy, length, width } in items {
        screen.sizes([x, y], farthest);
        screen.direction([cos, sin]);
        screen.sizes([vx, vy], fastest);
        screen.ranges([length, width], SIZE);
        screen.holds(before < id);
        before = id;
    }
    screen.passes()
}

/// When times increase, the first and the last one say whether all are within 60 s of now.
pub(super) fn points_are_fine(trajectory: &Trajectory<'_>, now_ns: i64) -> bool {
    let [_, most] = POSITION;
    let mut screen = Screen::default();
    let mut before = i64::MIN;
    for &TrajectoryPoint { t_ns, x, y, cos, sin } in trajectory.points {
        screen.sizes([x, y], most);
        screen.direction([cos, sin]);
        screen.holds(before < t_ns);
        before = t_ns;
    }
    for end in [trajectory.points.first(), trajectory.points.last()].into_iter().flatten() {
        let age_ns = elapsed_ns(end.t_ns, now_ns);
        screen.holds((-HORIZON_NS..=HORIZON_NS).contains(&age_ns));
    }
    screen.passes()
}

/// Bits of the ids so far; two ids may share one, so a set bit only says "perhaps".
pub(super) struct Seen([u64; 64]);

impl Default for Seen {
    fn default() -> Self {
        Self([0; 64])
    }
}

impl Seen {
    /// Whether the id may have been here before; from now on it has. Ids counted up from anywhere
    /// get a bit each.
    pub(super) fn perhaps(&mut self, id: i64) -> bool {
        let place = usize::try_from(id >> 6 & 63).unwrap_or(0);
        let Some(word) = self.0.get_mut(place) else { return true };
        let bit = 1 << (id & 63);
        let seen = *word & bit != 0;
        *word |= bit;
        seen
    }
}
