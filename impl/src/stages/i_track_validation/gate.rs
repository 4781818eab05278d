//! The field of view (`spec/3-stages.md#stage-i-track-validation`): whether a track is at most as
//! far from the CAV as the farthest detection. In plain doubles; exactly where these cannot tell.

use core::cmp::Ordering;

use crate::input::cycle::{Detection, Track};
use crate::input::scratch::{Row, short};
use crate::numbers::exact::compare_distances;

/// A square of a distance errs by less than 2^-50 of itself and 1e-240.
const RELATIVE: f64 = 1e-14;
const ABSOLUTE: f64 = 1e-200;

/// The CAV's position and the square of the radius, up to rounding.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Gate {
    p: [f64; 2],
    farthest: f64,
}

impl Gate {
    /// Without detections the radius is 0.
    pub(crate) const fn new(p: [f64; 2]) -> Self {
        Self { p, farthest: 0.0 }
    }

    /// Widens the gate up to a detection.
    pub(crate) fn include(&mut self, detection: [f64; 2]) {
        let away = apart_squared(self.p, detection);
        self.farthest = if away > self.farthest { away } else { self.farthest };
    }

    /// Whether a track here is gated; `None` when it is as far as the farthest detection, or almost.
    pub(crate) fn admits(&self, track: [f64; 2]) -> Option<bool> {
        let away = apart_squared(self.p, track);
        if away > self.farthest * (1.0 + RELATIVE) + ABSOLUTE {
            Some(false)
        } else if away < self.farthest * (1.0 - RELATIVE) - ABSOLUTE {
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
    tracks: &[Track],
    detections: &[Detection],
    rows: &mut [Row],
) -> usize {
    let places = || detections.iter().map(|it| [it.x, it.y]);
    let mut gate = Gate::new(p);
    places().for_each(|place| gate.include(place));
    let mut farthest = None;
    let mut exactly = |track: [f64; 2]| {
        let farther = |a, b| if compare_distances(p, b, a) == Ordering::Greater { b } else { a };
        // Whatever is certainly nearer than the farthest one is not the farthest.
        let far = || places().filter(|&place| gate.admits(place).is_none());
        let farthest = farthest.get_or_insert_with(|| far().fold(p, farther));
        compare_distances(p, track, *farthest) != Ordering::Greater
    };
    let mut gated = 0_usize;
    for (index, track) in tracks.iter().enumerate() {
        let place = [track.x, track.y];
        let is_gated = gate.admits(place).unwrap_or_else(|| exactly(place));
        if let (true, Some(row)) = (is_gated, rows.get_mut(gated)) {
            row.track = short(index);
            gated = gated.saturating_add(1);
        }
    }
    gated
}

#[cfg(test)]
mod tests;
