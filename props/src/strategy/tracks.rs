//! Stage iii at its thresholds (`spec/3-stages.md#stage-iii-trajectory-with-tracks`).

use mufasa_model::input::cycle::{Cycle, DetectionList, Track, TrackList};
use mufasa_model::input::profile::{HardenedRule, Profile};
use mufasa_model::services::configuration::Configuration;

use super::base::{self, Obstacle, seconds};
use super::draw::Draw;
use super::track_validation::track;
use super::{history, obstacle};

/// A cycle that stage iii decides.
pub fn cycle(draw: &mut Draw<'_>, profile: Profile) -> Cycle {
    let frame = base::frame(draw);
    let configuration = draw.pick(&[
        Configuration::PlanRemote,
        Configuration::PlanRemote,
        Configuration::AllRemote,
    ]);
    let mut cycle = base::cycle(draw, frame, profile, configuration);
    obstacle::widen(&mut cycle, frame);
    let horizon = obstacle::horizon_of_tracks(&cycle);
    let found = obstacle::decisive(draw, &mut cycle, horizon);
    let age = draw.pick(&[0, 30_000_000, 100_000_000]);
    let age = draw.odd_ns(age);
    let stamp_ns = cycle.now_ns - age;
    let mut items = Vec::new();
    if draw.one_in(4) {
        items.push(track(frame, (-30.0, 2.0), 4));
    }
    let standing = configuration == Configuration::AllRemote && draw.one_in(3);
    items.push(if standing { fleeing(found) } else { moving(draw, &cycle, found, stamp_ns) });
    if draw.one_in(8) {
        items.push(track(frame, (70.0, -8.0), 12));
    }
    cycle.tracks = Some(TrackList { stamp_ns, items });
    if configuration == Configuration::AllRemote && profile == Profile::HARDENED {
        if draw.one_in(2) {
            // A detection at every place: stage i runs and, when none is far off, passes.
            let age = draw.pick(&[0, 20_000_000]);
            let seen_ns = cycle.now_ns - draw.odd_ns(age);
            cycle.detections = Some(DetectionList { stamp_ns: seen_ns, items: Vec::new() });
            let tracks = cycle.tracks.iter().flat_map(|list| &list.items);
            let seen = |track| history::item(track, history::place(&cycle, track).0);
            let items = tracks.map(seen).collect();
            cycle.detections = Some(DetectionList { stamp_ns: seen_ns, items });
            history::back(draw, &mut cycle);
        } else if draw.one_in(4) {
            // Stage i cannot pass without a detection at every track; without any it does not
            // run (H-02).
            let empty = DetectionList { stamp_ns: cycle.now_ns - 200_000_000, items: Vec::new() };
            cycle.detections = Some(empty);
        }
    }
    cycle
}

/// A cycle that stage iii decides by where a track was: the trajectory begins before the stamp of the
/// list, so that the time of prediction is negative.
pub fn before(draw: &mut Draw<'_>, profile: Profile) -> Cycle {
    let frame = base::frame(draw);
    let mut cycle = base::cycle(draw, frame, profile, Configuration::PlanRemote);
    obstacle::widen(&mut cycle, frame);
    let horizon = obstacle::horizon_of_tracks(&cycle);
    let found = obstacle::decisive(draw, &mut cycle, horizon);
    // The hardened profile lets it begin as long ago as data may be old (H-07).
    let earlier_ns = if profile.has(HardenedRule::H07) {
        draw.pick(&[60_000_000, 20_000_000, 100_000_000])
    } else {
        draw.pick(&[600_000_000, 100_000_000, 3_000_000_000])
    };
    let earlier_ns = draw.odd_ns(earlier_ns);
    for point in cycle.trajectory.iter_mut().flat_map(|list| &mut list.points) {
        point.t_ns -= earlier_ns;
    }
    let stamp_ns = cycle.now_ns;
    let items = vec![moving(draw, &cycle, found, stamp_ns)];
    cycle.tracks = Some(TrackList { stamp_ns, items });
    cycle
}

/// The obstacle as a track that is in its place when the CAV is at its trajectory point; it
/// stands, or moves off, or moves anyhow.
fn moving(draw: &mut Draw<'_>, cycle: &Cycle, found: Obstacle, stamp_ns: i64) -> Track {
    let t_ns = cycle
        .trajectory
        .as_ref()
        .and_then(|list| list.points.get(found.point))
        .map_or(stamp_ns, |point| point.t_ns);
    let dt = seconds(t_ns - stamp_ns);
    let (vx, vy) = match draw.below(4) {
        0 | 1 => (0.0, 0.0),
        2 => {
            // In the hardened profile what is so fast is decided by H-14, elsewhere than it is aimed here.
            let speeds = [8.0, 1.5, 20.0, 45.0, 90.0, 149.0];
            let is_any = cycle.profile == Profile::PAPER && base::has_room(found.frame);
            let count = if is_any { 6 } else { 3 };
            let speed = draw.pick(&speeds[..count]);
            (speed * found.away.0, speed * found.away.1)
        }
        _ => (draw.range(-15.0, 15.0), draw.range(-15.0, 15.0)),
    };
    let (x, y) = (found.frame.x - vx * dt, found.frame.y - vy * dt);
    let (length, width) = found.size;
    Track { id: 7, x, y, cos: found.frame.cos, sin: found.frame.sin, vx, vy, length, width }
}

/// The obstacle as a track that is said to move off fast: as its detection, which nothing confirms, it is
/// in the way where it is now (H-14).
fn fleeing(found: Obstacle) -> Track {
    let base::Frame { x, y, cos, sin } = found.frame;
    let (length, width) = found.size;
    let (vx, vy) = (60.0 * found.away.0, 60.0 * found.away.1);
    Track { id: 7, x, y, cos, sin, vx, vy, length, width }
}
