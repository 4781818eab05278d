//! The strip without an end that an object sweeps over from a time on, and whether the CAV stands
//! in it (H-13 (c) of `spec/3-stages.md#hardened-profile`).
//!
//! Plain doubles, with the bounds of `sweep`: what is not certain either way is left to
//! `rectangle`.

use crate::numbers::range::larger;
use crate::stages::llcc::sweep::{MARGIN, MovingRectangle, minus, split};

/// What is less than this of a velocity is no sign of a component: it rounds by less than 2^-48.
const NO_SIGN: f64 = 1e-12;
/// What is lost to underflow is less, m/s and m^2/s.
const UNDERFLOW: f64 = 1e-150;

impl MovingRectangle {
    /// Whether the rectangle, where it stands, shares no point with another one from so many seconds on,
    /// for ever; unless that is too close to call.
    pub(crate) fn is_passed_by(&self, other: &Self, seconds: f64) -> Option<bool> {
        let (between, velocity) = (minus(other.after(seconds), self.centre), other.velocity);
        let [vx, vy] = velocity;
        let size = vx.abs() + vy.abs();
        // What stands still closes no gap: a rate above every number.
        let still = if size <= 0.0 { f64::INFINITY } else { 0.0 };
        let no_sign = size * NO_SIGN + UNDERFLOW;
        let stays = |gap: f64, rate: f64| gap > MARGIN && rate + still > no_sign;
        let may_stay = |gap: f64, rate: f64| gap >= -MARGIN && rate + still >= -no_sign;
        let mut is_met = true;
        for one in [self, other] {
            let (at, rates) = (split(one.direction, between), split(one.direction, velocity));
            let (a, b) = (self.extents(one.direction), other.extents(one.direction));
            let reaches = a.into_iter().zip(b).map(|(a, b)| a + b);
            for ((at, rate), reach) in at.into_iter().zip(rates).zip(reaches) {
                if stays(at - reach, rate) || stays(-at - reach, -rate) {
                    return Some(true);
                }
                is_met &= !may_stay(at - reach, rate) && !may_stay(-at - reach, -rate);
            }
        }
        let ([_, a], [_, b]) = (self.extents(velocity), other.extents(velocity));
        let gap = (vx * between[1] - vy * between[0]).abs() - (a + b);
        let close = size * MARGIN + UNDERFLOW;
        if gap > close {
            return Some(true);
        }
        (is_met && (size <= 0.0 || gap < -close)).then_some(false)
    }

    /// Whether no velocity leads the rectangle from where it is at the time 0 to both others, later
    /// on: the line to half way between them keeps them certainly on either side.
    pub(crate) fn is_beside(&self, one: &Self, other: &Self) -> bool {
        let [x, y] = minus(other.centre, one.centre);
        let to_one = minus(one.centre, self.centre);
        let line = [to_one[0] + 0.5 * x, to_one[1] + 0.5 * y];
        let extent = |it: &Self| {
            let [_, across] = it.extents(line);
            across
        };
        let wider = larger(extent(one), extent(other));
        let margin = (line[0].abs() + line[1].abs()) * MARGIN + UNDERFLOW;
        (0.5 * (line[0] * y - line[1] * x)).abs() > wider + extent(self) + margin
    }
}

#[cfg(test)]
mod tests;
