//! Stage iv at its thresholds: gap and collisions
//! (`spec/3-stages.md#stage-iv-trajectory-with-detections`).

use mufasa_model::input::cycle::{Cycle, Detection, DetectionList, Lead, Profile, TrackList};
use mufasa_model::services::configuration::Configuration;

use super::base::{self, Obstacle};
use super::draw::Draw;
use super::track_validation::detection;
use super::{moving, obstacle};

/// A cycle that stage iv decides.
pub fn cycle(draw: &mut Draw<'_>, profile: Profile) -> Cycle {
    let frame = base::frame(draw);
    let configuration =
        draw.pick(&[Configuration::MotRemote, Configuration::AllRemote, Configuration::PlanRemote]);
    let mut cycle = base::cycle(draw, frame, profile, configuration);
    obstacle::widen(&mut cycle, frame);
    if draw.below(3) > 0 {
        let speed = draw.pick(&[0.0, 2.0, 5.0, 8.0, 12.0, 16.0]);
        let stamp_ns = cycle.now_ns - draw.pick(&[0, 50_000_000]);
        cycle.lead = Some(Lead { stamp_ns, gap: 1000.0, speed });
        if draw.below(3) == 0 {
            return at_gap(draw, cycle);
        }
    }
    if profile == Profile::Hardened && draw.one_in(2) {
        return moving::cycle(draw, cycle);
    }
    let horizon = obstacle::horizon_of_detections(&cycle);
    let found = obstacle::decisive(draw, &mut cycle, horizon);
    let mut items = Vec::new();
    if draw.one_in(4) {
        items.push(detection(frame, (-30.0, 2.0)));
    }
    items.push(standing(found));
    let age = if draw.one_in(8) { draw.near_ns(cycle.parameters.max_age_ns) } else { 0 };
    cycle.detections = Some(DetectionList { stamp_ns: cycle.now_ns - age, items });
    cycle
}

/// A lead whose gap is near `s_follow`, with nothing else that could fail; in the hardened
/// profile at times without detections, or beside a stage iii that ran (H-04).
fn at_gap(draw: &mut Draw<'_>, mut cycle: Cycle) -> Cycle {
    let gap = draw.near(obstacle::s_follow(&cycle)).max(0.0);
    if let Some(lead) = &mut cycle.lead {
        lead.gap = gap;
    }
    let empty = DetectionList { stamp_ns: cycle.now_ns, items: Vec::new() };
    let tracks = TrackList { stamp_ns: cycle.now_ns, items: Vec::new() };
    match (cycle.profile, draw.below(4)) {
        (Profile::Hardened, 0) => cycle.tracks = Some(tracks),
        (Profile::Hardened, 1) => {
            cycle.tracks = Some(tracks);
            cycle.detections = Some(empty);
        }
        (Profile::Paper | Profile::Hardened, _) => cycle.detections = Some(empty),
    }
    cycle
}

/// The obstacle as a detection.
fn standing(found: Obstacle) -> Detection {
    let base::Frame { x, y, cos, sin } = found.frame;
    let (length, width) = found.size;
    Detection { x, y, cos, sin, length, width }
}
