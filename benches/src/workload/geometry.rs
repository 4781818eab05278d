//! The road of the workloads and what overlaps on it.

use std::f64::consts::TAU;

/// A place with a heading in radians.
#[derive(Clone, Copy, Debug)]
pub struct Pose {
    /// m
    pub x: f64,
    /// m
    pub y: f64,
    /// rad
    pub heading: f64,
}

/// A road that winds a little, 3.5 m wide.
#[derive(Clone, Debug)]
pub(super) struct Road {
    step: f64,
    pub(super) reference: Vec<[f64; 2]>,
    pub(super) left: Vec<[f64; 2]>,
    pub(super) right: Vec<[f64; 2]>,
}

impl Road {
    pub(super) fn new(cross_sections: usize, step: f64) -> Self {
        let mut reference = vec![[0.0, 0.0]];
        for i in 0..cross_sections - 1 {
            let a = heading(count(i) * step + step / 2.0);
            let [x, y] = reference[i];
            reference.push([x + step * a.cos(), y + step * a.sin()]);
        }
        let beside = |aside: f64| {
            let points = reference.iter().enumerate().map(|(i, &[x, y])| {
                let (sin, cos) = (heading(count(i) * step).sin(), heading(count(i) * step).cos());
                [x + aside * -sin, y + aside * cos]
            });
            points.collect()
        };
        let (left, right) = (beside(1.75), beside(-1.75));
        Self { step, reference, left, right }
    }

    pub(super) fn length(&self) -> f64 {
        count(self.reference.len() - 1) * self.step
    }

    /// The place at arc length `s`, `aside` to the left.
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "clamped")]
    pub(super) fn at(&self, s: f64, aside: f64) -> Pose {
        let s = s.max(0.0).min(self.length() - 1e-9);
        let index = (s / self.step) as usize;
        let part = s / self.step - count(index);
        let heading = heading(s);
        let ([x, y], [to_x, to_y]) = (self.reference[index], self.reference[index + 1]);
        Pose {
            x: x + part * (to_x - x) - aside * heading.sin(),
            y: y + part * (to_y - y) + aside * heading.cos(),
            heading,
        }
    }
}

fn heading(s: f64) -> f64 {
    0.5 + 0.15 * (TAU * s / 200.0).sin()
}

/// Whether two rectangles (pose, length, width) come within `margin`, by separating axes.
pub(super) fn overlap(a: (Pose, f64, f64), b: (Pose, f64, f64), margin: f64) -> bool {
    let ((p, pl, pw), (q, ql, qw)) = (a, b);
    let (dx, dy) = (q.x - p.x, q.y - p.y);
    let (ca, sa) = (p.heading.cos(), p.heading.sin());
    let (cb, sb) = (q.heading.cos(), q.heading.sin());
    let c = (ca * cb + sa * sb).abs();
    let s = (ca * sb - sa * cb).abs();
    !((dx * ca + dy * sa).abs() > pl / 2.0 + ql / 2.0 * c + qw / 2.0 * s + margin
        || (-dx * sa + dy * ca).abs() > pw / 2.0 + ql / 2.0 * s + qw / 2.0 * c + margin
        || (dx * cb + dy * sb).abs() > ql / 2.0 + pl / 2.0 * c + pw / 2.0 * s + margin
        || (-dx * sb + dy * cb).abs() > qw / 2.0 + pl / 2.0 * s + pw / 2.0 * c + margin)
}

#[expect(clippy::cast_precision_loss, reason = "sizes are far below 2^53")]
fn count(items: usize) -> f64 {
    items as f64
}
