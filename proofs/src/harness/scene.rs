//! One scene in which every input can be missing, too old, harmless or harmful: a straight road, a
//! CAV that creeps along it, an object beside it or on its way.

use mufasa::input::cycle::{
    CrossSection, Cycle, Detection, DetectionList, Ego, Grid, Lead, Route, Track, TrackList,
    Trajectory, TrajectoryPoint,
};
use mufasa::input::parameters::Parameters;
use mufasa::input::profile::Profile;
use mufasa::services::configuration::Configuration;

/// How an input is: what a stage sees of it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Given {
    /// `None`.
    Missing,
    /// Older than `max_age`.
    Old,
    /// Current, and no stage objects.
    Harmless,
    /// Current, and the stage that reads it fails.
    Harmful,
}

impl Given {
    /// All kinds.
    pub const ALL: [Self; 4] = [Self::Missing, Self::Old, Self::Harmless, Self::Harmful];
}

/// Time of the decision, ns.
pub const NOW_NS: i64 = 1_000_000_000;
const OLD_NS: i64 = 800_000_000;

const fn cross_section(x: f64) -> CrossSection {
    CrossSection { x, y: 0.0, left: [x, 3.0], right: [x, -3.0] }
}

const fn point(t_ns: i64, x: f64, y: f64) -> TrajectoryPoint {
    TrajectoryPoint { t_ns, x, y, cos: 1.0, sin: 0.0 }
}

const fn track(id: i64, x: f64, y: f64) -> Track {
    Track { id, x, y, cos: 1.0, sin: 0.0, vx: 0.0, vy: 0.0, length: 4.0, width: 2.0 }
}

const fn detection(x: f64, y: f64) -> Detection {
    Detection { x, y, cos: 1.0, sin: 0.0, length: 4.0, width: 2.0 }
}

/// The road, 6 m wide.
pub const CROSS_SECTIONS: [CrossSection; 3] =
    [cross_section(-40.0), cross_section(0.0), cross_section(80.0)];
/// Along the road at 2 m/s.
pub const STRAIGHT: [TrajectoryPoint; 4] = [
    point(NOW_NS, 0.0, 0.0),
    point(NOW_NS + 200_000_000, 0.4, 0.0),
    point(NOW_NS + 400_000_000, 0.8, 0.0),
    point(NOW_NS + 600_000_000, 1.2, 0.0),
];
const OFF_ROAD: [TrajectoryPoint; 1] = [point(NOW_NS, 0.0, 9.0)];
/// A car beside the road.
pub const BESIDE: [Track; 1] = [track(1, 12.0, 20.0)];
/// One more where nothing is seen, before the CAV.
const AHEAD: [Track; 2] = [track(1, 12.0, 20.0), track(2, 3.0, 0.0)];
/// The car beside the road and something farther away.
pub const SEEN_BESIDE: [Detection; 2] = [detection(12.0, 20.0), detection(-30.0, -20.0)];
const SEEN_AHEAD: [Detection; 2] = [detection(12.0, 20.0), detection(3.0, 0.0)];
/// No cell of 40 by 40.
pub const FREE: [u8; 200] = [0; 200];
const FULL: [u8; 200] = [255; 200];

/// The CAV at the origin.
pub const EGO: Ego = Ego {
    x: 0.0,
    y: 0.0,
    cos: 1.0,
    sin: 0.0,
    speed: 2.0,
    length: 4.0,
    width: 2.0,
    center_offset: 0.0,
};

/// The cycle with these inputs: trajectory, tracks, detections, lead, grid.
pub fn cycle(profile: Profile, configuration: Configuration, given: [Given; 5]) -> Cycle<'static> {
    let stamp = |given| match given {
        Given::Missing => None,
        Given::Old => Some((OLD_NS, false)),
        Given::Harmless => Some((NOW_NS, false)),
        Given::Harmful => Some((NOW_NS, true)),
    };
    let [trajectory, tracks, detections, lead, grid] = given.map(stamp);
    Cycle {
        configuration,
        trajectory: trajectory.map(|(stamp_ns, harmful)| {
            let points: &[TrajectoryPoint] = if harmful { &OFF_ROAD } else { &STRAIGHT };
            Trajectory { stamp_ns, points }
        }),
        tracks: tracks.map(|(stamp_ns, harmful)| {
            let items: &[Track] = if harmful { &AHEAD } else { &BESIDE };
            TrackList { stamp_ns, items }
        }),
        detections: detections.map(|(stamp_ns, harmful)| {
            let items = if harmful { &SEEN_AHEAD } else { &SEEN_BESIDE };
            DetectionList { stamp_ns, items }
        }),
        lead: lead.map(|(stamp_ns, harmful)| {
            let gap = if harmful { 1.0 } else { 100.0 };
            Lead { stamp_ns, gap, speed: 2.0 }
        }),
        route: Route { closed: false, cross_sections: &CROSS_SECTIONS },
        grid: grid.map(|(stamp_ns, harmful)| Grid {
            stamp_ns,
            x: -20.0,
            y: -20.0,
            cos: 1.0,
            sin: 0.0,
            resolution: 1.0,
            width: 40,
            height: 40,
            occupied: if harmful { &FULL } else { &FREE },
            unknown: None,
        }),
        ..alone(profile, Parameters::default(), EGO, NOW_NS)
    }
}

/// The CAV and its parameters alone, in `AllRemote`. No list of it depends on a choice, or places in memory
/// would.
pub fn alone(profile: Profile, parameters: Parameters, ego: Ego, now_ns: i64) -> Cycle<'static> {
    Cycle {
        profile,
        parameters,
        now_ns,
        configuration: Configuration::AllRemote,
        ego,
        trajectory: None,
        tracks: None,
        detections: None,
        lead: None,
        route: Route { closed: false, cross_sections: &[] },
        grid: None,
        detection_history: &[],
    }
}
