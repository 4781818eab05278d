//! What a vehicle or a person follows: a path with its corridor, its limits, and whom it meets.

use mufasa::input::cycle::CrossSection;

use crate::path::Path;
use crate::pose::{Point, Pose, Rectangle};

/// Lateral acceleration at which other vehicles take bends, m/s^2.
const A_LATERAL: f64 = 2.0;
/// Deceleration at which they slow down for them, m/s^2.
const A_COMFORT: f64 = 1.5;

/// Who moves along a route.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RouteKind {
    /// Motor vehicles.
    Road,
    /// People on foot, across the road.
    Foot,
    /// People on bicycles, across the road.
    Cycle,
}

/// A path with its corridor.
#[derive(Clone, Debug, PartialEq)]
pub struct Route {
    /// A word for messages and pictures.
    pub name: String,
    /// Who moves along it.
    pub kind: RouteKind,
    /// The reference path.
    pub path: Path,
    /// From the path to the left boundary, per point, m.
    pub left: Vec<f64>,
    /// From the path to the right boundary, per point, m.
    pub right: Vec<f64>,
    /// Speed limit, per point, m/s.
    pub limits: Vec<f64>,
    /// Speed at which bends are taken and come up to, within the limits, per point, m/s.
    pub pace: Vec<f64>,
    /// Rank of the road, per point: 0 goes before 1, equal ranks give way to the right.
    pub rank: Vec<u8>,
    /// Stop lines of signals, in order.
    pub signals: Vec<Signal>,
    /// Stretches where others are met, in order and apart (`conflicts`).
    pub passages: Vec<Passage>,
    /// Whom a passage meets where, by passage and other route (`conflicts`).
    pub conflicts: Vec<Conflict>,
    /// For a route of the ego: where it starts and where it is to arrive.
    pub task: Option<Task>,
}

/// A stop line under a signal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Signal {
    /// Its arc length, m.
    pub s: f64,
    /// Index of the program.
    pub group: usize,
}

/// A stretch that is entered only when those that are met there have passed or wait.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Passage {
    /// The stop line before it, m.
    pub from: f64,
    /// Its end, m.
    pub to: f64,
    /// The signals over its stop line.
    pub group: Option<usize>,
}

/// Where the corridors of two routes overlap.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Conflict {
    /// The passage of this route that it belongs to.
    pub passage: usize,
    /// The overlap along this route, from and to, m.
    pub here: (f64, f64),
    /// The other route.
    pub with: usize,
    /// The overlap along the other route, from and to, m.
    pub there: (f64, f64),
    /// The passage of the other route that it belongs to.
    pub their_passage: usize,
    /// Whether those on the other route go first.
    pub gives_way: bool,
}

/// Where the ego starts and where it is to arrive.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Task {
    /// Arc length of the start, m.
    pub start: f64,
    /// Where the middle of the ego is to be.
    pub target: Rectangle,
}

impl Route {
    /// A route with one limit for all its points, m/s, before it is compared with others.
    pub fn new(name: &str, kind: RouteKind, path: Path, half_width: f64, limit: f64) -> Self {
        let count = path.points().len();
        Self {
            name: name.to_owned(),
            kind,
            path,
            left: vec![half_width; count],
            right: vec![half_width; count],
            limits: vec![limit; count],
            pace: vec![limit; count],
            rank: vec![0; count],
            signals: Vec::new(),
            passages: Vec::new(),
            conflicts: Vec::new(),
            task: None,
        }
    }

    /// Half widths of the corridor at an arc length, left and right, m.
    pub fn half_widths_at(&self, s: f64) -> (f64, f64) {
        (self.between(&self.left, s), self.between(&self.right, s))
    }

    /// Speed limit at an arc length, m/s.
    pub fn limit_at(&self, s: f64) -> f64 {
        self.limits[self.path.locate(s).0]
    }

    /// Speed at which other vehicles drive at an arc length, m/s.
    pub fn pace_at(&self, s: f64) -> f64 {
        self.between(&self.pace, s)
    }

    /// Rank of the road at an arc length.
    pub fn rank_at(&self, s: f64) -> u8 {
        self.rank[self.path.locate(s).0]
    }

    /// The cross section at an arc length.
    pub fn cross_section(&self, s: f64) -> CrossSection {
        let pose = self.path.pose_at(s);
        let (left, right) = self.half_widths_at(s);
        let (left, right) = (pose.ahead(0.0, left), pose.ahead(0.0, -right));
        CrossSection {
            x: pose.at.x,
            y: pose.at.y,
            left: [left.x, left.y],
            right: [right.x, right.y],
        }
    }

    /// Cross sections of the corridor from one arc length to another, m, in driving order and evenly at
    /// about 2 m; the stretch is cut at the ends of the route. At least two, whose reference points
    /// differ, when the stretch has a length. Source: `spec/3-stages.md#stage-ii-trajectory-to-map`.
    pub fn cross_sections(&self, from: f64, to: f64) -> Vec<CrossSection> {
        let length = self.path.length();
        let (from, to) = (from.clamp(0.0, length), to.clamp(0.0, length));
        let pieces = ((to - from) / 2.0).round().max(1.0);
        #[allow(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "a count of some hundreds"
        )]
        let count = pieces as u32;
        (0..=count)
            .map(|i| self.cross_section(from + (to - from) * f64::from(i) / pieces))
            .collect()
    }

    /// Whether a whole rectangle lies inside the corridor; its place on the route is looked for around `s`.
    pub fn holds(&self, rectangle: &Rectangle, s: f64) -> bool {
        let reach = rectangle.length + 10.0;
        corners(rectangle).into_iter().all(|corner| {
            let seen = self.path.project_within(corner, s - reach, s + reach);
            let (left, right) = self.half_widths_at(seen.s);
            -right <= seen.left && seen.left <= left
        })
    }

    /// Sets the pace from limits, bends and a comfortable deceleration before them.
    pub fn set_pace(&mut self) {
        let lengths = self.path.arc_lengths().to_vec();
        for (index, pace) in self.pace.iter_mut().enumerate() {
            let bend = self.path.curvature_at(lengths[index]).abs().max(1e-4);
            *pace = self.limits[index].min((A_LATERAL / bend).sqrt());
        }
        for index in (0..self.pace.len() - 1).rev() {
            let way = lengths[index + 1] - lengths[index];
            let after = self.pace[index + 1];
            self.pace[index] = self.pace[index].min((after * after + 2.0 * A_COMFORT * way).sqrt());
        }
    }

    /// Makes it a route of the ego: from a start to a zone of 14 m of the corridor around `target`, m.
    pub fn set_task(&mut self, start: f64, target: f64) {
        let pose = self.path.pose_at(target);
        self.task = Some(Task { start, target: Rectangle { pose, length: 14.0, width: 5.0 } });
    }

    fn between(&self, values: &[f64], s: f64) -> f64 {
        let (piece, share) = self.path.locate(s);
        values[piece] + (values[piece + 1] - values[piece]) * share
    }
}

/// The corners of a rectangle: front left, rear left, rear right, front right.
pub fn corners(rectangle: &Rectangle) -> [Point; 4] {
    let Rectangle { pose, length, width } = rectangle;
    let at =
        |pose: &Pose, ahead: f64, left: f64| pose.ahead(ahead * length / 2.0, left * width / 2.0);
    [at(pose, 1.0, 1.0), at(pose, -1.0, 1.0), at(pose, -1.0, -1.0), at(pose, 1.0, -1.0)]
}
