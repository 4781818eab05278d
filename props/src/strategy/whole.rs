//! Whole cycles: every configuration, every input present or missing, decided anywhere.

use mufasa_model::input::cycle::{Cycle, DetectionList, Grid, Lead, Profile, TrackList};
use mufasa_model::services::configuration::Configuration;

use super::base::{self, Frame};
use super::draw::Draw;
use super::{
    attack, detections, fail_safe, grid, map_validation, schedule, track_validation, tracks,
};

/// A cycle aimed at one stage, an attack or a schedule, with further inputs beside what it has.
pub fn cycle(draw: &mut Draw<'_>, profile: Profile) -> Cycle {
    let mut cycle = match draw.below(14) {
        0 | 1 => track_validation::cycle(draw, profile),
        2 | 3 => map_validation::cycle(draw, profile),
        4 | 5 => tracks::cycle(draw, profile),
        6..=8 => detections::cycle(draw, profile),
        9 | 10 => grid::cycle(draw, profile),
        11 => attack::cycle(draw, profile),
        12 => fail_safe::cycle(draw, profile),
        _ => schedule::cycle(draw, profile),
    };
    if draw.one_in(12) {
        cycle.configuration = draw.pick(&[
            Configuration::AllRemote,
            Configuration::MotRemote,
            Configuration::PlanRemote,
        ]);
    }
    if draw.one_in(4) {
        fill(draw, &mut cycle);
    }
    cycle
}

/// Harmless inputs in the place of missing ones.
fn fill(draw: &mut Draw<'_>, cycle: &mut Cycle) {
    let ego = &cycle.ego;
    let frame = Frame { x: ego.x, y: ego.y, cos: ego.cos, sin: ego.sin };
    let stamp_ns = cycle.now_ns;
    if cycle.trajectory.is_none() && draw.one_in(2) {
        cycle.trajectory = Some(base::straight(ego, frame, cycle.now_ns, &cycle.parameters));
    }
    if cycle.tracks.is_none() && draw.one_in(2) {
        let items = match draw.below(2) {
            0 => Vec::new(),
            _ => vec![track_validation::track(frame, (9.0, -11.0), 70)],
        };
        cycle.tracks = Some(TrackList { stamp_ns, items });
    }
    if cycle.detections.is_none() && draw.one_in(2) {
        let tracks = cycle.tracks.iter().flat_map(|list| &list.items);
        let items = tracks
            .map(|track| {
                let mut seen = track_validation::detection(frame, (0.0, 0.0));
                (seen.x, seen.y) = (track.x, track.y);
                seen
            })
            .collect();
        cycle.detections = Some(DetectionList { stamp_ns, items });
    }
    if cycle.lead.is_none() && draw.one_in(3) {
        cycle.lead = Some(Lead { stamp_ns, gap: 400.0, speed: 9.0 });
    }
    if cycle.grid.is_none() && draw.one_in(2) {
        let (x, y) = frame.at(-24.0, -24.0);
        let (cos, sin) = (frame.cos, frame.sin);
        let occupied = vec![0; 72];
        let mut grid = Grid {
            stamp_ns,
            x,
            y,
            cos,
            sin,
            resolution: 2.0,
            width: 24,
            height: 24,
            occupied,
            unknown: None,
        };
        if draw.one_in(4) {
            grid.occupied[draw.below(72)] = 1;
        }
        cycle.grid = Some(grid);
    }
}
