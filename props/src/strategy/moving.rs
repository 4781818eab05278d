//! Things that move as the CAV saw them move, at the thresholds of H-14
//! (`spec/7-fail-safe.md#motions`).

use mufasa_model::input::cycle::{Cycle, Detection, DetectionList, Track, TrackList};
use mufasa_model::services::configuration::Configuration;

use super::base::{Frame, Obstacle, seconds};
use super::draw::Draw;
use super::history;
use super::obstacle;
use super::track_validation::detection;

/// A cycle that the motion of one detection decides: it is beside the trajectory now, and in its
/// way, nearly, when the CAV is at a point.
pub fn cycle(draw: &mut Draw<'_>, mut cycle: Cycle) -> Cycle {
    let horizon = obstacle::horizon_of_path(&cycle);
    let found = obstacle::decisive(draw, &mut cycle, horizon);
    let velocity = velocity(draw, found);
    let seen_ns = cycle.now_ns - draw.pick(&[0, 30_000_000, 100_000_000]);
    let dt = seconds(time_of(&cycle, found) - seen_ns);
    let at = (found.frame.x - velocity.0 * dt, found.frame.y - velocity.1 * dt);
    let mut items = vec![seen(found, at)];
    if draw.one_in(4) {
        let behind = Frame { x: cycle.ego.x, y: cycle.ego.y, ..found.frame };
        items.insert(0, detection(behind, (-40.0, 9.0)));
    }
    cycle.detections = Some(DetectionList { stamp_ns: seen_ns, items });
    history::of_moving(draw, &mut cycle, at, velocity);
    if draw.one_in(4) {
        // The fastest that is looked for, or just not.
        cycle.parameters.v_object = draw.near(velocity.0.hypot(velocity.1)).clamp(1e-3, 1e3);
    }
    if cycle.configuration != Configuration::PlanRemote && draw.below(3) > 0 {
        explain(draw, &mut cycle, found, at, velocity);
    }
    cycle
}

/// The time of the point at which the obstacle is where it is.
fn time_of(cycle: &Cycle, found: Obstacle) -> i64 {
    let points = cycle.trajectory.as_ref().map_or(&[][..], |list| &list.points);
    points.get(found.point).map_or(cycle.now_ns, |point| point.t_ns)
}

/// Off the trajectory: the thing comes from there.
fn velocity(draw: &mut Draw<'_>, found: Obstacle) -> (f64, f64) {
    let speed = draw.pick(&[8.0, 25.0, 60.0, 3.0, 0.5]);
    let (cos, sin) = match draw.below(3) {
        0 | 1 => (-found.away.0, -found.away.1),
        _ => draw.direction(),
    };
    (speed * cos, speed * sin)
}

/// The obstacle as a detection at a place.
fn seen(found: Obstacle, (x, y): (f64, f64)) -> Detection {
    let Frame { cos, sin, .. } = found.frame;
    let (length, width) = found.size;
    Detection { x, y, cos, sin, length, width }
}

/// A track of the detection that says another velocity: so near the true one that its past still
/// holds where the thing came from, or just does not; along the detection's direction, or just
/// not. At times a second thing was nearer to that past and is its origin.
fn explain(
    draw: &mut Draw<'_>,
    cycle: &mut Cycle,
    found: Obstacle,
    at: (f64, f64),
    velocity: (f64, f64),
) {
    let Some(seen_ns) = cycle.detections.as_ref().map(|list| list.stamp_ns) else { return };
    let p = &cycle.parameters;
    let Frame { cos, sin, .. } = found.frame;
    let (vx, vy) = if draw.one_in(4) {
        let forward = draw.range(-20.0, 20.0);
        let speed = (1.01 * forward * forward + 5.0).sqrt();
        let aside = draw.near(p.theta_velocity + 0.1 * speed);
        (forward * cos - aside * sin, forward * sin + aside * cos)
    } else {
        let error = draw.near(p.theta_velocity + p.theta_track_max / 0.5);
        let (a, b) = draw.pick(&[(1.0, 0.0), (0.0, 1.0), (-0.6, 0.8)]);
        (velocity.0 + error * a, velocity.1 + error * b)
    };
    let stamp_ns = cycle.now_ns - draw.pick(&[0, 50_000_000]);
    let t = seconds(seen_ns - stamp_ns);
    let (length, width) = found.size;
    let (x, y) = (at.0 - vx * t, at.1 - vy * t);
    let bounded = |speed: f64| speed.clamp(-150.0, 150.0);
    let track = Track { id: 7, x, y, cos, sin, vx: bounded(vx), vy: bounded(vy), length, width };
    if !draw.one_in(3) {
        for list in &mut cycle.detection_history {
            let dt = seconds(seen_ns - list.stamp_ns);
            let past = (at.0 - track.vx * dt, at.1 - track.vy * dt);
            list.items.push(history::item(&track, past));
        }
        if draw.one_in(2) {
            dispute(draw, cycle, &track);
        }
    }
    cycle.tracks = Some(TrackList { stamp_ns, items: vec![track] });
}

/// A detection behind the CAV that comes from the last item of each list, or just does not: about
/// `theta_track_max` beside what supports it, at about `v_object`.
fn dispute(draw: &mut Draw<'_>, cycle: &mut Cycle, track: &Track) {
    let Some(seen_ns) = cycle.detections.as_ref().map(|list| list.stamp_ns) else { return };
    let dt_of = |list: &DetectionList| seconds(seen_ns - list.stamp_ns);
    let off_half_a_second = |list: &&DetectionList| (dt_of(list) - 0.5).abs();
    let reference = (cycle.detection_history.iter())
        .min_by(|a, b| off_half_a_second(a).total_cmp(&off_half_a_second(b)));
    let Some((origin, dt)) =
        reference.and_then(|list| Some((list.items.last()?.clone(), dt_of(list))))
    else {
        return;
    };
    let back = draw.pick(&[20.0, 9.0, 30.0]);
    let (cos, sin) = (cycle.ego.cos, cycle.ego.sin);
    let at = (cycle.ego.x - back * cos, cycle.ego.y - back * sin);
    let (vx, vy) = ((at.0 - origin.x) / dt, (at.1 - origin.y) / dt);
    let error = draw.near(cycle.parameters.theta_track_max);
    for list in &mut cycle.detection_history {
        let dt = seconds(seen_ns - list.stamp_ns);
        let (x, y) = (at.0 - vx * dt + error * sin, at.1 - vy * dt - error * cos);
        list.items.push(history::item(track, (x, y)));
    }
    if draw.one_in(2) {
        cycle.parameters.v_object = draw.near(vx.hypot(vy)).clamp(1e-3, 1e3);
    }
    if let Some(list) = &mut cycle.detections {
        list.items.push(history::item(track, at));
    }
}
