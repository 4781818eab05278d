//! Where to wait because others come: the map says who goes first, the tracks alone say who comes.
//!
//! A stand-in for gap acceptance: a track on a route that meets ours is expected to go on at its speed along
//! that route; who stands is not expected to go. It cannot show intentions: a vehicle that will turn off or
//! stop is waited for like one that comes.

use mufasa::input::cycle::{Ego, Track};

use crate::map::Town;
use crate::map::route::{Conflict, Passage, Route, RouteKind};
use crate::pose::{Point, Pose};
use crate::services::tpl::settings::ACCELERATION;

/// Passages are looked at up to this way ahead of the front, m, and their others up to this way before the
/// place where they meet us, and `ON_ROUTE` more.
const LOOKED_M: (f64, f64) = (80.0, 120.0);
/// A track is on a route when it is so near to it, m, and goes about along it (cosine).
const ON_ROUTE: (f64, f64) = (2.0, 0.7);
/// Slower than this, m/s, nobody comes.
const STANDING_MPS: f64 = 0.5;
/// Time kept before and after others, s.
const MARGIN_S: f64 = 1.5;
/// Who has to wait for us and would have to brake harder than this for it does not, m/s^2.
const A_WAITS: f64 = 3.0;
/// A line at which the CAV would have to brake harder than this for is passed, m/s^2.
const A_COMMITTED: f64 = 5.0;
/// Slower than this, m/s, somebody behind a passage leaves no room, in a way of this on top of our length, m.
const FULL: (f64, f64) = (2.0, 2.0);

/// The CAV on its route.
#[derive(Clone, Copy, Debug)]
pub struct Own<'a> {
    /// The map, with all routes.
    pub town: &'a Town,
    /// The route that is driven; one of the map's.
    pub route: &'a Route,
    /// Place of the reference point on it, m.
    pub s: f64,
    /// The CAV.
    pub ego: Ego,
}

impl Own<'_> {
    fn front(&self) -> f64 {
        self.s + self.ego.center_offset + self.ego.length / 2.0
    }

    /// Time until the front has gone a way, accelerating, s.
    fn time_to(&self, way: f64) -> f64 {
        let (a, v) = (ACCELERATION, self.ego.speed);
        let top = self.route.pace_at(self.front()).max(v).max(1.0);
        let speeding = (top * top - v * v) / (2.0 * a);
        if way < speeding {
            ((v * v + 2.0 * a * way.max(0.0)).sqrt() - v) / a
        } else {
            (top - v) / a + (way - speeding) / top
        }
    }
}

/// Arc lengths of the stop lines ahead that the tracks, at their places of now, leave no gap behind, m.
pub fn closed_lines(own: &Own<'_>, tracks: &[Track]) -> Vec<f64> {
    let (front, speed) = (own.front(), own.ego.speed);
    let is_ahead = |passage: &Passage| {
        let room = passage.from - front;
        room > speed * speed / (2.0 * A_COMMITTED) && room < LOOKED_M.0
    };
    let passages = own.route.passages.iter().enumerate().filter(|(_, it)| is_ahead(it));
    passages
        .filter(|(index, passage)| {
            let first = own.route.conflicts.partition_point(|it| it.passage < *index);
            let met = own.route.conflicts[first..].iter().take_while(|it| it.passage == *index);
            is_full(own, passage, tracks) || met.clone().any(|it| is_taken(own, it, tracks))
        })
        .map(|(_, passage)| passage.from)
        .collect()
}

/// Whether somebody slow stands in our lane within a passage or so near behind it that we would stay in it.
fn is_full(own: &Own<'_>, passage: &Passage, tracks: &[Track]) -> bool {
    let reach = passage.to + own.ego.length + FULL.1;
    tracks.iter().any(|track| {
        let Some((s, along)) = on(own.route, track, passage.from, reach + 6.0) else {
            return false;
        };
        let rear = s - track.length / 2.0;
        s > passage.from && rear < reach && along < FULL.0
    })
}

/// Whether a track is where a conflict is, or will be when the CAV is there.
fn is_taken(own: &Own<'_>, conflict: &Conflict, tracks: &[Track]) -> bool {
    let other = &own.town.routes[conflict.with];
    let front = own.front();
    let ours = (
        own.time_to(conflict.here.0 - front),
        own.time_to(conflict.here.1 + own.ego.length - front),
    );
    tracks.iter().any(|track| {
        let (from, to) = conflict.there;
        let Some((s, along)) = on(other, track, from - LOOKED_M.1, to + 10.0) else { return false };
        let half = track.length / 2.0;
        let (room, rest) = (from - (s + half), to - (s - half));
        if rest < 0.0 {
            return false;
        }
        let people = other.kind != RouteKind::Road;
        if room > 0.0 && along < STANDING_MPS {
            return false;
        }
        let waits = !conflict.gives_way && !people && along * along / (2.0 * A_WAITS) < room;
        let speed = along.max(STANDING_MPS);
        let theirs = (room / speed, rest / speed);
        !waits && theirs.0 < ours.1 + MARGIN_S && ours.0 < theirs.1 + MARGIN_S
    })
}

/// Where on a stretch of a route a track is, m, and its speed along it, m/s, if it is on it.
fn on(route: &Route, track: &Track, from: f64, to: f64) -> Option<(f64, f64)> {
    let at = Point::new(track.x, track.y);
    let seen = route.path.project_near(at, from.max(0.0), to.max(0.0), ON_ROUTE.0)?;
    let Pose { cos, sin, .. } = route.path.pose_at(seen.s);
    let along = track.vx * cos + track.vy * sin;
    let goes = if along.abs() > STANDING_MPS {
        let speed = Point::default().distance(Point::new(track.vx, track.vy));
        along / speed
    } else {
        track.cos * cos + track.sin * sin
    };
    (goes > ON_ROUTE.1).then_some((seen.s, along))
}
