//! A drive along a straight road.

use mufasa_model::input::cycle::{
    CrossSection, Cycle, Detection, DetectionList, Ego, Profile, Route, Track, TrackList,
    Trajectory, TrajectoryPoint,
};
use mufasa_model::input::parameters::Parameters;
use mufasa_model::services::configuration::Configuration;

/// Cycle number `index` at 10 m/s and 10 Hz; a car stands beside the road, or in the way of the
/// trajectory when `blocked`.
pub fn cycle(index: u32, blocked: bool) -> Cycle {
    let now_ns = 1_000_000_000 + i64::from(index) * 100_000_000;
    let x = f64::from(index);
    let (car_x, car_y) = if blocked { (x + 9.0, 0.0) } else { (x + 30.0, 8.0) };
    let point = |k: u32| TrajectoryPoint {
        t_ns: now_ns + i64::from(k) * 100_000_000,
        x: x + f64::from(k),
        y: 0.0,
        cos: 1.0,
        sin: 0.0,
    };
    let cross_section = |x: i32| CrossSection {
        x: f64::from(x),
        y: 0.0,
        left: [x.into(), 2.0],
        right: [x.into(), -2.0],
    };
    let car = Detection { x: car_x, y: car_y, cos: 1.0, sin: 0.0, length: 4.5, width: 1.8 };
    let track = Track {
        id: 7,
        x: car_x,
        y: car_y,
        cos: 1.0,
        sin: 0.0,
        vx: 0.0,
        vy: 0.0,
        length: 4.5,
        width: 1.8,
    };
    Cycle {
        profile: Profile::HARDENED,
        parameters: Parameters::default(),
        now_ns,
        configuration: Configuration::AllRemote,
        ego: Ego {
            x,
            y: 0.0,
            cos: 1.0,
            sin: 0.0,
            speed: 10.0,
            length: 4.8,
            width: 1.9,
            center_offset: 1.4,
        },
        trajectory: Some(Trajectory { stamp_ns: now_ns, points: (0..40).map(point).collect() }),
        tracks: Some(TrackList { stamp_ns: now_ns, items: vec![track] }),
        detections: Some(DetectionList { stamp_ns: now_ns, items: vec![car] }),
        lead: None,
        route: Route {
            closed: false,
            cross_sections: (-2..40).map(|k| cross_section(k * 10)).collect(),
        },
        grid: None,
        detection_history: Vec::new(),
    }
}
