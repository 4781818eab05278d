//! Stage i at its thresholds: mean cost, `theta_track_max`, field-of-view radius, left-out tracks
//! (`spec/3-stages.md#stage-i-track-validation`, H-01).

use mufasa_model::input::cycle::{Cycle, Detection, DetectionList, Track, TrackList};
use mufasa_model::input::profile::{HardenedRule, Profile};
use mufasa_model::services::configuration::Configuration;

use super::base::{self, Frame, seconds};
use super::draw::Draw;
use super::history;

/// Where an object is in the CAV's frame, m.
type Place = (f64, f64);

/// A cycle that only stage i decides: no trajectory, so no other stage runs.
pub fn cycle(draw: &mut Draw<'_>, profile: Profile) -> Cycle {
    let frame = base::frame(draw);
    let configuration = draw.pick(&[Configuration::MotRemote, Configuration::AllRemote]);
    let mut cycle = base::cycle(draw, frame, profile, configuration);
    cycle.trajectory = None;
    match (draw.below(8), profile) {
        (0 | 1, _) => mean_to_threshold(draw, frame, &mut cycle),
        (2, _) | (3 | 4, Profile::PAPER) => threshold_to_mean(draw, frame, &mut cycle),
        (3, _) => pair_limit(draw, frame, &mut cycle),
        (5, _) | (6, Profile::PAPER) => radius(draw, frame, &mut cycle),
        (4 | 6, rules) if rules.has(HardenedRule::H01) && draw.one_in(2) => {
            missed(draw, frame, &mut cycle);
        }
        (4 | 6, _) => left_out(draw, frame, &mut cycle),
        (_, _) => anything(draw, frame, &mut cycle),
    }
    cycle
}

/// A cluster of tracks and detections, scaled until the smallest mean cost is near `theta_tr`.
fn mean_to_threshold(draw: &mut Draw<'_>, frame: Frame, cycle: &mut Cycle) {
    let centre = (draw.range(-30.0, 30.0), draw.range(-30.0, 30.0));
    let (tracks, detections) = (cluster(draw, 4), cluster(draw, 5));
    let anchor = !draw.one_in(4);
    let target = draw.near(cycle.parameters.theta_tr);
    let mut scale = 1.0;
    for _ in 0..3 {
        let (tracks, detections) = scaled(&tracks, &detections, centre, scale, anchor);
        if let Some(costs) = Costs::of(&tracks, &detections, cycle)
            && costs.mean > 0.0
        {
            scale *= target / costs.mean;
        }
    }
    let (tracks, detections) = scaled(&tracks, &detections, centre, scale, anchor);
    fill(draw, frame, cycle, &tracks, &detections);
}

/// Any cluster, and `theta_tr` near its smallest mean cost; on a lattice, so that pairs tie and
/// sums of roots meet the threshold exactly.
fn threshold_to_mean(draw: &mut Draw<'_>, frame: Frame, cycle: &mut Cycle) {
    let (tracks, detections) = (lattice(draw, 4), lattice(draw, 4));
    if let Some(costs) = Costs::of(&tracks, &detections, cycle) {
        cycle.parameters.theta_track_max = 10.0;
        cycle.parameters.theta_tr = draw.near(costs.mean).clamp(1e-3, 1e3);
    }
    fill(draw, frame, cycle, &tracks, &detections);
}

/// A generous `theta_tr`, and `theta_track_max` near the smallest possible largest pair.
fn pair_limit(draw: &mut Draw<'_>, frame: Frame, cycle: &mut Cycle) {
    let (tracks, detections) = (lattice(draw, 4), lattice(draw, 4));
    cycle.parameters.theta_tr = 20.0;
    if let Some(costs) = Costs::of(&tracks, &detections, cycle) {
        cycle.parameters.theta_track_max = draw.near(costs.largest).clamp(1e-3, 1e3);
    }
    fill(draw, frame, cycle, &tracks, &detections);
}

/// Ghosts at the field-of-view radius, in directions with exact coordinates or any other.
fn radius(draw: &mut Draw<'_>, frame: Frame, cycle: &mut Cycle) {
    const EXACT: [Place; 8] = [
        (3.0, 4.0),
        (-4.0, 3.0),
        (0.0, 5.0),
        (5.0, 0.0),
        (-3.0, -4.0),
        (4.0, -3.0),
        (0.0, -5.0),
        (-5.0, 0.0),
    ];
    let scale = draw.pick(&[1.0, 4.0, 8.0, 2.5]);
    let matched = (5.0 * scale, 0.0);
    let mut tracks = if draw.one_in(2) { vec![matched] } else { Vec::new() };
    let most = if draw.one_in(8) { 8 } else { 3 };
    for exact in EXACT.iter().take(draw.between(1, most)) {
        let place = if draw.below(2) == 0 {
            (scale * exact.0, scale * exact.1)
        } else {
            let angle = draw.range(0.5, 6.0);
            let distance = 5.0 * scale + draw.offset();
            (distance * angle.cos(), distance * angle.sin())
        };
        tracks.push(place);
    }
    let mut detections = vec![matched];
    while detections.len() < tracks.len() {
        detections.push((0.5, detections.len() as f64 / 8.0));
    }
    fill(draw, frame, cycle, &tracks, &detections);
}

/// Moving tracks far apart, some without a detection: of these only backed ones may be left out, and
/// not more than the budget; the mean of the others is near `theta_tr`.
fn left_out(draw: &mut Draw<'_>, frame: Frame, cycle: &mut Cycle) {
    let n = draw.between(1, 4);
    cycle.parameters.miss_budget = draw.pick(&[4, 1, 2, 0, 1]);
    let ages = [draw.pick(&[0, 50_000_000]), draw.pick(&[0, 30_000_000])];
    let [tracks_ns, seen_ns] = ages.map(|age| cycle.now_ns - draw.odd_ns(age));
    let t = seconds(seen_ns - tracks_ns);
    let (mut tracks, mut seen) = (Vec::new(), vec![detection(frame, (95.0, 0.0))]);
    for index in 0..n {
        let place = (12.0 * index as f64 - 20.0, 6.0);
        let mut track = track(frame, place, 1 + i64::try_from(index).unwrap_or(0));
        (track.vx, track.vy) = draw.pick(&[(0.0, 0.0), (8.0, -6.0), (0.5, 12.0), (-70.0, 0.0)]);
        if draw.one_in(8) {
            cycle.parameters.v_object = draw.near(track.vx.hypot(track.vy)).max(1.0);
        }
        (track.x, track.y) = (track.x - track.vx * t, track.y - track.vy * t);
        tracks.push(track);
        if !draw.one_in(3) {
            let error = draw.near(cycle.parameters.theta_tr);
            let (cos, sin) = draw.pick(&[(1.0, 0.0), (0.6, 0.8), (0.0, -1.0)]);
            seen.push(detection(frame, (place.0 + error * cos, place.1 + error * sin)));
        }
    }
    cycle.tracks = Some(TrackList { stamp_ns: tracks_ns, items: tracks });
    cycle.detections = Some(DetectionList { stamp_ns: seen_ns, items: seen });
    history::back(draw, cycle);
}

/// Backed tracks, of which as many are missed as may be left out: that number decides, or the mean of those that are
/// seen is near `theta_tr`, or it would be with those that are left out, with distance 0.
fn missed(draw: &mut Draw<'_>, frame: Frame, cycle: &mut Cycle) {
    let spare = draw.pick(&[1, 2, 0]);
    cycle.parameters.miss_budget = i64::try_from(spare).unwrap_or(0);
    let seen = draw.between(1, 2);
    let mean = draw.near(cycle.parameters.theta_tr);
    let (more, error) = match draw.below(6) {
        0 => (draw.below(2), 0.0),
        1 => (0, mean * (seen + spare) as f64 / seen as f64),
        _ => (0, mean),
    };
    let missed = spare + more;
    let places: Vec<Place> =
        (0..seen + missed).map(|index| (12.0 * index as f64 - 20.0, 6.0)).collect();
    let at = |place: &Place| (place.0, place.1 + error);
    let detections: Vec<Place> = places[..seen].iter().map(at).chain([(95.0, 0.0)]).collect();
    fill(draw, frame, cycle, &places, &detections);
    let seen_ns = cycle.detections.as_ref().map_or(cycle.now_ns, |list| list.stamp_ns);
    cycle.detection_history = [300_000_000, 500_000_000, 800_000_000]
        .into_iter()
        .map(|age| DetectionList {
            stamp_ns: seen_ns - draw.odd_ns(age),
            items: places.iter().map(|place| detection(frame, *place)).collect(),
        })
        .collect();
}

/// Few objects anywhere, at times none.
fn anything(draw: &mut Draw<'_>, frame: Frame, cycle: &mut Cycle) {
    let places = |draw: &mut Draw<'_>| {
        let n = draw.below(5);
        (0..n).map(|_| (draw.range(-2.0, 2.0), draw.range(-2.0, 2.0))).collect::<Vec<Place>>()
    };
    let (tracks, detections) = (places(draw), places(draw));
    fill(draw, frame, cycle, &tracks, &detections);
}

/// Tracks and detections at these places of the CAV's frame, with stamps and budgets.
fn fill(
    draw: &mut Draw<'_>,
    frame: Frame,
    cycle: &mut Cycle,
    tracks: &[Place],
    detections: &[Place],
) {
    let old = draw.pick(&[0, 10_000_000, 40_000_000_000]);
    let old = draw.odd_ns(old);
    let items = tracks.iter().zip(1..).map(|(place, id)| track(frame, *place, id)).collect();
    cycle.tracks = Some(TrackList { stamp_ns: cycle.now_ns - old, items });
    let age = if draw.one_in(8) { draw.near_ns(cycle.parameters.max_age_ns) } else { 0 };
    let items = detections.iter().map(|place| detection(frame, *place)).collect();
    cycle.detections = Some(DetectionList { stamp_ns: cycle.now_ns - age, items });
}

/// A car-sized track at a place of `frame`, standing.
pub fn track(frame: Frame, (a, b): Place, id: i64) -> Track {
    let (x, y) = frame.at(a, b);
    let Frame { cos, sin, .. } = frame;
    Track { id, x, y, cos, sin, vx: 0.0, vy: 0.0, length: 4.5, width: 1.8 }
}

/// A car-sized detection at a place of `frame`.
pub fn detection(frame: Frame, (a, b): Place) -> Detection {
    let (x, y) = frame.at(a, b);
    Detection { x, y, cos: frame.cos, sin: frame.sin, length: 4.5, width: 1.8 }
}

/// Up to `most` places in a square of 2 m.
fn cluster(draw: &mut Draw<'_>, most: usize) -> Vec<Place> {
    let n = draw.between(1, most);
    (0..n).map(|_| (draw.range(-1.0, 1.0), draw.range(-1.0, 1.0))).collect()
}

/// Up to `most` places with exact coordinates; two objects may share one.
fn lattice(draw: &mut Draw<'_>, most: usize) -> Vec<Place> {
    const STEPS: [f64; 7] = [0.0, 0.25, -0.25, 0.75, 1.0, -0.5, 2.0];
    let n = draw.between(1, most);
    (0..n).map(|_| (draw.pick(&STEPS), draw.pick(&STEPS))).collect()
}

/// The cluster around `centre`, and if wanted a matched pair so far off that all are gated.
fn scaled(
    tracks: &[Place],
    detections: &[Place],
    centre: Place,
    scale: f64,
    anchor: bool,
) -> (Vec<Place>, Vec<Place>) {
    let moved = |places: &[Place]| {
        let around = |(a, b): &Place| (centre.0 + scale * a, centre.1 + scale * b);
        let mut moved: Vec<Place> = places.iter().map(around).collect();
        if anchor {
            moved.push((90.0, 0.0));
        }
        moved
    };
    (moved(tracks), moved(detections))
}

/// What the best assignment costs, rounded.
struct Costs {
    /// Smallest mean distance.
    mean: f64,
    /// Smallest possible largest distance.
    largest: f64,
}

impl Costs {
    /// Of the gated tracks, by trying every assignment; `None` without pairs.
    fn of(tracks: &[Place], detections: &[Place], cycle: &Cycle) -> Option<Self> {
        let radius = detections.iter().map(|(a, b)| a.hypot(*b)).fold(0.0, f64::max);
        let gated: Vec<Place> =
            tracks.iter().copied().filter(|(a, b)| a.hypot(*b) <= radius).collect();
        // Without a history no track is backed.
        let is_spared = !cycle.profile.has(HardenedRule::H01);
        let spared = if is_spared { gated.len().saturating_sub(detections.len()) } else { 0 };
        let pairs = gated.len().saturating_sub(spared);
        if pairs == 0 || pairs > detections.len() {
            return None;
        }
        let mut best = (f64::INFINITY, f64::INFINITY);
        let mut used = vec![false; detections.len()];
        try_all(&gated, detections, spared.min(gated.len()), (0.0, 0.0), &mut used, &mut best);
        Some(Self { mean: best.0 / pairs as f64, largest: best.1 })
    }
}

/// Sum and largest distance of every assignment that leaves at most `spared` tracks unmatched.
fn try_all(
    tracks: &[Place],
    detections: &[Place],
    spared: usize,
    so_far: (f64, f64),
    used: &mut [bool],
    best: &mut (f64, f64),
) {
    let Some(((a, b), rest)) = tracks.split_first() else {
        if spared == 0 {
            *best = (best.0.min(so_far.0), best.1.min(so_far.1));
        }
        return;
    };
    for (index, (c, d)) in detections.iter().enumerate() {
        if !used[index] {
            used[index] = true;
            let distance = (a - c).hypot(b - d);
            let next = (so_far.0 + distance, so_far.1.max(distance));
            try_all(rest, detections, spared, next, used, best);
            used[index] = false;
        }
    }
    if spared > 0 {
        try_all(rest, detections, spared - 1, so_far, used, best);
    }
}
