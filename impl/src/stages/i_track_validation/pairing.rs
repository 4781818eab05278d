//! Stage i decided by a witness, which is enough nearly always: some one-to-one pairs of tracks
//! and detections whose mean distance is below the threshold; the minimal assignment is at most as
//! costly. Where no witness is found so, the assignment decides.
//!
//! Detections are hashed by the squares of a uniform grid, and every track takes the nearest free
//! detection of its square that is within reach, else of the squares next to it: linear time
//! unless many detections share a square.

use crate::input::cycle::Detection;
use crate::input::scratch::{Column, NONE, Row, short};
use crate::stages::i_track_validation::gate::{Gate, apart_squared};
use crate::stages::i_track_validation::places::Places;

/// What the pairs have to keep.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PairLimits {
    /// Every pair has to be closer, m.
    pub(crate) limit: f64,
    /// The mean has to be below, m.
    pub(crate) theta_tr: f64,
    /// So many gated tracks may be left out.
    pub(crate) spare: usize,
    /// Whether a track may, by its index; what is known of tracks stands in the rows.
    pub(crate) may_be_left: fn(&[Row], usize) -> bool,
}

/// More than the distance of a track to a detection errs in plain doubles, m: twice the error of a
/// place.
const PLACE_ERROR: f64 = 2e-8;

/// Whether there certainly are pairs of all gated tracks but some that keep the limits. `p`: the CAV's
/// position. Plain doubles: a distance, or the square of one, errs by less than 2^-50 of itself, 2^-400 m
/// and twice the error of a place, a sum of at most 1024 by less than 2^-42 of itself more.
pub(crate) fn certainly_pass(
    p: [f64; 2],
    places: &Places<'_>,
    detections: &[Detection],
    limits: PairLimits,
    (rows, columns): (&[Row], &mut [Column]),
) -> bool {
    let mut sum = PairSum::new(limits, places);
    // Farther pairs would hardly keep the mean below the threshold.
    let reach = (5.0 * limits.theta_tr).min(limits.limit * (1.0 - 1e-12) - sum.error);
    let mut squares = Squares::new(detections, reach, columns);
    let mut gate = Gate::new(p, places);
    for (index, detection) in detections.iter().enumerate() {
        let place = [detection.x, detection.y];
        gate.include(place);
        squares.insert(index, place);
    }
    for (index, track) in places.tracks.iter().enumerate() {
        let place = places.of(track);
        let is_gated = gate.admits(place);
        if is_gated == Some(false) {
            continue;
        }
        let fits = match squares.take(place) {
            Some(squared) => sum.pair(is_gated, libm::sqrt(squared)),
            None => sum.leave_out((limits.may_be_left)(rows, index)),
        };
        if !fits {
            return false;
        }
    }
    sum.passes()
}

/// Pairs so far, and tracks that are left out.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PairSum {
    limits: PairLimits,
    /// Of a distance, m.
    error: f64,
    /// m
    sum: f64,
    paired: u32,
    left: usize,
}

impl PairSum {
    /// No pairs.
    pub(crate) const fn new(limits: PairLimits, places: &Places<'_>) -> Self {
        let error = if places.ahead_ns == 0 { 0.0 } else { PLACE_ERROR };
        Self { limits, error, sum: 0.0, paired: 0, left: 0 }
    }

    /// Whether one more pair fits, of a track that is gated or may be (`Gate::admits`). One of the second kind has to be
    /// below `theta_tr` itself: then it cannot lift the mean of the others to `theta_tr`, whether it counts or not.
    pub(crate) fn pair(&mut self, is_gated: Option<bool>, metres: f64) -> bool {
        if is_gated.is_none() {
            return self.is_mean_below(metres, 1.0);
        }
        self.sum += metres;
        self.paired = self.paired.saturating_add(1);
        true
    }

    /// Whether one more track fits that is left out.
    pub(crate) const fn leave_out(&mut self, may_be_left: bool) -> bool {
        self.left = self.left.saturating_add(1);
        may_be_left && self.left <= self.limits.spare
    }

    /// Whether the mean certainly is below the limit, or nothing was to be paired (S1-06, I-02).
    pub(crate) fn passes(&self) -> bool {
        self.paired == 0 || self.is_mean_below(self.sum, f64::from(self.paired))
    }

    fn is_mean_below(&self, sum: f64, k: f64) -> bool {
        sum * (1.0 + 1e-12) + 1e-100 + k * self.error < k * self.limits.theta_tr
    }
}

/// Detections by the square that they are in.
struct Squares<'d, 's> {
    detections: &'d [Detection],
    /// `near`: the last detection inserted of all squares with this hash, and the one inserted before.
    columns: &'s mut [Column],
    mask: u64,
    reach: f64,
    /// Squares per m: a side is eight times the reach.
    scale: f64,
}

impl<'d, 's> Squares<'d, 's> {
    fn new(detections: &'d [Detection], reach: f64, columns: &'s mut [Column]) -> Self {
        for column in columns.iter_mut() {
            column.near.head = NONE;
            column.is_taken = false;
        }
        let mask = match columns.len().checked_ilog2() {
            Some(log) => (1_u64 << log).wrapping_sub(1),
            None => 0,
        };
        Self { detections, columns, mask, reach, scale: 0.125 / reach }
    }

    fn hash(&self, [x, y]: [f64; 2]) -> usize {
        /// Added to a number, this leaves the nearest integer in its low bits: the reach is at least
        /// 1e-3 m (5 `theta_tr`, or the limit), so that it is at most 2^25 m / (8 * 0.99e-3 m),
        /// below 2^32 and far below 2^51.
        const INTEGER: f64 = 6_755_399_441_055_744.0;
        let [i, k] = [x, y].map(|value| (value * self.scale + INTEGER).to_bits());
        let mixed = i.wrapping_mul(0x9E37_79B9_7F4A_7C15) ^ k.wrapping_mul(0xC2B2_AE3D_27D4_EB4F);
        usize::try_from((mixed >> 32) & self.mask).unwrap_or(0)
    }

    fn insert(&mut self, index: usize, place: [f64; 2]) {
        let hash = self.hash(place);
        let Some(before) = self
            .columns
            .get_mut(hash)
            .map(|column| core::mem::replace(&mut column.near.head, short(index)))
        else {
            return;
        };
        if let Some(column) = self.columns.get_mut(index) {
            column.near.next = before;
        }
    }

    /// Takes the nearest free detection within reach that is in the square of a place, else one of
    /// a square beside it; the square of its distance, m^2.
    fn take(&mut self, place: [f64; 2]) -> Option<f64> {
        let own = self.hash(place);
        self.take_from(own, place).or_else(|| self.take_beside(own, place))
    }

    /// For one track of thirty or so.
    #[cold]
    fn take_beside(&mut self, own: usize, place: [f64; 2]) -> Option<f64> {
        let ([x, y], r) = (place, self.reach);
        let corners = [[x - r, y - r], [x + r, y - r], [x - r, y + r], [x + r, y + r]];
        corners.into_iter().find_map(|corner| {
            let hash = self.hash(corner);
            if hash == own { None } else { self.take_from(hash, place) }
        })
    }

    fn take_from(&mut self, hash: usize, place: [f64; 2]) -> Option<f64> {
        let mut nearest = self.reach * self.reach;
        let mut found = None;
        let mut next = self.columns.get(hash)?.near.head;
        while let (Some(detection), Some(column)) =
            (self.detections.get(usize::from(next)), self.columns.get(usize::from(next)))
        {
            let squared = apart_squared(place, [detection.x, detection.y]);
            if squared < nearest && !column.is_taken {
                nearest = squared;
                found = Some(next);
            }
            next = column.near.next;
        }
        self.columns.get_mut(usize::from(found?))?.is_taken = true;
        Some(nearest)
    }
}
