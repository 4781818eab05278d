//! What an attacker says of single objects: which of them is left out, stands, or was elsewhere.

use mufasa_model::input::cycle::{Cycle, Track};

use crate::geometry::{Point, Polyline, add, cross, distance, dot, norm, scale, sub};
use crate::seconds;

/// Slower than this an object stands, m/s.
const MOVING: f64 = 1.0;
/// A ghost at a past place needs an object that has left it since, m/s.
const LEAVING: f64 = 4.0;
/// How long ago the pasts are that are exchanged, and the places of ghosts, s.
const AGO_S: f64 = 0.5;
/// How much faster the objects of `VelocityBias` are, m/s: within `theta_velocity` and
/// `theta_track_max` up to 1 s.
const BIAS: f64 = 3.0;
/// How much farther something is when it is aside, not ahead.
const ASIDE: f64 = 4.0;
/// The id of the ghost at a past place.
const GHOST: i64 = -4;

/// The track with this id, or else, of those that are `wanted`, the one nearest ahead of the CAV
/// while both go on, a metre aside counting as four ahead; the first of several.
pub(super) fn target(
    cycle: &Cycle,
    known: Option<i64>,
    wanted: impl Fn(&Track) -> bool,
) -> Option<Track> {
    let (tracks, trajectory) = (cycle.tracks.as_ref()?, cycle.trajectory.as_ref()?);
    if let Some(track) = tracks.items.iter().find(|it| Some(it.id) == known) {
        return Some(track.clone());
    }
    let far = |track: &Track| {
        let at = trajectory.points.iter().map(|point| {
            let later = seconds(tracks.stamp_ns, point.t_ns);
            let there = add(place(track), scale(velocity(track), later));
            let (off, heading) = (sub(there, [point.x, point.y]), [point.cos, point.sin]);
            let (ahead, aside) = (dot(heading, off), cross(heading, off).abs());
            if ahead >= 0.0 { ahead + ASIDE * aside } else { f64::INFINITY }
        });
        at.fold(f64::INFINITY, f64::min)
    };
    let wanted = tracks.items.iter().filter(|it| wanted(it));
    wanted.min_by(|a, b| far(a).total_cmp(&far(b))).cloned()
}

/// The same list without a track.
pub(super) fn leave_out(cycle: &mut Cycle, left_out: &Track) {
    each_track(cycle, |it| (it.id != left_out.id).then(|| it.clone()));
}

/// Stops what crosses the reference path, more across than along.
pub(super) fn stop_crossing(cycle: &mut Cycle) {
    let mut points: Vec<Point> = cycle.route.cross_sections.iter().map(|s| [s.x, s.y]).collect();
    if cycle.route.closed {
        points.extend(points.first().copied());
    }
    let path = Polyline::new(points);
    let crosses = |track: &Track| {
        let v = velocity(track);
        let along = path.project(place(track)).map_or([0.0, 0.0], |foot| foot.tangent);
        norm(v) >= MOVING && cross(along, v).abs() > dot(along, v).abs()
    };
    each_track(cycle, |it| Some(if crosses(it) { moving(it, [0.0, 0.0]) } else { it.clone() }));
}

/// Gives a track and the one nearest to it velocities as if each had been, half a second ago,
/// where the other was.
pub(super) fn exchange_pasts(cycle: &mut Cycle, one: &Track) {
    let Some(other) = nearest(cycle, one) else { return };
    let [first, second] = [from_past(one, &other), from_past(&other, one)];
    let Some(list) = &mut cycle.tracks else { return };
    for it in &mut list.items {
        if it.id == one.id {
            *it = moving(it, first);
        } else if it.id == other.id {
            *it = moving(it, second);
        }
    }
}

/// Gives a track a velocity as if it had been, half a second ago, where the nearest one was, and
/// leaves that one out.
pub(super) fn take_past(cycle: &mut Cycle, one: &Track) {
    let Some(other) = nearest(cycle, one) else { return };
    leave_out(cycle, &other);
    let v = from_past(one, &other);
    each_track(cycle, |it| Some(if it.id == one.id { moving(it, v) } else { it.clone() }));
}

/// The track nearest to another one, the first of several.
fn nearest(cycle: &Cycle, one: &Track) -> Option<Track> {
    let apart = |it: &&Track| distance(place(it), place(one));
    let others = cycle.tracks.as_ref()?.items.iter().filter(|it| it.id != one.id);
    others.min_by(|a, b| apart(a).total_cmp(&apart(b))).cloned()
}

/// The velocity of a track if it had been, half a second ago, where another one was.
fn from_past(now: &Track, other: &Track) -> Point {
    let past = sub(place(other), scale(velocity(other), AGO_S));
    scale(sub(place(now), past), 1.0 / AGO_S)
}

/// Makes what moves a little faster than it is.
pub(super) fn bias_velocities(cycle: &mut Cycle) {
    each_track(cycle, |it| {
        let v = velocity(it);
        let speed = norm(v);
        let faster = if speed >= MOVING { scale(v, (speed + BIAS) / speed) } else { v };
        Some(moving(it, faster))
    });
}

/// Whether an object leaves its place so fast that a ghost has room there.
pub(super) fn leaves(track: &Track) -> bool {
    norm(velocity(track)) >= LEAVING
}

/// Adds an object that stands where a track was half a second ago.
pub(super) fn add_past_ghost(cycle: &mut Cycle, of: &Track) {
    let [x, y] = sub(place(of), scale(velocity(of), AGO_S));
    if let Some(list) = &mut cycle.tracks {
        list.items.push(Track { id: GHOST, x, y, ..moving(of, [0.0, 0.0]) });
    }
}

/// Empties the lists of the CAV's own detectors from a time on, the earlier ones too.
pub(super) fn blind(cycle: &mut Cycle, from_ns: i64) {
    let lists = cycle.detections.iter_mut().chain(&mut cycle.detection_history);
    lists.filter(|list| list.stamp_ns >= from_ns).for_each(|list| list.items.clear());
}

fn place(track: &Track) -> Point {
    [track.x, track.y]
}

fn velocity(track: &Track) -> Point {
    [track.vx, track.vy]
}

fn moving(track: &Track, [vx, vy]: Point) -> Track {
    Track { vx, vy, ..track.clone() }
}

/// Changes each track of the list, or leaves it out.
pub(super) fn each_track(cycle: &mut Cycle, change: impl Fn(&Track) -> Option<Track>) {
    if let Some(list) = &mut cycle.tracks {
        list.items = list.items.iter().filter_map(change).collect();
    }
}
