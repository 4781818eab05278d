//! Stage iv at its thresholds: gap and collisions
//! (`spec/3-stages.md#stage-iv-trajectory-with-detections`).

use mufasa_model::input::cycle::{Cycle, Detection, DetectionList, Lead, Profile, TrackList};
use mufasa_model::services::configuration::Configuration;

use super::base::{self, Obstacle};
use super::draw::Draw;
use super::track_validation::detection;
use super::{fail_safe, obstacle};

/// A cycle that stage iv decides.
pub fn cycle(draw: &mut Draw<'_>, profile: Profile) -> Cycle {
    let frame = base::frame(draw);
    let configuration =
        draw.pick(&[Configuration::MotRemote, Configuration::AllRemote, Configuration::PlanRemote]);
    let mut cycle = base::cycle(draw, frame, profile, configuration);
    obstacle::widen(&mut cycle, frame);
    if draw.below(3) > 0 {
        let mut speed = draw.pick(&[0.0, 2.0, 5.0, 8.0, 12.0, 16.0]);
        if cycle.ego.speed > 16.0 {
            speed = (draw.range(0.1, 1.1) * cycle.ego.speed).min(150.0);
        }
        let stamp_ns = cycle.now_ns - draw.pick(&[0, 50_000_000]);
        cycle.lead = Some(Lead { stamp_ns, gap: 1000.0, speed });
        if draw.below(3) == 0 {
            return at_gap(draw, cycle);
        }
    }
    if profile == Profile::HARDENED && draw.one_in(2) {
        let aim = draw.below(fail_safe::AIMS.len());
        fail_safe::decide(draw, &mut cycle, fail_safe::AIMS[aim]);
        return cycle;
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

/// A lead whose gap is near `s_follow`, with nothing else that could fail; in the hardened profile at
/// times near what H-04 asks for, without detections, or beside a stage iii that ran (H-04).
fn at_gap(draw: &mut Draw<'_>, mut cycle: Cycle) -> Cycle {
    let follows = cycle.profile == Profile::PAPER || draw.one_in(2);
    if !follows && let Some(lead) = &mut cycle.lead {
        lead.stamp_ns = cycle.now_ns - draw.pick(&[0, 0, 30_000_000, cycle.parameters.max_age_ns]);
    }
    let gap = if follows { obstacle::s_follow(&cycle) } else { obstacle::least_gap(&cycle) };
    let gap = draw.near(gap).max(0.0);
    if let Some(lead) = &mut cycle.lead {
        lead.gap = gap;
    }
    let stamp_ns = cycle.now_ns;
    cycle.detections = Some(DetectionList { stamp_ns, items: Vec::new() });
    if !follows {
        // Stage iii runs in the place of stage iv.
        cycle.tracks = Some(TrackList { stamp_ns, items: Vec::new() });
        if cycle.configuration == Configuration::MotRemote {
            cycle.configuration = Configuration::AllRemote;
        }
        if cycle.configuration == Configuration::PlanRemote && draw.one_in(2) {
            cycle.detections = None;
        }
    }
    cycle
}

/// The obstacle as a detection.
fn standing(found: Obstacle) -> Detection {
    let base::Frame { x, y, cos, sin } = found.frame;
    let (length, width) = found.size;
    Detection { x, y, cos, sin, length, width }
}
