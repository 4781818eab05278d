//! A small cycle that is safe in every configuration of both profiles, of which a vector changes
//! one thing.

use mufasa_model::input::cycle::{
    CrossSection, Cycle, Detection, DetectionList, Ego, Grid, Lead, Profile, Route, Track,
    TrackList, Trajectory, TrajectoryPoint,
};
use mufasa_model::input::parameters::Parameters;
use mufasa_model::services::configuration::Configuration;

/// Time of the decision, ns.
pub const NOW: i64 = 1_000_000_000;
/// A tenth of a second, ns: the time from point to point, and the largest age.
pub const TENTH: i64 = 100_000_000;

/// Straight road along x, corridor 3 m to each side; CAV of 4 m by 2 m at the origin, 10 m/s; 21
/// points 0.1 s and 1 m apart; a car 60 m ahead, tracked and detected; a free grid of 10 m cells.
pub fn base(profile: Profile, configuration: Configuration) -> Cycle {
    Cycle {
        profile,
        parameters: Parameters::default(),
        now_ns: NOW,
        configuration,
        ego: Ego {
            x: 0.0,
            y: 0.0,
            cos: 1.0,
            sin: 0.0,
            speed: 10.0,
            length: 4.0,
            width: 2.0,
            center_offset: 0.0,
        },
        trajectory: Some(straight(21, 1.0)),
        tracks: Some(tracks(vec![track(1, 60.0, 0.0)])),
        detections: Some(detections(vec![detection(60.0, 0.0)])),
        lead: None,
        route: road(-100.0, 200.0),
        grid: Some(grid(10.0, [10, 4], [-20.0, -20.0])),
        previous_tracks: None,
    }
}

/// The cycle after a change.
pub fn with(mut cycle: Cycle, change: impl FnOnce(&mut Cycle)) -> Cycle {
    change(&mut cycle);
    cycle
}

/// Points along x from 0, `step` m and 0.1 s apart.
pub fn straight(count: u32, step: f64) -> Trajectory {
    points((0..count).map(|i| point(i64::from(i) * TENTH, f64::from(i) * step, 0.0)).collect())
}

/// A current trajectory.
pub fn points(points: Vec<TrajectoryPoint>) -> Trajectory {
    Trajectory { stamp_ns: NOW, points }
}

/// A point that looks along x, `after_ns` after now.
pub fn point(after_ns: i64, x: f64, y: f64) -> TrajectoryPoint {
    TrajectoryPoint { t_ns: NOW + after_ns, x, y, cos: 1.0, sin: 0.0 }
}

/// The points of a cycle's trajectory; none without one.
pub fn points_of(cycle: &mut Cycle) -> &mut [TrajectoryPoint] {
    cycle.trajectory.as_mut().map_or(&mut [], |trajectory| &mut trajectory.points)
}

/// Moves a point of a cycle's trajectory to (x, y).
pub fn move_point(cycle: &mut Cycle, index: usize, [x, y]: [f64; 2]) {
    if let Some(point) = points_of(cycle).get_mut(index) {
        (point.x, point.y) = (x, y);
    }
}

/// Turns every point of a cycle's trajectory.
pub fn turn(cycle: &mut Cycle, cos: f64, sin: f64) {
    for point in points_of(cycle) {
        (point.cos, point.sin) = (cos, sin);
    }
}

/// Moves a cycle's trajectory in time.
pub fn shift(cycle: &mut Cycle, by_ns: i64) {
    for point in points_of(cycle) {
        point.t_ns += by_ns;
    }
}

/// A straight road along x, 3 m to each side.
pub fn road(from: f64, to: f64) -> Route {
    Route { closed: false, cross_sections: vec![cross_section(from, 3.0), cross_section(to, 3.0)] }
}

/// A cross section at (x, 0) of a road along x, `half` m to each side.
pub fn cross_section(x: f64, half: f64) -> CrossSection {
    CrossSection { x, y: 0.0, left: [x, half], right: [x, -half] }
}

/// A standing car of 4 m by 2 m that looks along x.
pub fn track(id: i64, x: f64, y: f64) -> Track {
    Track { id, x, y, cos: 1.0, sin: 0.0, vx: 0.0, vy: 0.0, length: 4.0, width: 2.0 }
}

/// The same car detected.
pub fn detection(x: f64, y: f64) -> Detection {
    Detection { x, y, cos: 1.0, sin: 0.0, length: 4.0, width: 2.0 }
}

/// A current track list.
pub fn tracks(items: Vec<Track>) -> TrackList {
    TrackList { stamp_ns: NOW, items }
}

/// A current detection list.
pub fn detections(items: Vec<Detection>) -> DetectionList {
    DetectionList { stamp_ns: NOW, items }
}

/// A current leading vehicle.
pub fn lead(gap: f64, speed: f64) -> Option<Lead> {
    Some(Lead { stamp_ns: NOW, gap, speed })
}

/// A current free grid along x with its corner at (x, y).
pub fn grid(resolution: f64, [width, height]: [u8; 2], [x, y]: [f64; 2]) -> Grid {
    Grid {
        stamp_ns: NOW,
        x,
        y,
        cos: 1.0,
        sin: 0.0,
        resolution,
        width: width.into(),
        height: height.into(),
        occupied: vec![0; (usize::from(width) * usize::from(height)).div_ceil(8)],
        unknown: None,
    }
}

/// 40 x 24 free cells of 1 m with the corner at (-12, -12).
pub fn fine_grid() -> Grid {
    grid(1.0, [40, 24], [-12.0, -12.0])
}

/// A bitmap of the fine grid with one cell set: that of column `x` and row `y`, counted from the
/// corner cell at (-12, -12) to (-11, -11).
pub fn cell(x: usize, y: usize) -> Vec<u8> {
    let (bit, mut bitmap) = (y * 40 + x, vec![0; 120]);
    if let Some(byte) = bitmap.get_mut(bit / 8) {
        *byte = 1 << (bit % 8);
    }
    bitmap
}
