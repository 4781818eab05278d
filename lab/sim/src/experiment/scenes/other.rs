//! Whom the CAV meets.

use super::pace::Pace;
use super::way::Way;
use crate::pose::{Point, Pose, Rectangle};

/// Between the two places that a velocity is of, s.
const MOMENT: f64 = 0.005;

/// Along what the other goes.
#[derive(Clone, Copy, Debug)]
pub(super) enum Line {
    /// A straight line.
    Straight(Pose),
    /// The CAV's way: from where on the reference path, m, how far to the left, m, and whether against it.
    Way { from: f64, aside: f64, against: bool },
}

/// The other.
#[derive(Clone, Debug)]
pub(super) struct Other {
    /// Length and width, m.
    pub(super) size: [f64; 2],
    pub(super) pace: Pace,
    pub(super) line: Line,
    /// When it leaves its line, s, and its curvature from then on, 1/m.
    pub(super) turn: Option<(f64, f64)>,
}

impl Other {
    /// Where it is, and what it covers.
    pub(super) fn at(&self, way: &Way, t: f64) -> Rectangle {
        let [length, width] = self.size;
        Rectangle { pose: self.pose(way, t), length, width }
    }

    /// Its velocity, m/s.
    pub(super) fn velocity(&self, way: &Way, t: f64) -> [f64; 2] {
        let [a, b] = [t - MOMENT, t + MOMENT].map(|t| self.pose(way, t).at);
        [(b.x - a.x) / (2.0 * MOMENT), (b.y - a.y) / (2.0 * MOMENT)]
    }

    fn pose(&self, way: &Way, t: f64) -> Pose {
        let driven = self.pace.at(t).0;
        let Some((from, curvature)) = self.turn.filter(|(from, _)| t > *from) else {
            return self.on_line(way, driven);
        };
        let straight = self.pace.at(from).0;
        along(self.on_line(way, straight), driven - straight, curvature)
    }

    fn on_line(&self, way: &Way, driven: f64) -> Pose {
        match self.line {
            Line::Straight(pose) => along(pose, driven, 0.0),
            Line::Way { from, aside, against: false } => way.beside(from + driven, aside, 0.0),
            Line::Way { from, aside, against: true } => {
                let pose = way.beside(from - driven, aside, 0.0);
                Pose { cos: -pose.cos, sin: -pose.sin, ..pose }
            }
        }
    }

    /// Where it gets to from the origin, on a straight line along x, until a time, s.
    pub(super) fn shape(&self, t: f64) -> Pose {
        let driven = self.pace.at(t).0;
        let origin = Pose::new(Point::default(), 0.0);
        let Some((from, curvature)) = self.turn.filter(|(from, _)| t > *from) else {
            return along(origin, driven, 0.0);
        };
        let straight = self.pace.at(from).0;
        along(along(origin, straight, 0.0), driven - straight, curvature)
    }
}

/// The end of an arc.
fn along(pose: Pose, length: f64, curvature: f64) -> Pose {
    let angle = curvature * length;
    let (sin, cos) = libm::sincos(angle);
    let (ahead, left) =
        if angle.abs() < 1e-9 { (length, 0.0) } else { (sin / curvature, (1.0 - cos) / curvature) };
    Pose { at: pose.ahead(ahead, left), ..pose }.turned(cos, sin)
}
