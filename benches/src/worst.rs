//! What adversarial inputs are made of. An attacker chooses tracks and trajectory; the vehicle, the route, the grid and
//! what is detected are the CAV's own.

use mufasa::input::cycle::{
    CrossSection, Cycle, Detection, DetectionList, Ego, Grid, Route, Track, TrackList, Trajectory,
    TrajectoryPoint,
};
use mufasa::input::parameters::Parameters;
use mufasa::input::profile::Profile;
use mufasa::services::configuration::Configuration;

/// Time of every cycle, ns.
pub const NOW_NS: i64 = 1_000_000_000;
const CELLS: i64 = 4096;

/// So many detections at the same place, 10 nm beside the CAV where it stands.
pub fn neighbours(still: &Cycle<'_>, count: u32) -> Vec<Detection> {
    let touching = 0.5 * (still.ego.width + 1.8) + 1e-8;
    (0..count).map(|_| detection(0.0, touching)).collect()
}

/// A list so many ms before now.
pub fn earlier(items: &[Detection], ms: i64) -> DetectionList<'_> {
    DetectionList { stamp_ns: NOW_NS - ms * 1_000_000, items }
}

/// With nothing in it yet; thresholds so large that everything is examined.
pub fn base<'a>(cross_sections: &'a [CrossSection], grid: &'a [u8]) -> Cycle<'a> {
    Cycle {
        profile: Profile::PAPER,
        parameters: Parameters {
            theta_tr: 512.0,
            theta_obj: 1e3,
            theta_track_max: 1e3,
            work_limit: 10_000_000_000,
            ..Parameters::default()
        },
        now_ns: NOW_NS,
        configuration: Configuration::AllRemote,
        ego: Ego {
            x: -1.0,
            y: 0.0,
            cos: 1.0,
            sin: 0.0,
            speed: 100.0,
            length: 4.8,
            width: 1.9,
            center_offset: 0.0,
        },
        trajectory: None,
        tracks: None,
        detections: None,
        lead: None,
        route: Route { closed: false, cross_sections },
        grid: Some(Grid {
            stamp_ns: NOW_NS,
            x: 0.0,
            y: 0.0,
            cos: 1.0,
            sin: 0.0,
            resolution: 0.01,
            width: CELLS,
            height: CELLS,
            occupied: grid,
            unknown: None,
        }),
        detection_history: &[],
    }
}

/// A road without width.
pub fn road(count: u32) -> Vec<CrossSection> {
    let cross_section = |i: u32| {
        let x = 0.02 * f64::from(i);
        CrossSection { x, y: 0.0, left: [x, 0.0], right: [x, 0.0] }
    };
    (0..count).map(cross_section).collect()
}

/// Of the size of a car.
pub fn track(id: i64, x: f64, y: f64) -> Track {
    Track { id, x, y, cos: 1.0, sin: 0.0, vx: 0.0, vy: 0.0, length: 4.5, width: 1.8 }
}

/// Of the size of a car.
pub fn detection(x: f64, y: f64) -> Detection {
    Detection { x, y, cos: 1.0, sin: 0.0, length: 4.5, width: 1.8 }
}

/// A point without its time.
pub fn point(x: f64, y: f64) -> TrajectoryPoint {
    TrajectoryPoint { t_ns: 0, x, y, cos: 1.0, sin: 0.0 }
}

/// The points a millisecond apart.
pub fn timed(mut points: Vec<TrajectoryPoint>) -> Vec<TrajectoryPoint> {
    for (point, t) in points.iter_mut().zip(0..) {
        point.t_ns = NOW_NS + t * 1_000_000;
    }
    points
}

/// A trajectory of now.
pub fn trajectory(points: &[TrajectoryPoint]) -> Trajectory<'_> {
    Trajectory { stamp_ns: NOW_NS, points }
}

/// Tracks of now.
pub fn tracks(items: &[Track]) -> TrackList<'_> {
    TrackList { stamp_ns: NOW_NS, items }
}

/// Detections of now.
pub fn list(items: &[Detection]) -> DetectionList<'_> {
    DetectionList { stamp_ns: NOW_NS, items }
}
