//! The cycle that the monitor is asked about at a time of a scene.

use mufasa::input::cycle::{
    CrossSection, Cycle, Detection, DetectionList, Ego, Lead, Route, Track, TrackList, Trajectory,
    TrajectoryPoint,
};
use mufasa::input::parameters::Parameters;
use mufasa::input::profile::Profile;
use mufasa::services::configuration::Configuration;

use super::kinds::{Lie, Remote};
use super::scene::{Body, FARTHEST, Moved, Scene};
use super::way::MARGIN;
use crate::pose::{Point, Pose, Rectangle};
use crate::services::detectors::random::Draws;

/// The time at the start of a scene, ns.
const START_NS: i64 = 10_000_000_000;
/// Between two cycles, and two points of a trajectory, s.
pub(super) const PERIOD_S: f64 = 0.1;
/// Ages of the earlier detections, cycles.
const AGES: [i32; 3] = [3, 5, 8];
/// Between two cross sections, and from the reference path to either boundary, m.
const SPACING: f64 = 2.0;
const HALF_WIDTH: f64 = 12.0;
/// Somebody far away who stands, so that no list is empty, and its id; that of the other.
const FAR: Rectangle = Rectangle {
    pose: Pose { at: Point::new(-80.0, -80.0), cos: 1.0, sin: 0.0 },
    length: 4.0,
    width: 2.0,
};
const FAR_ID: i64 = 9;
const OTHER_ID: i64 = 1;

/// The time of a cycle, s.
pub(super) fn time(cycle: i32) -> f64 {
    f64::from(cycle) * PERIOD_S
}

/// What of the cycles of a scene does not change.
pub(super) struct Asked<'s> {
    scene: &'s Scene,
    profile: Profile,
    parameters: Parameters,
    sections: Vec<CrossSection>,
}

impl<'s> Asked<'s> {
    pub(super) fn new(scene: &'s Scene, profile: Profile, parameters: Parameters) -> Self {
        let end = scene.way.reference(scene.pace.at(scene.meeting + 12.0).0) + MARGIN;
        let mut at = -MARGIN;
        let mut sections = Vec::new();
        while at < end {
            let [middle, left, right] =
                [0.0, HALF_WIDTH, -HALF_WIDTH].map(|aside| scene.way.beside(at, aside, 0.0).at);
            let (left, right) = ([left.x, left.y], [right.x, right.y]);
            sections.push(CrossSection { x: middle.x, y: middle.y, left, right });
            at += SPACING;
        }
        Self { scene, profile, parameters, sections }
    }

    /// Asks about the cycle with this number.
    pub(super) fn ask<A>(&self, number: i32, asked: &mut impl FnMut(&Cycle<'_>) -> A) -> A {
        let scene = self.scene;
        let now_ns = nanoseconds(time(number));
        let (points, tracks) = (self.points(number), self.tracks(number));
        let detections = self.scan(number);
        let before = AGES.map(|age| self.scan(number - age));
        let history: Vec<DetectionList<'_>> = AGES
            .iter()
            .zip(&before)
            .map(|(age, items)| {
                let stamp_ns = nanoseconds(time(number - age));
                DetectionList { stamp_ns, items }
            })
            .collect();
        asked(&Cycle {
            profile: self.profile,
            parameters: self.parameters,
            now_ns,
            configuration: match scene.kinds.remote {
                Remote::Mot => Configuration::MotRemote,
                Remote::Plan => Configuration::PlanRemote,
                Remote::All => Configuration::AllRemote,
            },
            ego: self.ego(number),
            trajectory: Some(Trajectory { stamp_ns: now_ns, points: &points }),
            tracks: Some(TrackList { stamp_ns: now_ns, items: &tracks }),
            detections: Some(DetectionList { stamp_ns: now_ns, items: &detections }),
            lead: self.lead(number, now_ns),
            route: Route { closed: false, cross_sections: &self.sections },
            grid: None,
            detection_history: &history,
        })
    }

    fn ego(&self, number: i32) -> Ego {
        let (driven, speed) = self.scene.pace.at(time(number));
        let Pose { at: Point { x, y }, cos, sin } = self.scene.way.pose(driven, (0.0, 0.0));
        let Body { length, width, center_offset } = self.scene.body;
        Ego { x, y, cos, sin, speed, length, width, center_offset }
    }

    fn points(&self, number: i32) -> Vec<TrajectoryPoint> {
        let scene = self.scene;
        let Moved { ahead, ahead_s, later, aside, turned, fades } = scene.moved;
        let now = time(number);
        let (start, speed) = scene.pace.at(now);
        let ahead = (ahead + ahead_s * speed).min(FARTHEST);
        let mut points = Vec::new();
        let mut index = 0;
        while time(index) <= scene.plan {
            let way = scene.pace.at(now + time(index)).0 - start;
            // Critically damped: comes back to the way without swinging.
            let fading = libm::exp(-way / fades);
            let slope = turned + aside / fades;
            let offset = (aside + slope * way) * fading;
            let offset = (offset, slope * fading - offset / fades);
            let Pose { at: Point { x, y }, cos, sin } = scene.way.pose(start + ahead + way, offset);
            let t_ns = nanoseconds(now + later + time(index));
            points.push(TrajectoryPoint { t_ns, x, y, cos, sin });
            index += 1;
        }
        points
    }

    fn scan(&self, number: i32) -> Vec<Detection> {
        let Rectangle { pose, length, width } = self.scene.object(time(number));
        let [x, y] = self.noise(number);
        let mut other = detection(pose, length, width);
        (other.x, other.y) = (other.x + x, other.y + y);
        vec![detection(FAR.pose, FAR.length, FAR.width), other]
    }

    /// Of a scan, the same whenever it is asked for, m.
    fn noise(&self, number: i32) -> [f64; 2] {
        let Scene { noise, seed, .. } = self.scene;
        // Earlier than the start by no more than the greatest age.
        let number = u64::try_from(number + AGES[2]).unwrap_or(0);
        Draws::new([seed[0], seed[1], 22, number]).normal_pair().map(|it| it * noise)
    }

    fn tracks(&self, number: i32) -> Vec<Track> {
        let scene = self.scene;
        let t = time(number);
        let mut tracks = vec![track(FAR_ID, FAR, [0.0; 2])];
        let mut rectangle = scene.object(t);
        let [vx, vy] = scene.other.velocity(&scene.way, t);
        let mut velocity = [vx, vy];
        match scene.kinds.lie {
            Lie::LeftOut => return tracks,
            Lie::True => {}
            Lie::Stands => velocity = [0.0; 2],
            Lie::Velocity => {
                let [cos, sin, factor] = scene.velocity;
                velocity = [vx * cos - vy * sin, vx * sin + vy * cos].map(|it| it * factor);
            }
            Lie::Size => {
                rectangle.length *= scene.size;
                rectangle.width *= scene.size;
            }
        }
        tracks.push(track(OTHER_ID, rectangle, velocity));
        tracks
    }

    /// The leading vehicle along a straight way; in a bend the nearest to its chord.
    fn lead(&self, number: i32, stamp_ns: i64) -> Option<Lead> {
        let scene = self.scene;
        if !scene.has_lead {
            return None;
        }
        let t = time(number);
        let (cav, other) = (scene.cav(t), scene.object(t));
        let gap = crate::collision::distance(&cav, &other);
        let [vx, vy] = scene.other.velocity(&scene.way, t);
        let speed = (vx * other.pose.cos + vy * other.pose.sin).max(0.0);
        Some(Lead { stamp_ns, gap, speed })
    }
}

fn detection(pose: Pose, length: f64, width: f64) -> Detection {
    let Pose { at: Point { x, y }, cos, sin } = pose;
    Detection { x, y, cos, sin, length, width }
}

fn track(id: i64, rectangle: Rectangle, [vx, vy]: [f64; 2]) -> Track {
    let Rectangle { pose: Pose { at: Point { x, y }, cos, sin }, length, width } = rectangle;
    Track { id, x, y, cos, sin, vx, vy, length, width }
}

fn nanoseconds(t: f64) -> i64 {
    #[expect(clippy::cast_possible_truncation, reason = "seconds of a scene")]
    let after = (t * 1e9).round() as i64;
    START_NS + after
}
