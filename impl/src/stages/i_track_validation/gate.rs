//! The field of view (`spec/3-stages.md#stage-i-track-validation`): whether a track is at most as
//! far from the CAV as the farthest detection. In plain doubles; exactly where these cannot tell.

use core::cmp::Ordering;

use crate::input::cycle::Detection;
use crate::input::scratch::{Row, short};
use crate::numbers::exact::{compare_distances, compare_moved_distances};
use crate::stages::i_track_validation::places::Places;

/// A square of a distance between given points errs by less than 2^-50 of itself and 1e-240.
const GIVEN: [f64; 2] = [1e-14, 1e-200];
/// A place that has moved errs by less than 4e-9 m, the square of its distance by less than this
/// part of it and of 1 m^2.
const MOVED: [f64; 2] = [2e-8, 2e-8];

/// The CAV's position and the square of the radius, up to rounding.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Gate {
    p: [f64; 2],
    farthest: f64,
    /// What is open of a square of a distance: a part of it, and m^2.
    open: [f64; 2],
}

impl Gate {
    /// Without detections the radius is 0 (S1-02).
    pub(crate) const fn new(p: [f64; 2], places: &Places<'_>) -> Self {
        Self { p, farthest: 0.0, open: if places.ahead_ns == 0 { GIVEN } else { MOVED } }
    }

    /// Widens the gate up to a detection (S1-01).
    pub(crate) fn include(&mut self, detection: [f64; 2]) {
        let away = apart_squared(self.p, detection);
        self.farthest = if away > self.farthest { away } else { self.farthest };
    }

    /// Whether a track here is gated (S1-03); `None` when it is as far as the farthest detection,
    /// or almost.
    pub(crate) fn admits(&self, track: [f64; 2]) -> Option<bool> {
        let away = apart_squared(self.p, track);
        let [relative, absolute] = self.open;
        if away > self.farthest * (1.0 + relative) + absolute {
            Some(false)
        } else if away < self.farthest * (1.0 - relative) - absolute {
            Some(true)
        } else {
            None
        }
    }
}

/// The square of the distance of two places, m^2.
pub(crate) fn apart_squared([ax, ay]: [f64; 2], [bx, by]: [f64; 2]) -> f64 {
    let (dx, dy) = (ax - bx, ay - by);
    dx * dx + dy * dy
}

/// Writes the indices of the gated tracks into the rows, and returns how many; exact.
pub(crate) fn gated_tracks(
    p: [f64; 2],
    places: &Places<'_>,
    detections: &[Detection],
    rows: &mut [Row],
) -> usize {
    let detected = || detections.iter().map(|it| [it.x, it.y]);
    let mut gate = Gate::new(p, places);
    detected().for_each(|place| gate.include(place));
    let mut farthest = None;
    let mut exactly = |index: usize| {
        let farther = |a, b| if compare_distances(p, b, a) == Ordering::Greater { b } else { a };
        // Whatever is certainly nearer than the farthest one is not the farthest.
        let far = || detected().filter(|&place| gate.admits(place).is_none());
        // S1-01; without detections p itself: S1-02
        let farthest = *farthest.get_or_insert_with(|| far().fold(p, farther));
        let order = places.tracks.get(index).map(|track| {
            let (at, velocity) = ([track.x, track.y], [track.vx, track.vy]);
            match places.ahead_ns {
                0 => compare_distances(p, at, farthest),
                ahead_ns => compare_moved_distances(p, (at, velocity, ahead_ns), farthest),
            }
        });
        // S1-03
        order.is_some_and(|order| order != Ordering::Greater)
    };
    let are_gated = places
        .tracks
        .iter()
        .enumerate()
        .map(|(index, track)| gate.admits(places.of(track)).unwrap_or_else(|| exactly(index)));
    list(are_gated, rows)
}

/// Writes the indices of those that are gated into the rows, and returns how many.
pub(crate) fn list(are_gated: impl Iterator<Item = bool>, rows: &mut [Row]) -> usize {
    let mut gated = 0_usize;
    for (index, is_gated) in are_gated.enumerate() {
        if let (true, Some(row)) = (is_gated, rows.get_mut(gated)) {
            row.track = short(index);
            gated = gated.saturating_add(1);
        }
    }
    gated
}

#[cfg(test)]
mod tests;
