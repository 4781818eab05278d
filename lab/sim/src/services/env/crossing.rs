//! Who will be in our way, if everybody goes straight on.

use mufasa::input::cycle::Track;

use crate::path::Path;
use crate::pose::Point;
use crate::services::env::model::{Crossing, Placed};

/// Looked ahead so far, s, in steps of ...
const HORIZON_S: f64 = 5.0;
const STEP_S: f64 = 0.25;

/// When and where a moving track is within `half_width`, m, of the path. One that comes towards us counts
/// only on the next `oncoming`, m, of it: farther on, any bend would bring it onto our lane.
pub(super) fn will_cross(
    path: &Path,
    track: &Track,
    placed: &Placed,
    s: f64,
    half_width: f64,
    oncoming: f64,
) -> Option<Crossing> {
    let farthest = if placed.along < -placed.across.abs() { oncoming } else { f64::INFINITY };
    let speed = Point::default().distance(Point::new(track.vx, track.vy));
    let reach = speed * STEP_S + 3.0;
    let mut found: Option<Crossing> = None;
    let (mut at_s, mut t) = (s, 0.0);
    while t <= HORIZON_S {
        let at = Point::new(track.x + track.vx * t, track.y + track.vy * t);
        let middle = path.project_within(at, at_s - reach, at_s + reach);
        let moved = middle.s - s;
        let [half_length, half_across] = half_sizes(path, track, middle.s);
        let ahead = placed.ahead + moved;
        if middle.left.abs() <= half_across + half_width && ahead - half_length <= farthest {
            let [near, far] = [ahead - half_length, ahead + half_length];
            let before = found.unwrap_or(Crossing { time: [t, t], ways: [near, far] });
            let ways = [before.ways[0].min(near), before.ways[1].max(far)];
            found = Some(Crossing { time: [before.time[0], t], ways });
        } else if found.is_some() {
            break;
        }
        at_s = middle.s;
        t += STEP_S;
    }
    found
}

/// Half of what a track covers along and across the path at an arc length, m.
pub(super) fn half_sizes(path: &Path, track: &Track, s: f64) -> [f64; 2] {
    let direction = path.pose_at(s);
    let along = (track.cos * direction.cos + track.sin * direction.sin).abs();
    let aside = (track.sin * direction.cos - track.cos * direction.sin).abs();
    let (length, width) = (track.length / 2.0, track.width / 2.0);
    [along * length + aside * width, aside * length + along * width]
}
