//! The worst inputs that are known, of the sizes that a vehicle limits its lists to, and of what they are made.
//! An attacker chooses tracks and trajectory; the vehicle, the route, the grid and what is detected are the CAV's
//! own, and stage v is only as slow as this for a vehicle and a grid like these.

use mufasa::input::cycle::{
    CrossSection, Cycle, Detection, DetectionList, Ego, Grid, Route, Track, TrackList, Trajectory,
    TrajectoryPoint,
};
use mufasa::input::parameters::Parameters;
use mufasa::input::profile::Profile;
use mufasa::report::Stage;
use mufasa::services::configuration::Configuration;

use crate::contestant::Contestant;

/// Time of every cycle, ns.
pub const NOW_NS: i64 = 1_000_000_000;
const CELLS: i64 = 4096;

/// The same kinds of input in the sizes of docs/configuration.md, which are those of
/// `mufasa_monitor_settings_default`, hardened: no station can send more.
///
/// # Panics
/// Never: sizes fit their types.
pub fn vehicle(row: &mut dyn FnMut(Stage, &str, &Cycle<'_>)) {
    const TRACKS: u32 = 128;
    const POINTS: usize = 128;
    const DETECTIONS: u32 = 256;
    let cross_sections = road(640);
    let grid = vec![0; 4096 * 4096 / 8];
    let whole = base(&cross_sections, &grid);
    let work_limit = i64::from(TRACKS) * i64::from(TRACKS) * i64::from(DETECTIONS);
    let parameters = Parameters { work_limit, ..whole.parameters };
    let base = Cycle { profile: Profile::HARDENED, parameters, ..whole };

    let places = |count: u32, step: f64| (0..count).map(move |i| f64::from(i) * step);
    let line: Vec<_> = places(DETECTIONS, 1.0).map(|x| detection(x, 0.0)).collect();
    let crowd: Vec<_> = places(TRACKS, 0.001).zip(0..).map(|(y, id)| track(id, -1.0, y)).collect();
    // With the threshold of assignments() nothing is settled early.
    let parameters = Parameters { theta_tr: 0.2, ..parameters };
    let lists = Cycle { tracks: Some(tracks(&crowd)), detections: Some(list(&line)), ..base };
    let cycle = Cycle { parameters, ..lists };
    row(Stage::I, "128 tracks a millimetre apart, 256 detections in a row across", &cycle);
    let upon = timed(places(128, 0.1).map(|x| point(x, 0.0)).collect());
    let cycle = Cycle { trajectory: Some(trajectory(&upon)), ..base };
    row(Stage::Ii, "128 points on 640 cross sections of a road without width", &cycle);
    let standing = timed(vec![point(0.0, 0.0); POINTS]);
    let still = Cycle { trajectory: Some(trajectory(&standing)), ..base };
    let touching = 0.5 * (base.ego.width + 1.8) + 1e-8;
    let near: Vec<_> = (0..i64::from(TRACKS)).map(|id| track(id, 0.0, touching)).collect();
    let cycle = Cycle { tracks: Some(tracks(&near)), ..still };
    row(Stage::Iii, "128 tracks 10 nm beside the CAV at 128 points", &cycle);
    let far = [detection(0.0, 500.0)];
    let cycle = Cycle { detections: Some(list(&far)), ..cycle };
    row(Stage::Iv, "the same tracks in H-14, one detection far off", &cycle);
    let beside = neighbours(&still, DETECTIONS);
    let cycle = Cycle { detections: Some(list(&beside)), ..still };
    row(Stage::Iv, "256 detections 10 nm beside the CAV at 128 points", &cycle);
    // H-14 compares each with each at each point; beyond its limits it fails at once.
    let before = earlier(&beside, 500);
    let with = |count: usize| {
        (list(&beside[..count]), [DetectionList { items: &beside[..count], ..before }])
    };
    let passes = |count: &usize| {
        let (detections, history) = with(*count);
        let cycle = Cycle { detections: Some(detections), detection_history: &history, ..still };
        Contestant::new(&cycle).stage(Stage::Iv)
    };
    let most = (1..=beside.len()).rev().find(passes).unwrap_or(1);
    let (detections, history) = with(most);
    let cycle = Cycle { detections: Some(detections), detection_history: &history, ..still };
    let name = format!(
        "{most} of them, as many as its limits allow, with an earlier list like that (H-14)"
    );
    row(Stage::Iv, &name, &cycle);
    let creeping = timed(places(128, 0.008).map(|x| point(x, 0.0)).collect());
    let cycle = Cycle { trajectory: Some(trajectory(&creeping)), ..base };
    row(Stage::V, "128 points on an empty grid of 4096 x 4096 cells of 1 cm", &cycle);
}

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
