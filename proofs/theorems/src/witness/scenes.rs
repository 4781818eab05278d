//! What the searches are made of.

use crate::input::cycle::{
    Cycle, Detection, DetectionList, Grid, Profile, Track, TrackList, Trajectory,
};
use crate::numbers::real::Real;
use crate::numbers::real::formula::{Formula, at_most};
use crate::numbers::real::hole::open_number;
use crate::services::configuration::Configuration::{self, MotRemote};
use crate::theorem::base::{self, NOW_NS};

/// The CAV at 3 m/s; a car at (4.5, -4), seen 500 ms ago at (4.5, before), and one at 60 m that is tracked.
pub fn crossed(profile: Profile) -> Cycle {
    let mut cycle = bare(profile, MotRemote);
    cycle.ego.speed = 3.0;
    cycle.trajectory = Some(straight(&[0.0, 0.5, 1.0]));
    cycle.tracks = Some(tracks(vec![track(1, 60.0)]));
    let car = |y: f64| Detection { y, ..detections(4.5).items[0].clone() };
    let mut seen = detections(60.0);
    seen.items.push(car(-4.0));
    cycle.detections = Some(seen);
    let items = vec![car(open_number("before"))];
    cycle.detection_history = vec![DetectionList { stamp_ns: NOW_NS - 500_000_000, items }];
    cycle
}

/// It crosses at 7 to 8 m/s.
pub fn crossing() -> Formula {
    both(within("before", -8, -7), at_most(&Real::named("before"), &Real::ratio(-15, 2)))
}

/// The CAV at v_now, above 2 a_b safety_time = 3.2 m/s (F-04).
pub fn hurried(profile: Profile, configuration: Configuration) -> Cycle {
    let mut cycle = bare(profile, configuration);
    cycle.ego.speed = open_number("v_now");
    cycle.parameters.safety_time = 0.2;
    cycle.trajectory = Some(straight(&[0.0, 0.4, 0.8, 0.95, 1.35]));
    cycle
}

/// v_now is at most 4.25 m/s, and the car at x meets the CAV 0.95 m along: behind s_CAV, which is at
/// most 0.85 m, and before s_b, which is 1 m at least.
pub fn met_too_late() -> Formula {
    let [x, v_now] = ["x", "v_now"].map(Real::named);
    let slow = at_most(&v_now, &Real::ratio(17, 4));
    both(slow, both(within("x", 4, 5), at_most(&x, &Real::ratio(495, 100))))
}

/// Nothing but a CAV that stands at a point; H-07 forgives what is off by 1 km.
pub fn bare(profile: Profile, configuration: Configuration) -> Cycle {
    let mut cycle = base::cycle(profile, configuration);
    cycle.parameters.start_tolerance = 1000.0;
    cycle
}

pub fn integer(value: i64) -> Real {
    Real::from_integer(value.into())
}

pub fn both(a: Formula, b: Formula) -> Formula {
    Formula::All(vec![a, b])
}

pub fn within(name: &str, least: i64, most: i64) -> Formula {
    let number = Real::named(name);
    both(at_most(&integer(least), &number), at_most(&number, &integer(most)))
}

/// Points along x, 200 ms apart.
pub fn straight(places: &[f64]) -> Trajectory {
    every(200_000_000, places)
}

/// Points along x, so many ns apart.
pub fn every(step_ns: i64, places: &[f64]) -> Trajectory {
    let point = |(i, x): (i64, &f64)| base::point(NOW_NS + i * step_ns, *x, 0.0);
    Trajectory { stamp_ns: NOW_NS, points: (0..).zip(places).map(point).collect() }
}

/// 24 by 24 cells of 1 m with the corner at (-12, -12), of which one is occupied.
pub fn grid(column: usize, row: usize) -> Grid {
    let (bit, mut occupied) = (row * 24 + column, vec![0; 72]);
    occupied[bit / 8] = 1 << (bit % 8);
    Grid {
        stamp_ns: NOW_NS,
        x: -12.0,
        y: -12.0,
        cos: 1.0,
        sin: 0.0,
        resolution: 1.0,
        width: 24,
        height: 24,
        occupied,
        unknown: None,
    }
}

pub fn tracks(items: Vec<Track>) -> TrackList {
    TrackList { stamp_ns: NOW_NS, items }
}

pub fn track(id: i64, x: f64) -> Track {
    Track { id, x, y: 0.0, cos: 1.0, sin: 0.0, vx: 0.0, vy: 0.0, length: 4.0, width: 2.0 }
}

pub fn detections(x: f64) -> DetectionList {
    let detection = Detection { x, y: 0.0, cos: 1.0, sin: 0.0, length: 4.0, width: 2.0 };
    DetectionList { stamp_ns: NOW_NS, items: vec![detection] }
}
