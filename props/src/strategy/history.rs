//! Earlier detections of the CAV: histories that back tracks, nearly back them, or do not
//! (`spec/hardened/what-the-cav-saw.md`).

use mufasa_model::input::cycle::{Cycle, Detection, DetectionList, Track};

use super::base::{bend, seconds};
use super::draw::Draw;

/// Ages of the lists, ns, increasing: those of the keeper, fewer, or at the borders of being
/// usable and of being nearest to 500 ms.
pub fn ages(draw: &mut Draw<'_>) -> Vec<i64> {
    const MS: i64 = 1_000_000;
    let mut ages = match draw.below(6) {
        0..=2 => [300, 500, 800].map(|ms| draw.odd_ns(ms * MS)).to_vec(),
        3 => [300, 500].map(|ms| draw.odd_ns(ms * MS)).to_vec(),
        4 => vec![450 * MS, 550 * MS, draw.near_ns(1_000 * MS)],
        _ => vec![draw.near_ns(200 * MS), 500 * MS, draw.near_ns(1_000 * MS), 1_500 * MS],
    };
    ages.truncate(draw.pick(&[4, 4, 4, 2, 1]));
    ages
}

/// Where the track is when the CAV sees its detections, m, and the time of these, ns.
pub fn place(cycle: &Cycle, track: &Track) -> ((f64, f64), i64) {
    let seen_ns = cycle.detections.as_ref().map_or(cycle.now_ns, |list| list.stamp_ns);
    let stamp_ns = cycle.tracks.as_ref().map_or(seen_ns, |list| list.stamp_ns);
    let t = seconds(seen_ns - stamp_ns);
    ((track.x + track.vx * t, track.y + track.vy * t), seen_ns)
}

/// A history in which every received track has an item near its past: well within the distance
/// of an origin or near that distance; at times the item is missed, has a twin that is equally
/// near, belongs to the next track, or is the next track's origin, too.
pub fn back(draw: &mut Draw<'_>, cycle: &mut Cycle) {
    let tracks = cycle.tracks.as_ref().map_or_else(Vec::new, |list| list.items.clone());
    let near_limit = draw.one_in(2);
    let mut history = Vec::new();
    for dt_ns in ages(draw) {
        let dt = seconds(dt_ns);
        let past = |track: &Track| {
            let ((x, y), _) = place(cycle, track);
            (x - track.vx * dt, y - track.vy * dt)
        };
        let limit = cycle.parameters.theta_track_max + cycle.parameters.theta_velocity * dt;
        let mut items = Vec::new();
        for (index, track) in tracks.iter().enumerate() {
            let own = past(track);
            let next = tracks.get(index + 1).map_or(own, past);
            let distance = if near_limit { draw.near(limit) } else { draw.range(0.0, 0.4) };
            let (cos, sin) = draw.pick(&[(1.0, 0.0), (0.0, -1.0), (0.6, 0.8), (-0.8, 0.6)]);
            let at = |(x, y): (f64, f64), side: f64| {
                item(track, (x + side * distance * cos, y + side * distance * sin))
            };
            match draw.below(10) {
                0 => {}
                1 => items.extend([at(own, 1.0), at(own, -1.0)]),
                2 => items.push(at(next, 1.0)),
                3 => {
                    let middle = (0.5 * (own.0 + next.0), 0.5 * (own.1 + next.1));
                    items.push(item(track, middle));
                }
                _ => items.push(at(own, 1.0)),
            }
        }
        let (_, seen_ns) = tracks.first().map_or(((0.0, 0.0), cycle.now_ns), |t| place(cycle, t));
        history.push(DetectionList { stamp_ns: seen_ns - dt_ns, items });
    }
    cycle.detection_history = history;
}

/// The detection of a track at a place.
pub fn item(track: &Track, (x, y): (f64, f64)) -> Detection {
    let Track { cos, sin, length, width, .. } = *track;
    Detection { x, y, cos, sin, length, width }
}

/// Lists with one item of a thing that goes by (x, y) with this velocity at the time of the
/// detections: the one nearest to 500 ms exact, the others off by about what SEEN-16 lets them be or 0.3 m, or left out.
pub fn of_moving(draw: &mut Draw<'_>, cycle: &mut Cycle, (x, y): (f64, f64), (vx, vy): (f64, f64)) {
    let seen_ns = cycle.detections.as_ref().map_or(cycle.now_ns, |list| list.stamp_ns);
    let ages = ages(draw);
    let usable = |age: &&i64| (200_000_000..=1_000_000_000).contains(*age);
    let reference = ages.iter().filter(usable).min_by_key(|age| (**age - 500_000_000).abs());
    let reference = reference.copied();
    let with_support = !draw.one_in(4);
    for dt_ns in ages {
        let dt = seconds(dt_ns);
        let seen = Detection { x, y, cos: 1.0, sin: 0.0, length: 4.5, width: 1.8 };
        let (mut x, mut y) = (x - vx * dt, y - vy * dt);
        let mut items = Vec::new();
        if Some(dt_ns) == reference || with_support {
            if Some(dt_ns) != reference {
                // So far it moved evenly (SEEN-19), or is borne out.
                let p = &cycle.parameters;
                let borne = p.theta_track_max.max(0.3) + bend(p, reference.map_or(dt, seconds), dt);
                let limit = draw.pick(&[borne, 0.3]);
                let error = draw.near(limit);
                let (cos, sin) = draw.pick(&[(1.0, 0.0), (0.6, 0.8), (0.0, -1.0)]);
                (x, y) = (x + error * cos, y + error * sin);
            }
            items.push(Detection { x, y, ..seen });
        }
        cycle.detection_history.push(DetectionList { stamp_ns: seen_ns - dt_ns, items });
    }
}

/// Lists in which one item is where the thing was, to the last bit or nearly so.
pub fn exact(draw: &mut Draw<'_>, cycle: &mut Cycle, (x, y): (f64, f64), (vx, vy): (f64, f64)) {
    let seen_ns = cycle.detections.as_ref().map_or(cycle.now_ns, |list| list.stamp_ns);
    let ages = draw.pick(&[&[500_000_000][..], &[300_000_000, 500_000_000, 800_000_000]]);
    let list = |dt_ns: &i64| {
        let dt_ns = draw.odd_ns(*dt_ns);
        let dt = seconds(dt_ns);
        let (x, y) = (x - vx * dt, y - vy * dt);
        let item = Detection { x, y, cos: 1.0, sin: 0.0, length: 4.5, width: 1.8 };
        DetectionList { stamp_ns: seen_ns - dt_ns, items: vec![item] }
    };
    cycle.detection_history = ages.iter().map(list).collect();
}

/// An item in each list where the thing is, of one list about so far away that it stood, or just did not (SEEN-18).
pub fn stand(draw: &mut Draw<'_>, cycle: &mut Cycle, (x, y): (f64, f64)) {
    let far = draw.below(cycle.detection_history.len().max(1));
    for (list, k) in cycle.detection_history.iter_mut().zip(0..) {
        let distance = if k == far { draw.near(0.3) } else { draw.pick(&[0.0, 0.1]) };
        let (cos, sin) = draw.pick(&[(1.0, 0.0), (0.6, 0.8), (0.0, -1.0)]);
        let (x, y) = (x + distance * cos, y + distance * sin);
        list.items.push(Detection { x, y, cos: 1.0, sin: 0.0, length: 0.5, width: 0.5 });
    }
}
