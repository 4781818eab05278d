//! ENV and TPL as one, wherever they run.

use mufasa::input::cycle::{Ego, TrackList, TrajectoryPoint};

use crate::map::route::Route;
use crate::services::env::{Situation, environment};
use crate::services::tpl;

/// A trajectory from now on, along a route, between the tracks and before the stop lines.
pub fn plan(
    now_ns: i64,
    ego: &Ego,
    near_s: Option<f64>,
    route: &Route,
    stops: &[f64],
    tracks: &TrackList<'_>,
) -> Vec<TrajectoryPoint> {
    let path = &route.path;
    let situation = Situation { now_ns, ego: *ego, path, near_s, stops };
    let model = environment(&situation, tracks);
    let settings = tpl::settings::Settings::default();
    tpl::trajectory(now_ns, ego, path, &model, &|s| route.limit_at(s), &settings)
}
