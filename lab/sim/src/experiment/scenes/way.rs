//! The way of the CAV: straight, a bend, straight again, perhaps with a change of the lane.

use crate::pose::{Point, Pose};

/// Where it begins and ends beside what is driven, m.
pub(super) const MARGIN: f64 = 60.0;
/// Between two places whose length of way is known, m.
const STEP: f64 = 0.5;

/// A change of the lane.
#[derive(Clone, Copy, Debug)]
pub(super) struct Change {
    pub(super) from: f64,
    pub(super) length: f64,
    /// To the left, m.
    pub(super) aside: f64,
}

/// A way; the reference path is the one without the change of the lane.
#[derive(Clone, Debug)]
pub(super) struct Way {
    /// Of the bend: 1/m, where it begins, and its length, m.
    bend: (f64, f64, f64),
    change: Option<Change>,
    /// Lengths driven from `-MARGIN` to each step of the reference path, m.
    lengths: Vec<f64>,
}

impl Way {
    /// A way that is driven for so long, m.
    pub(super) fn new(bend: (f64, f64, f64), change: Option<Change>, driven: f64) -> Self {
        let mut way = Self { bend, change, lengths: Vec::new() };
        if change.is_some() {
            let (mut lengths, mut at) = (vec![0.0], -MARGIN);
            while at < driven + 2.0 * MARGIN {
                let [a, b] = [at, at + STEP].map(|it| way.on_reference(it, (0.0, 0.0)).at);
                let last = lengths.last().copied().unwrap_or(0.0);
                lengths.push(last + a.distance(b));
                at += STEP;
            }
            way.lengths = lengths;
        }
        way
    }

    /// The place after a length that is driven, m, and so far to the left, m, with its slope.
    pub(super) fn pose(&self, driven: f64, aside: (f64, f64)) -> Pose {
        self.on_reference(self.reference(driven), aside)
    }

    /// The point of the reference path beside what is driven, m.
    pub(super) fn reference(&self, driven: f64) -> f64 {
        let from_start = driven + MARGIN;
        let after = self.lengths.partition_point(|it| *it <= from_start);
        let Some([low, high]) = after.checked_sub(1).and_then(|it| self.lengths.get(it..=after))
        else {
            return driven;
        };
        #[expect(clippy::cast_precision_loss, reason = "few steps")]
        let steps = (after - 1) as f64 + (from_start - low) / (high - low);
        steps * STEP - MARGIN
    }

    /// A place of the reference path, m, moved to the left by the change of the lane and so far more.
    fn on_reference(&self, at: f64, aside: (f64, f64)) -> Pose {
        let (mut aside, mut slope) = aside;
        if let Some(Change { from, length, aside: lane }) = self.change {
            let u = ((at - from) / length).clamp(0.0, 1.0);
            aside += lane * u * u * u * (10.0 - 15.0 * u + 6.0 * u * u);
            slope += lane * 30.0 * u * u * (1.0 - u) * (1.0 - u) / length;
        }
        self.beside(at, aside, slope)
    }

    /// A place of the reference path, m, moved to the left, m.
    pub(super) fn beside(&self, at: f64, aside: f64, slope: f64) -> Pose {
        let (curvature, begins, length) = self.bend;
        let in_bend = (at - begins).clamp(0.0, length);
        let angle = curvature * in_bend;
        let (sin, cos) = libm::sincos(angle);
        let arc = if curvature == 0.0 {
            Point::new(in_bend, 0.0)
        } else {
            Point::new(sin / curvature, (1.0 - cos) / curvature)
        };
        let (before, after) = (at.min(begins), (at - begins - length).max(0.0));
        let x = before + arc.x + after * cos - aside * sin;
        let y = arc.y + after * sin + aside * cos;
        let is_in_bend = (begins..begins + length).contains(&at);
        let along = if is_in_bend { 1.0 - curvature * aside } else { 1.0 };
        Pose::new(Point::new(x, y), angle + libm::atan2(slope, along))
    }
}
