//! The comparisons that no witness names, because they decide what is compared at all: which tracks
//! are in the field of view (stage i), and on which side of an edge of the corridor a point lies
//! (stage ii). In doubles: this is a hint for a reader, and decides nothing.

use mufasa_model::cycle::check;
use mufasa_model::input::cycle::{CrossSection, Cycle, Track};
use mufasa_model::input::profile::HardenedRule;
use mufasa_model::report::{FailedStage, Reading, Stage};

/// Farther from its threshold than this a comparison is not looked at, m: the most that `delta` may be.
const FARTHEST_M: f64 = 1e-2;

/// Beyond a threshold that lies within rounding, m.
const BEYOND_M: f64 = 1e-9;

/// A comparison near its threshold, without which the verdict would be another.
#[derive(Clone, Debug, PartialEq)]
pub struct Edge {
    /// The comparison in words.
    pub what: String,
    /// Both sides, m.
    pub compared: [f64; 2],
}

impl Edge {
    /// How far both sides are apart, m.
    pub fn margin_m(&self) -> f64 {
        (self.compared[0] - self.compared[1]).abs()
    }
}

/// Of the comparisons at the edge of the field of view and of the corridor the one nearest to its
/// threshold that, decided the other way, makes the model answer what was `said`.
pub fn nearest(cycle: &Cycle, said: Option<FailedStage>) -> Option<Edge> {
    let exact = check(cycle, Reading::Exact).ok()?.failed_stage;
    let is_about = |stage| [exact, said].contains(&Some(FailedStage::Stage(stage)));
    let flips = |other: &Cycle| {
        check(other, Reading::Exact).is_ok_and(|report| report.failed_stage == said)
    };
    let mut edges = Vec::new();
    if is_about(Stage::I) {
        edges.extend(field_of_view(cycle));
    }
    if is_about(Stage::Ii) {
        edges.extend(corridor(cycle));
    }
    edges.retain(|(edge, _)| edge.margin_m() <= FARTHEST_M);
    edges.sort_by(|(a, _), (b, _)| a.margin_m().total_cmp(&b.margin_m()));
    edges.into_iter().find(|(_, others)| others.iter().any(flips)).map(|(edge, _)| edge)
}

/// A comparison, and the cycle with it decided the other way, in the ways to do so.
type Candidate = (Edge, Vec<Cycle>);

/// The place of each track against r, moved across.
fn field_of_view(cycle: &Cycle) -> Vec<Candidate> {
    let (Some(tracks), Some(detections)) = (&cycle.tracks, &cycle.detections) else {
        return Vec::new();
    };
    let from_p = |x: f64, y: f64| (x - cycle.ego.x).hypot(y - cycle.ego.y);
    let r = detections.items.iter().map(|it| from_p(it.x, it.y)).fold(0.0, f64::max);
    // H-01 takes the place of a track where it has come to since its stamp.
    let dt_s = if cycle.profile.has(HardenedRule::H01) {
        seconds(detections.stamp_ns) - seconds(tracks.stamp_ns)
    } else {
        0.0
    };
    let candidate = |(at, track): (usize, &Track)| {
        let (x, y) = (track.x + track.vx * dt_s, track.y + track.vy * dt_s);
        let distance = from_p(x, y);
        let what =
            format!("whether track {} is in the field of view (distance to p <= r)", track.id);
        let moved = across(r - distance).map(|by| {
            let mut cycle = cycle.clone();
            if let Some(track) = cycle.tracks.as_mut().and_then(|list| list.items.get_mut(at)) {
                track.x += by * (x - cycle.ego.x) / distance;
                track.y += by * (y - cycle.ego.y) / distance;
            }
            cycle
        });
        (Edge { what, compared: [distance, r] }, moved.to_vec())
    };
    tracks.items.iter().enumerate().map(candidate).collect()
}

/// Each point of the trajectory against the left and the right edge of the corridor, the edge moved
/// across.
fn corridor(cycle: &Cycle) -> Vec<Candidate> {
    let points = cycle.trajectory.as_ref().map_or(&[][..], |it| &it.points);
    let mut candidates = Vec::new();
    for (side, name) in [(Side::Left, "left"), (Side::Right, "right")] {
        for (at, point) in points.iter().enumerate() {
            let (distance, normal) = nearest_edge(cycle, side, [point.x, point.y]);
            let what = format!(
                "whether point {at} is inside the {name} edge of the corridor, by its distance to it"
            );
            // The edge where it can be moved as a whole, else the point.
            let edge = |by| {
                let mut cycle = cycle.clone();
                cycle.route.cross_sections.iter_mut().for_each(|it| side.widen(it, by));
                cycle
            };
            let point = |by: f64| {
                let mut cycle = cycle.clone();
                let points = cycle.trajectory.as_mut().map(|it| &mut it.points);
                if let Some(point) = points.and_then(|it| it.get_mut(at)) {
                    (point.x, point.y) = (point.x + by * normal[0], point.y + by * normal[1]);
                }
                cycle
            };
            let [out, back] = across(distance);
            // A corridor without a width is met only exactly.
            let ways = [out, back, distance, -distance].map(point);
            let moved = [edge(out), edge(back)].into_iter().chain(ways).collect();
            candidates.push((Edge { what, compared: [distance, 0.0] }, moved));
        }
    }
    candidates
}

/// Ways to a threshold and beyond, from either side.
fn across(distance_m: f64) -> [f64; 2] {
    let beyond = 2.0 * distance_m.abs() + BEYOND_M;
    [beyond, -beyond]
}

#[derive(Clone, Copy)]
enum Side {
    Left,
    Right,
}

impl Side {
    /// A corner of the corridor.
    fn of(self, it: &CrossSection) -> [f64; 2] {
        match self {
            Self::Left => it.left,
            Self::Right => it.right,
        }
    }

    /// Moves a corner away from the other one.
    fn widen(self, it: &mut CrossSection, by_m: f64) {
        let (corner, [x, y]) = match self {
            Self::Left => (&mut it.left, it.right),
            Self::Right => (&mut it.right, it.left),
        };
        let width = (corner[0] - x).hypot(corner[1] - y);
        let [dx, dy] = [corner[0] - x, corner[1] - y];
        *corner = [corner[0] + by_m * dx / width, corner[1] + by_m * dy / width];
    }
}

/// From a point to an edge of the corridor, m, and the direction across the edge there; infinite when
/// there is none.
fn nearest_edge(cycle: &Cycle, side: Side, [x, y]: [f64; 2]) -> (f64, [f64; 2]) {
    let corners: Vec<[f64; 2]> = cycle.route.cross_sections.iter().map(|it| side.of(it)).collect();
    let closing = corners.last().zip(corners.first()).filter(|_| cycle.route.closed);
    let pairs = corners.windows(2).map(|pair| (pair[0], pair[1]));
    let to = |([ax, ay], [bx, by]): ([f64; 2], [f64; 2])| {
        let (dx, dy) = (bx - ax, by - ay);
        let square = dx * dx + dy * dy;
        let along = ((x - ax) * dx + (y - ay) * dy) / square;
        // Of an edge without a length the corner.
        let along = if along > 0.0 { along.min(1.0) } else { 0.0 };
        let distance = (x - ax - along * dx).hypot(y - ay - along * dy);
        (distance, [-dy / square.sqrt(), dx / square.sqrt()])
    };
    let all = pairs.chain(closing.map(|(a, b)| (*a, *b))).map(to);
    all.min_by(|a, b| a.0.total_cmp(&b.0)).unwrap_or((f64::INFINITY, [0.0; 2]))
}

#[allow(clippy::cast_precision_loss, reason = "a hint: some nanoseconds do not matter")]
fn seconds(t_ns: i64) -> f64 {
    t_ns as f64 / 1e9
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cases::question::Question;

    /// A cycle of the paper profile with these parts.
    fn cycle(parts: &str) -> Cycle {
        let line = format!(
            r#"{{"kind": "cycle", "id": "x", "profile": "paper", "parameters": {{}}, "now_ns": 1000000000,
            "ego": {{"x": 0, "y": 0, "cos": 1, "sin": 0, "speed": 0, "length": 4.8, "width": 1.9, "center_offset": 1.4}},
            "lead": null, "grid": null, "route": {{"closed": false, "stations": [
            {{"x": 0, "y": 0, "left": [0, 2], "right": [0, -2]}},
            {{"x": 100, "y": 0, "left": [100, 2], "right": [100, -2]}}]}}, {parts}}}"#
        );
        match Question::of_line(&line.replace('\n', " ")) {
            Some(Question::Cycle(cycle)) => *cycle,
            other => panic!("{other:?}: {line}"),
        }
    }

    const I: Option<FailedStage> = Some(FailedStage::Stage(Stage::I));
    const II: Option<FailedStage> = Some(FailedStage::Stage(Stage::Ii));

    /// The farthest detection is 30 m away; track 7 is there, and 10 m from any detection.
    #[test]
    fn a_track_at_the_edge_of_the_field_of_view_is_named() {
        let with = |y: f64| {
            cycle(&format!(
                r#""configuration": "MotRemote", "trajectory": null,
                "tracks": {{"stamp_ns": 1000000000, "items": [
                {{"id": 7, "x": 0, "y": {y}, "cos": 1, "sin": 0, "vx": 0, "vy": 0, "length": 4, "width": 2}}]}},
                "detections": {{"stamp_ns": 1000000000, "items": [
                {{"x": 30, "y": 0, "cos": 1, "sin": 0, "length": 4, "width": 2}}]}}"#
            ))
        };
        let named = |y: f64, said| {
            nearest(&with(y), said).map(|it| (it.what.contains("track 7"), it.compared))
        };
        let within = |y: f64| check(&with(y), Reading::Exact).expect("valid").failed_stage == I;
        assert!(within(30.0) && !within(30.000_001));
        assert_eq!(named(30.0, None), Some((true, [30.0, 30.0])));
        assert_eq!(named(30.000_001, I), Some((true, [30.000_001, 30.0])));
        assert_eq!(named(29.9, None), None, "too far from it");
        assert_eq!(named(30.0, II), None, "it would not make stage ii fail");
    }

    /// The corridor reaches to 2 m on the left; `theta_map` is far from deciding.
    #[test]
    fn a_point_at_an_edge_of_the_corridor_is_named() {
        let with = |y: f64| {
            cycle(&format!(
                r#""configuration": "PlanRemote", "tracks": null, "detections": null,
                "trajectory": {{"stamp_ns": 1000000000, "points": [
                {{"t_ns": 1000000000, "x": 5, "y": {y}, "cos": 1, "sin": 0}}]}}"#
            ))
        };
        let out = 2.0_f64.next_up();
        let fails = |y: f64| check(&with(y), Reading::Exact).expect("valid").failed_stage == II;
        assert!(fails(out) && !fails(2.0));
        let named = |y: f64, said| {
            nearest(&with(y), said).map(|it| it.what.contains("point 0 is inside the left edge"))
        };
        assert_eq!(named(out, None), Some(true));
        assert_eq!(named(2.0, II), Some(true));
        assert_eq!(named(2.1, None), None, "too far from it");
        assert_eq!(named(2.0, I), None, "it would not make stage i fail");
        // An edge that cannot be widened: on both of its cross sections left is right.
        let mut flat = with(1e-10);
        flat.route
            .cross_sections
            .iter_mut()
            .for_each(|it| (it.y, it.left[1], it.right[1]) = (9.0, 0.0, 0.0));
        assert!(nearest(&flat, None).is_some_and(|it| it.what.contains("point 0")));
    }
}
