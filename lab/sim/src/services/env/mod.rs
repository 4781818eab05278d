//! ENV: what the tracks mean for somebody who drives along a path.
//!
//! A stand-in for the paper's environment model: tracks in coordinates of the path, the leading vehicle,
//! and those who will cross. It cannot show intentions: everybody goes on straight on, so that an oncoming
//! vehicle in a bend is expected on our lane (it is looked for on the next metres only, as far as stage iii
//! looks), and one that is about to turn is not seen to.

mod crossing;
pub mod give_way;
pub mod model;

use mufasa::input::cycle::{Ego, Track, TrackList};

use crate::path::Path;
use crate::pose::{Point, Pose};
use crate::services::env::crossing::{half_sizes, will_cross};
use crate::services::env::model::{Environment, Leading, Placed};
use crate::time::seconds;

/// Who drives where, and when.
#[derive(Clone, Copy, Debug)]
pub struct Situation<'a> {
    /// Now, ns.
    pub now_ns: i64,
    /// The CAV now.
    pub ego: Ego,
    /// The path that it is to drive.
    pub path: &'a Path,
    /// About where it is on it, m, within 30 m; none: wherever the path is nearest.
    pub near_s: Option<f64>,
    /// Arc lengths at which it is to stop, m: before signals, and where others come first (`give_way`).
    pub stops: &'a [f64],
}

/// Looked at: objects nearer than this, m.
const RANGE_M: f64 = 90.0;
/// The corridor is the width of the CAV and this on each side, m: for leading vehicles ...
const LEAD_MARGIN_M: f64 = 0.3;
/// ... and for those that cross.
const CROSSING_MARGIN_M: f64 = 0.5;
/// Slower than this, m/s, an object stands.
const STANDING_MPS: f64 = 0.5;
/// Who comes towards us is looked for as far as `s_CAV` (`spec/3-stages.md#distances`), s at the present
/// speed, and this way, m: stage iii would find it there.
const SAFETY_TIME_S: f64 = 1.8;
const ONCOMING_M: f64 = 4.0;
/// Who will be in front of us within this time, s, leads already.
const CUT_IN_S: f64 = 2.0;

/// The environment model of a list of tracks, which go on as they did until now.
pub fn environment(situation: &Situation<'_>, tracks: &TrackList<'_>) -> Environment {
    let Situation { ego, path, .. } = *situation;
    let place = Point::new(ego.x, ego.y);
    let own = situation
        .near_s
        .map_or_else(|| path.project(place), |s| path.project_within(place, s - 30.0, s + 30.0));
    let along = path.pose_at(own.s);
    let aside =
        (ego.sin * along.cos - ego.cos * along.sin, ego.cos * along.cos + ego.sin * along.sin);
    let mut model = Environment {
        s: own.s,
        left: own.left,
        aside,
        lead: None,
        crossings: Vec::new(),
        stops: stops(situation, own.s),
    };
    let dt = seconds(situation.now_ns - tracks.stamp_ns);
    for track in tracks.items {
        let at = Point::new(track.x + track.vx * dt, track.y + track.vy * dt);
        if at.distance(place) <= RANGE_M {
            model.add(situation, &Track { x: at.x, y: at.y, ..*track });
        }
    }
    model
}

impl Environment {
    fn add(&mut self, situation: &Situation<'_>, track: &Track) {
        let Situation { ego, path, .. } = *situation;
        let at = Point::new(track.x, track.y);
        let middle = path.project_within(at, self.s - RANGE_M, self.s + RANGE_M);
        let placed = placed(path, self.s, track, middle.s, middle.left);
        let front = ego.center_offset + ego.length / 2.0;
        let in_lane = ego.width / 2.0 + LEAD_MARGIN_M;
        let inside = placed.left.abs() <= placed.half_width + in_lane;
        let is_ahead = placed.ahead > front;
        let goes_across = placed.across.abs() > placed.along.abs().max(STANDING_MPS);
        if inside && !goes_across {
            if is_ahead {
                self.leads(&placed);
            }
            return;
        }
        if placed.along.abs().max(placed.across.abs()) < STANDING_MPS {
            return;
        }
        let half_width = ego.width / 2.0 + CROSSING_MARGIN_M;
        let oncoming = front + SAFETY_TIME_S * ego.speed + ONCOMING_M;
        let Some(crossing) = will_cross(path, track, &placed, middle.s, half_width, oncoming)
        else {
            return;
        };
        let cuts_in = !goes_across && placed.along > 0.0;
        if cuts_in && is_ahead && crossing.time[0] <= CUT_IN_S {
            self.leads(&placed);
        } else if crossing.ways[1] > front && !cuts_in {
            self.crossings.push(crossing);
        }
    }

    /// The nearest one leads.
    fn leads(&mut self, placed: &Placed) {
        let ahead = placed.ahead - placed.half_length;
        if self.lead.is_none_or(|lead| ahead < lead.ahead) {
            self.lead = Some(Leading { ahead, speed: placed.along.max(0.0) });
        }
    }
}

/// A track beside an arc length of the path.
fn placed(path: &Path, from: f64, track: &Track, s: f64, left: f64) -> Placed {
    let Pose { cos, sin, .. } = path.pose_at(s);
    let [half_length, half_width] = half_sizes(path, track, s);
    Placed {
        ahead: s - from,
        left,
        half_length,
        half_width,
        along: track.vx * cos + track.vy * sin,
        across: track.vy * cos - track.vx * sin,
    }
}

/// Where to stop: what the map says, if it is ahead of the front, and the end of the path.
fn stops(situation: &Situation<'_>, s: f64) -> Vec<f64> {
    let Situation { ego, path, .. } = *situation;
    let front = ego.center_offset + ego.length / 2.0;
    let ways = situation.stops.iter().map(|&stop| stop - s);
    let mut stops: Vec<f64> = ways.filter(|&way| way > front).collect();
    stops.push(path.length() - s);
    stops.sort_by(f64::total_cmp);
    stops
}
