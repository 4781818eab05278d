//! Which inputs are there and current, in every configuration
//! (`spec/3-stages.md#schedule`).

use mufasa_model::input::cycle::{Cycle, DetectionList, Grid, Lead, Profile, TrackList};
use mufasa_model::services::configuration::Configuration;

use super::base::{self, Frame};
use super::draw::Draw;
use super::track_validation::{detection, track};

/// A cycle whose inputs are present or missing, current or not, harmless or not, independently;
/// ages lie at the borders of being current.
pub fn cycle(draw: &mut Draw<'_>, profile: Profile) -> Cycle {
    let frame = base::frame(draw);
    let configuration = draw.pick(&[
        Configuration::AllRemote,
        Configuration::MotRemote,
        Configuration::PlanRemote,
        Configuration::Local,
    ]);
    let mut cycle = base::cycle(draw, frame, profile, configuration);
    (cycle.ego.speed, cycle.ego.length, cycle.ego.width) = (2.0, 4.0, 2.0);
    let ego = cycle.ego.clone();
    let straight = base::straight(&ego, frame, cycle.now_ns, &cycle.parameters);
    cycle.trajectory = if draw.one_in(5) { None } else { Some(straight) };
    if let Some(stamp_ns) = stamp(draw, &cycle)
        && let Some(trajectory) = &mut cycle.trajectory
    {
        trajectory.stamp_ns = stamp_ns;
        if draw.one_in(6) {
            let (x, y) = frame.at(0.0, 7.0);
            (trajectory.points[0].x, trajectory.points[0].y) = (x, y);
        }
    }
    objects(draw, frame, &mut cycle);
    if let Some(stamp_ns) = stamp(draw, &cycle) {
        let gap = draw.pick(&[100.0, 1.0, 3.6]);
        cycle.lead = Some(Lead { stamp_ns, gap, speed: 2.0 });
    }
    if let Some(stamp_ns) = stamp(draw, &cycle) {
        cycle.grid = Some(grid(draw, frame, stamp_ns));
    }
    cycle
}

/// Tracks and detections beside the road or, at times, on the CAV or on only one of the lists.
fn objects(draw: &mut Draw<'_>, frame: Frame, cycle: &mut Cycle) {
    const PLACES: [(f64, f64); 5] = [(9.0, 6.5), (30.0, 7.0), (9.0, 0.0), (0.5, 0.5), (20.0, -9.0)];
    let mut both = Vec::new();
    for id in 0..draw.below(3) {
        both.push((draw.pick(&PLACES), 1 + i64::try_from(id).unwrap_or(0)));
    }
    if let Some(stamp_ns) = stamp(draw, cycle) {
        let mut items: Vec<_> = both.iter().map(|(place, id)| track(frame, *place, *id)).collect();
        if draw.one_in(3) {
            items.push(track(frame, (8.0, -7.5), 40));
        }
        cycle.tracks = Some(TrackList { stamp_ns, items });
    }
    if let Some(stamp_ns) = stamp(draw, cycle) {
        let mut items: Vec<_> = both.iter().map(|(place, _)| detection(frame, *place)).collect();
        if draw.one_in(3) {
            // Clutter far off, behind the CAV: what a ghost is compared with.
            items.push(detection(frame, (-30.0, -9.0)));
        }
        cycle.detections = Some(DetectionList { stamp_ns, items });
    }
    if let Some(list) = cycle.detections.clone().filter(|_| draw.one_in(3)) {
        let dt_ns = draw.pick(&[200_000_000, 199_999_999, 1_000_000_000, 1_000_000_001, -1]);
        let stamp_ns = list.stamp_ns - dt_ns;
        cycle.detection_history = vec![DetectionList { stamp_ns, ..list }];
    }
}

/// When an input was made: at the borders of being current, well within, or well outside; `None`
/// leaves the input out.
fn stamp(draw: &mut Draw<'_>, cycle: &Cycle) -> Option<i64> {
    let max_age = cycle.parameters.max_age_ns;
    let age = match draw.below(8) {
        0 | 1 => 0,
        2 => draw.pick(&[max_age, max_age + 1, max_age - 1]),
        3 => draw.pick(&[-1, 0, 1]),
        4 => max_age / 2,
        5 => draw.pick(&[2 * max_age, 60_000_000_000, -60_000_000_000]),
        _ => return None,
    };
    Some(cycle.now_ns - age)
}

/// A grid around the CAV, free or with one occupied cell ahead of it.
fn grid(draw: &mut Draw<'_>, frame: Frame, stamp_ns: i64) -> Grid {
    let (x, y) = frame.at(-8.0, -8.0);
    let mut occupied = vec![0; 32];
    if draw.one_in(3) {
        occupied[17] = 0b10;
    }
    Grid {
        stamp_ns,
        x,
        y,
        cos: frame.cos,
        sin: frame.sin,
        resolution: 1.0,
        width: 16,
        height: 16,
        occupied,
        unknown: None,
    }
}

/// Whether some age lies at a border of being current; a stamp of exactly now is too common to
/// count.
pub fn is_near(cycle: &Cycle) -> bool {
    let stamps = [
        cycle.trajectory.as_ref().map(|list| list.stamp_ns),
        cycle.tracks.as_ref().map(|list| list.stamp_ns),
        cycle.detections.as_ref().map(|list| list.stamp_ns),
        cycle.lead.as_ref().map(|lead| lead.stamp_ns),
        cycle.grid.as_ref().map(|grid| grid.stamp_ns),
    ];
    stamps.into_iter().flatten().any(|stamp_ns| {
        let age = cycle.now_ns - stamp_ns;
        age == -1 || age == 1 || (age - cycle.parameters.max_age_ns).abs() <= 1
    })
}
