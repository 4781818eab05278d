//! The attacks of the paper's evaluation and the scenes of its findings
//! (`findings/README.md`), with sizes and places drawn.

use mufasa_model::input::cycle::{Cycle, DetectionList, Grid, Lead, Profile, TrackList};
use mufasa_model::services::configuration::Configuration;

use super::base::{self, Frame};
use super::draw::Draw;
use super::track_validation::{detection, track};

/// One of the attacks or findings.
pub fn cycle(draw: &mut Draw<'_>, profile: Profile) -> Cycle {
    const SCENES: [fn(&mut Draw<'_>, Frame, &mut Cycle); 9] = [
        wrong_map,
        empty_tracks,
        ghost_tracks,
        false_velocities,
        long_vehicle,
        standstill,
        made_up_lead,
        backwards,
        shifted_in_time,
    ];
    let frame = base::frame(draw);
    let mut cycle = base::cycle(draw, frame, profile, Configuration::AllRemote);
    draw.pick(&SCENES)(draw, frame, &mut cycle);
    cycle
}

/// The remote planner has another map: its trajectory follows another road.
pub fn wrong_map(draw: &mut Draw<'_>, frame: Frame, cycle: &mut Cycle) {
    let (cos, sin) = draw.pick(&[(0.96, 0.28), (0.6, 0.8), (0.0, -1.0), (1.0, 0.0)]);
    let (cos, sin) = frame.turn((cos, sin));
    let aside = draw.near(3.0);
    let (x, y) = frame.at(0.0, aside);
    let other = Frame { x, y, cos, sin };
    let ego = cycle.ego.clone();
    cycle.trajectory = Some(base::straight(&ego, other, cycle.now_ns, &cycle.parameters));
    cycle.detections = Some(DetectionList { stamp_ns: cycle.now_ns, items: Vec::new() });
}

/// The track list is spammed with empty lists while a car stands ahead (F-14).
pub fn empty_tracks(draw: &mut Draw<'_>, frame: Frame, cycle: &mut Cycle) {
    let ahead = 0.5 * (cycle.ego.length + 4.5) + cycle.ego.center_offset;
    let car = detection(frame, (draw.near(ahead), 0.0));
    cycle.tracks = Some(TrackList { stamp_ns: cycle.now_ns, items: Vec::new() });
    cycle.detections = Some(DetectionList { stamp_ns: cycle.now_ns, items: vec![car] });
}

/// Ghosts among true tracks, hidden in the mean or not (F-01, F-02).
pub fn ghost_tracks(draw: &mut Draw<'_>, frame: Frame, cycle: &mut Cycle) {
    let k = draw.between(1, 4);
    let places: Vec<_> = (0..k).map(|i| (20.0 + 8.0 * i as f64, 5.0)).collect();
    let mut items: Vec<_> = places.iter().zip(1..).map(|(p, id)| track(frame, *p, id)).collect();
    let threshold = cycle.parameters.theta_tr * (k + 1) as f64;
    let ghost = (20.0, 5.0 - draw.near(threshold));
    items.push(track(frame, ghost, 99));
    let mut seen: Vec<_> = places.iter().map(|place| detection(frame, *place)).collect();
    if draw.one_in(2) {
        seen.push(detection(frame, places[0]));
    }
    cycle.tracks = Some(TrackList { stamp_ns: cycle.now_ns, items });
    cycle.detections = Some(DetectionList { stamp_ns: cycle.now_ns, items: seen });
}

/// True positions, false velocities: the car ahead is said to move away (F-13).
pub fn false_velocities(draw: &mut Draw<'_>, frame: Frame, cycle: &mut Cycle) {
    let place = (draw.range(6.0, 14.0), 0.0);
    let mut car = track(frame, place, 7);
    (car.vx, car.vy) = (20.0 * frame.cos, 20.0 * frame.sin);
    let now_ns = cycle.now_ns;
    cycle.tracks = Some(TrackList { stamp_ns: now_ns, items: vec![car] });
    let items = vec![detection(frame, place)];
    cycle.detections = Some(DetectionList { stamp_ns: now_ns, items });
}

/// A lorry that overlaps although its centre is `theta_obj` away (F-03).
pub fn long_vehicle(draw: &mut Draw<'_>, frame: Frame, cycle: &mut Cycle) {
    cycle.configuration = Configuration::PlanRemote;
    let distance = draw.near(cycle.parameters.theta_obj);
    let mut lorry = track(frame, (cycle.ego.center_offset - distance, 0.0), 3);
    (lorry.length, lorry.width) = (12.0, 2.55);
    cycle.tracks = Some(TrackList { stamp_ns: cycle.now_ns, items: vec![lorry] });
}

/// The first step of a CAV at rest ends in an obstacle (F-06).
pub fn standstill(draw: &mut Draw<'_>, frame: Frame, cycle: &mut Cycle) {
    cycle.ego.speed = 0.0;
    let mut ego = cycle.ego.clone();
    ego.speed = draw.pick(&[2.0, 8.0]);
    cycle.trajectory = Some(base::straight(&ego, frame, cycle.now_ns, &cycle.parameters));
    let ahead = 0.5 * (ego.length + 4.5) + ego.center_offset + 0.2;
    let car = detection(frame, (draw.near(ahead), 0.0));
    cycle.detections = Some(DetectionList { stamp_ns: cycle.now_ns, items: vec![car] });
}

/// A leading vehicle, real or not, that shortens `s_valid` (F-05).
pub fn made_up_lead(draw: &mut Draw<'_>, frame: Frame, cycle: &mut Cycle) {
    let speed = draw.pick(&[30.0, 12.0, 0.0]);
    cycle.lead = Some(Lead { stamp_ns: cycle.now_ns, gap: 500.0, speed });
    let car = detection(frame, (draw.range(4.0, 20.0), 0.0));
    cycle.detections = Some(DetectionList { stamp_ns: cycle.now_ns, items: vec![car] });
}

/// A trajectory driven backwards, over a free or an unknown grid (F-10).
pub fn backwards(draw: &mut Draw<'_>, frame: Frame, cycle: &mut Cycle) {
    if let Some(trajectory) = &mut cycle.trajectory {
        for point in &mut trajectory.points {
            (point.cos, point.sin) = (-point.cos, -point.sin);
        }
    }
    let (x, y) = frame.at(-20.0, -20.0);
    let unknown = if draw.one_in(2) { Some(vec![255; 200]) } else { None };
    let (cos, sin) = (frame.cos, frame.sin);
    cycle.grid = Some(Grid {
        stamp_ns: cycle.now_ns,
        x,
        y,
        cos,
        sin,
        resolution: 1.0,
        width: 40,
        height: 40,
        occupied: vec![0; 200],
        unknown,
    });
}

/// All times of the trajectory far from now, so that every prediction is off (F-16).
pub fn shifted_in_time(draw: &mut Draw<'_>, frame: Frame, cycle: &mut Cycle) {
    let shift = draw.pick(&[5_000_000_000, -5_000_000_000, 100_000_001, 100_000_000]);
    if let Some(trajectory) = &mut cycle.trajectory {
        for point in &mut trajectory.points {
            point.t_ns += shift;
        }
    }
    let mut crossing = track(frame, (10.0, draw.range(-20.0, 20.0)), 5);
    (crossing.vx, crossing.vy) = (-8.0 * frame.sin, 8.0 * frame.cos);
    cycle.tracks = Some(TrackList { stamp_ns: cycle.now_ns, items: vec![crossing] });
}
