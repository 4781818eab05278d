//! Things that move as the CAV saw them move, at the thresholds of H-14
//! (`spec/hardened/H-14.md#requirements-motions`).

use mufasa_model::input::cycle::{Cycle, Detection, DetectionList, Track, TrackList};
use mufasa_model::services::configuration::Configuration;

use super::base::{Frame, bend, seconds};
use super::draw::Draw;
use super::history;

/// An object at the time of its list.
#[derive(Clone, Copy, Debug)]
pub struct Aimed {
    /// Centre and direction then.
    pub frame: Frame,
    /// Length and width, m.
    pub size: (f64, f64),
    /// Its velocity, m/s.
    pub velocity: (f64, f64),
    /// Age of the list, ns.
    pub age_ns: i64,
}

/// The object as a detection that the CAV saw move, at times explained by a track that says another
/// velocity.
pub fn carry(draw: &mut Draw<'_>, cycle: &mut Cycle, aimed: Aimed) {
    let seen_ns = cycle.now_ns - aimed.age_ns;
    let velocity = aimed.velocity;
    let at = (aimed.frame.x, aimed.frame.y);
    let mut items = vec![detection(aimed)];
    if draw.one_in(4) {
        let ego = &cycle.ego;
        let road = Frame { x: ego.x, y: ego.y, cos: ego.cos, sin: ego.sin };
        let (x, y) = road.at(-90.0, 20.0);
        let frame = Frame { x, y, ..aimed.frame };
        items.insert(0, detection(Aimed { frame, ..aimed }));
    }
    cycle.detections = Some(DetectionList { stamp_ns: seen_ns, items });
    if draw.one_in(6) {
        // It was so near half a second ago that it may stand, or just not.
        let moved = draw.near(0.5 * velocity.0.hypot(velocity.1));
        cycle.parameters.theta_track_max = moved.clamp(1e-3, 1e3);
    }
    if draw.one_in(4) {
        history::of_moving(draw, cycle, at, velocity);
    } else {
        history::exact(draw, cycle, at, velocity);
    }
    if draw.one_in(5) {
        history::stand(draw, cycle, at);
    }
    if draw.one_in(6) {
        // The fastest that is looked for, or just not.
        cycle.parameters.v_object = draw.near(velocity.0.hypot(velocity.1)).clamp(1e-3, 1e3);
    }
    if draw.one_in(2) {
        explain(draw, cycle, aimed);
    }
}

/// A track of the detection that says another velocity: so near the true one that its past still
/// holds where the thing came from, or just does not; along the detection's direction, or just
/// not. At times a second thing was nearer to that past and is its origin.
fn explain(draw: &mut Draw<'_>, cycle: &mut Cycle, aimed: Aimed) {
    let seen_ns = cycle.now_ns - aimed.age_ns;
    let p = &cycle.parameters;
    let Aimed { frame: Frame { x, y, cos, sin }, velocity, .. } = aimed;
    let at = (x, y);
    let (vx, vy) = if draw.one_in(3) {
        velocity
    } else if draw.one_in(4) {
        let forward = draw.range(-20.0, 20.0);
        let speed = (1.01 * forward * forward + 5.0).sqrt();
        let aside = draw.near(p.theta_velocity + 0.1 * speed);
        (forward * cos - aside * sin, forward * sin + aside * cos)
    } else {
        let error = draw.near(p.theta_velocity + p.theta_track_max / 0.5);
        let (a, b) = draw.pick(&[(1.0, 0.0), (0.0, 1.0), (-0.6, 0.8)]);
        (velocity.0 + error * a, velocity.1 + error * b)
    };
    let age = draw.pick(&[0, 50_000_000]);
    let stamp_ns = cycle.now_ns - draw.odd_ns(age);
    let t = seconds(seen_ns - stamp_ns);
    let (length, width) = aimed.size;
    let (x, y) = (at.0 - vx * t, at.1 - vy * t);
    let bounded = |speed: f64| speed.clamp(-150.0, 150.0);
    let track = Track { id: 7, x, y, cos, sin, vx: bounded(vx), vy: bounded(vy), length, width };
    // In `PlanRemote` its tracks are the CAV's own.
    if cycle.configuration == Configuration::PlanRemote || !draw.one_in(3) {
        for list in &mut cycle.detection_history {
            let dt = seconds(seen_ns - list.stamp_ns);
            let past = (at.0 - track.vx * dt, at.1 - track.vy * dt);
            list.items.push(history::item(&track, past));
        }
        if draw.one_in(2) {
            shown(draw, cycle);
        }
    }
    cycle.tracks = Some(TrackList { stamp_ns, items: vec![track] });
}

/// One list other than the reference list shows the thing about as far from its mean motion as SEEN-17 lets it be, or
/// misses it.
fn shown(draw: &mut Draw<'_>, cycle: &mut Cycle) {
    let Some(seen_ns) = cycle.detections.as_ref().map(|list| list.stamp_ns) else { return };
    let dt_of = |list: &DetectionList| seconds(seen_ns - list.stamp_ns);
    let off_half_a_second = |dt: &f64| (dt - 0.5).abs();
    let dts: Vec<f64> = cycle.detection_history.iter().map(dt_of).collect();
    let by_age = |a: &f64, b: &f64| off_half_a_second(a).total_cmp(&off_half_a_second(b));
    let Some(dt) = dts.iter().copied().min_by(by_age) else { return };
    let k = draw.below(dts.len());
    let error = draw.near(0.3 + bend(&cycle.parameters, dt, dts[k]));
    let (cos, sin) = draw.pick(&[(1.0, 0.0), (0.6, 0.8), (0.0, -1.0)]);
    let items = &mut cycle.detection_history[k].items;
    if draw.one_in(4) && !items.is_empty() {
        items.remove(0);
    } else if let Some(item) = items.first_mut() {
        (item.x, item.y) = (item.x + error * cos, item.y + error * sin);
    }
}

/// As a detection.
pub fn detection(aimed: Aimed) -> Detection {
    let Frame { x, y, cos, sin } = aimed.frame;
    let (length, width) = (aimed.size.0.clamp(0.01, 100.0), aimed.size.1.clamp(0.01, 100.0));
    Detection { x, y, cos, sin, length, width }
}
