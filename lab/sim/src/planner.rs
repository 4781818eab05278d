//! ENV and TPL as one, wherever they run.

use mufasa::input::cycle::{Ego, Track, TrackList, TrajectoryPoint};

use crate::map::Town;
use crate::map::route::Route;
use crate::pose::Point;
use crate::services::env::give_way::{Own, closed_lines};
use crate::services::env::{Situation, environment};
use crate::services::tpl;
use crate::time::seconds;

/// What the planner knows of the road.
#[derive(Clone, Copy, Debug)]
pub struct Road<'a> {
    /// The map, which says where others go first.
    pub town: &'a Town,
    /// The route that is to be driven.
    pub route: &'a Route,
    /// About where the CAV is on it, m; none: on a route that is not its own, where nobody is waited for.
    pub near_s: Option<f64>,
    /// Arc lengths of the stop lines whose signals say stop, m.
    pub signals: &'a [f64],
}

/// Shares of the present speed that more careful plans keep below.
const CAREFUL: [f64; 4] = [0.75, 0.5, 0.25, 0.0];

/// A trajectory from now on, along a route, between the tracks, before signals, and behind those of the
/// tracks that go first.
pub fn plan(
    now_ns: i64,
    ego: &Ego,
    road: &Road<'_>,
    tracks: &TrackList<'_>,
) -> Vec<TrajectoryPoint> {
    below(f64::INFINITY, now_ns, ego, road, tracks)
}

/// The same slower and slower, for who cannot take the plan; each is made when it is asked for.
pub fn slower(
    now_ns: i64,
    ego: &Ego,
    road: &Road<'_>,
    tracks: &TrackList<'_>,
) -> impl Iterator<Item = Vec<TrajectoryPoint>> {
    CAREFUL.into_iter().map(move |share| below(share * ego.speed, now_ns, ego, road, tracks))
}

/// A plan that is nowhere faster than this, m/s, from when it can be on.
fn below(
    speed: f64,
    now_ns: i64,
    ego: &Ego,
    road: &Road<'_>,
    tracks: &TrackList<'_>,
) -> Vec<TrajectoryPoint> {
    let Road { town, route, near_s, signals } = *road;
    let path = &route.path;
    let mut stops = signals.to_vec();
    if let Some(near) = near_s {
        let s = path.project_within(Point::new(ego.x, ego.y), near - 30.0, near + 30.0).s;
        let dt = seconds(now_ns - tracks.stamp_ns);
        let moved = |it: &Track| Track { x: it.x + it.vx * dt, y: it.y + it.vy * dt, ..*it };
        let now: Vec<Track> = tracks.items.iter().map(moved).collect();
        stops.extend(closed_lines(&Own { town, route, s, ego: *ego }, &now));
    }
    let situation = Situation { now_ns, ego: *ego, path, near_s, stops: &stops };
    let model = environment(&situation, tracks);
    tpl::trajectory(now_ns, ego, path, &model, &|s| route.limit_at(s).min(speed))
}
