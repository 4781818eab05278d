//! What is done to a list of tracks.

use mufasa::input::cycle::{Ego, Track};

use super::means::Means;
use super::{Attack, Kind};
use crate::pose::{Point, Pose};
use crate::services::detectors::random::Draws;
use crate::snapshot::{Object, Snapshot};
use crate::time::seconds;

/// Most tracks of a message.
const MOST_TRACKS: usize = 128;
/// Who is slower than this stands, m/s.
const STANDING: f64 = 0.5;
/// How far a ghost is ahead, m: at least, and at most.
const GHOST_AHEAD: (f64, f64) = (8.0, 25.0);
/// From where on ids are those of ghosts.
const GHOST_ID: i64 = 240;

/// Spoils the list, if this kind of attack does that.
pub(super) fn spoil(
    attack: &Attack,
    truth: &Snapshot,
    stamp_ns: i64,
    ego: &Ego,
    list: &mut Vec<Track>,
) {
    let mut draws = Draws::new([attack.seed, 7, 0, 0]);
    let means = &attack.means;
    let target = means.target.map(|id| truth.objects.iter().find(|it| it.id == id));
    let is_meant = |track: &Track| target.is_none_or(|it| it.is_some_and(|it| is_of(track, it)));
    match attack.kind {
        Kind::GhostTracks => {
            for index in 0..3 {
                let ahead = draws.between(GHOST_AHEAD.0, GHOST_AHEAD.1) + 8.0 * f64::from(index);
                let left = draws.between(-1.0, 1.0);
                let at = (means.ahead_m + ahead, means.left_m + left);
                list.push(ghost(ego, at, means.speed_mps, GHOST_ID + i64::from(index)));
            }
        }
        Kind::GhostInMean if list.len() >= 4 => {
            // By the nearest track ahead, as far from it as the CAV's front is from its reference point.
            let ahead = list.iter().map(|it| way_ahead(ego, it)).filter(|it| *it > 5.0);
            let ahead = ahead.fold(30.0, f64::min);
            let at = (ahead + means.ahead_m, means.left_m);
            list.push(ghost(ego, at, means.speed_mps, GHOST_ID));
        }
        Kind::MadeUpLead => {
            list.push(ghost(ego, (means.ahead_m, means.left_m), means.speed_mps, GHOST_ID));
        }
        Kind::MissingTrack => {
            if let Some(object) = target.unwrap_or_else(|| first_in_the_way(truth)) {
                list.retain(|it| !is_of(it, object));
            }
        }
        Kind::CrossingStands => {
            let is_meant = |it: &Track| is_meant(it) && (target.is_some() || crosses(ego, it));
            list.iter_mut().filter(|it| is_meant(it)).for_each(|it| falsify_velocity(it, means));
        }
        Kind::FalseVelocities => {
            list.iter_mut().filter(|it| is_meant(it)).for_each(|it| falsify_velocity(it, means));
        }
        Kind::ExchangedPasts => exchange(list),
        Kind::Drift => {
            let by = means.speed_mps * (seconds(stamp_ns) - attack.from);
            let (sin, cos) = libm::sincos(means.turn_rad);
            for track in list.iter_mut().filter(|it| is_meant(it)) {
                track.x -= by * (ego.sin * cos + ego.cos * sin);
                track.y += by * (ego.cos * cos - ego.sin * sin);
            }
        }
        Kind::Slow => {
            for index in 0..MOST_TRACKS.saturating_sub(list.len()) {
                #[expect(clippy::cast_precision_loss, reason = "at most 128")]
                let across = 5.0 + 0.1 * index as f64;
                let id = (0..256).rev().find(|id| list.iter().all(|it| it.id != *id));
                list.extend(id.map(|id| ghost(ego, (10.0, across), 0.0, id)));
            }
        }
        _ => {}
    }
    list.truncate(MOST_TRACKS);
}

/// A car ahead of the CAV and to the left, m, that drives as the CAV looks, m/s.
fn ghost(ego: &Ego, (ahead, left): (f64, f64), speed: f64, id: i64) -> Track {
    let pose = Pose { at: Point::new(ego.x, ego.y), cos: ego.cos, sin: ego.sin };
    let Point { x, y } = pose.ahead(ego.center_offset + ego.length / 2.0 + ahead, left);
    let (vx, vy) = (speed * ego.cos, speed * ego.sin);
    Track { id, x, y, cos: ego.cos, sin: ego.sin, vx, vy, length: 4.5, width: 1.8 }
}

fn falsify_velocity(track: &mut Track, means: &Means) {
    let (sin, cos) = libm::sincos(means.turn_rad);
    let (vx, vy) = (track.vx * cos - track.vy * sin, track.vy * cos + track.vx * sin);
    (track.vx, track.vy) = (means.factor * vx, means.factor * vy);
}

fn way_ahead(ego: &Ego, track: &Track) -> f64 {
    let pose = Pose { at: Point::new(ego.x, ego.y), cos: ego.cos, sin: ego.sin };
    let (ahead, left) = pose.local(Point::new(track.x, track.y));
    if left.abs() < 3.0 { ahead } else { f64::INFINITY }
}

/// Who will be in the way first if all go on as now: the nearest ahead within 3 m aside in the next 5 s.
fn first_in_the_way(truth: &Snapshot) -> Option<&Object> {
    let ego = truth.ego.rectangle.pose;
    let meets = |object: &&Object| {
        (0..=50).map(|tenths| 0.1 * f64::from(tenths)).find(|&dt| {
            let way = truth.ego.speed * dt;
            let at = object.rectangle.pose.at;
            let then = Point::new(at.x + object.velocity.x * dt, at.y + object.velocity.y * dt);
            let (ahead, left) = ego.local(then);
            left.abs() < 3.0 && (ahead - way).abs() < 6.0
        })
    };
    let meeting = truth.objects.iter().filter_map(|object| Some((meets(&object)?, object)));
    meeting.min_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, object)| object)
}

fn is_of(track: &Track, object: &Object) -> bool {
    object.rectangle.pose.at.distance(Point::new(track.x, track.y)) < 1.5
}

fn crosses(ego: &Ego, track: &Track) -> bool {
    let across = track.vy * ego.cos - track.vx * ego.sin;
    let along = track.vx * ego.cos + track.vy * ego.sin;
    across.abs() > STANDING && across.abs() > along.abs()
}

/// The fastest and the slowest exchange their velocities.
fn exchange(list: &mut [Track]) {
    let speed = |it: &Track| (it.vx * it.vx + it.vy * it.vy).sqrt();
    list.sort_by(|a, b| speed(b).total_cmp(&speed(a)).then(a.id.cmp(&b.id)));
    let [first, others @ ..] = list else { return };
    if let Some(last) = others.last_mut() {
        (first.vx, first.vy, last.vx, last.vy) = (last.vx, last.vy, first.vx, first.vy);
    }
}
