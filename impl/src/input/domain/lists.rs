//! Whole lists at a first look, without a branch for each value, and ids that may have been there
//! before. NaN is in no range.

use crate::input::cycle::{CrossSection, Detection, Track, Trajectory, TrajectoryPoint};
use crate::input::domain::place::{HORIZON_NS, POSITION, SIZE, VELOCITY, is_clearly_a_direction};
use crate::numbers::plane::same_point;
use crate::numbers::time::elapsed_ns;

/// Whether all cross sections are clearly valid; here and below the checks of single values decide,
/// and say what is wrong, when it is not so.
pub(super) fn cross_sections_are_fine(cross_sections: &[CrossSection]) -> bool {
    let (mut all_fine, mut before) = (true, [f64::NAN; 2]);
    for &CrossSection { x, y, left, right } in cross_sections {
        for place in [[x, y], left, right] {
            all_fine &= are_within(place, POSITION);
        }
        all_fine &= !same_point(before, [x, y]);
        before = [x, y];
    }
    all_fine
}

pub(super) fn detections_are_fine(items: &[Detection]) -> bool {
    let mut all_fine = true;
    for &Detection { x, y, cos, sin, length, width } in items {
        all_fine &= are_within([x, y], POSITION);
        all_fine &= is_clearly_a_direction(cos, sin);
        all_fine &= are_within([length, width], SIZE);
    }
    all_fine
}

/// Ids that increase are different. (A first id of -2^63 is left to the other check.)
pub(super) fn tracks_are_fine(items: &[Track]) -> bool {
    let (mut all_fine, mut before) = (true, i64::MIN);
    for &Track { id, x, y, cos, sin, vx, vy, length, width } in items {
        all_fine &= are_within([x, y], POSITION);
        all_fine &= is_clearly_a_direction(cos, sin);
        all_fine &= are_within([vx, vy], VELOCITY);
        all_fine &= are_within([length, width], SIZE);
        all_fine &= before < id;
        before = id;
    }
    all_fine
}

/// When times increase, the first and the last one say whether all are within 60 s of now.
pub(super) fn points_are_fine(trajectory: &Trajectory<'_>, now_ns: i64) -> bool {
    let (mut all_fine, mut before) = (true, i64::MIN);
    for &TrajectoryPoint { t_ns, x, y, cos, sin } in trajectory.points {
        all_fine &= are_within([x, y], POSITION);
        all_fine &= is_clearly_a_direction(cos, sin);
        all_fine &= before < t_ns;
        before = t_ns;
    }
    let ends = [trajectory.points.first(), trajectory.points.last()];
    let is_near_now =
        |end: &TrajectoryPoint| (-HORIZON_NS..=HORIZON_NS).contains(&elapsed_ns(end.t_ns, now_ns));
    all_fine && ends.into_iter().flatten().all(is_near_now)
}

fn are_within(values: [f64; 2], [least, most]: [f64; 2]) -> bool {
    let mut within = true;
    for value in values {
        within &= least <= value && value <= most;
    }
    within
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
