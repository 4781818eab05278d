//! What the searches are made of.

use crate::input::cycle::{
    Cycle, Detection, DetectionList, Grid, Profile, Track, TrackList, Trajectory,
};
use crate::numbers::real::Real;
use crate::numbers::real::formula::{Formula, at_most, less};
use crate::numbers::real::hole::open_number;
use crate::services::configuration::Configuration;
use crate::theorem::base::{self, NOW_NS};

/// The CAV at 3 m/s; a car at (4.5, -4), seen 500 ms ago at (4.5, before), and one at 60 m that is tracked.
pub fn crossed(cycle: &mut Cycle) {
    cycle.ego.speed = 3.0;
    straight(cycle, &[0.0, 0.5, 1.0]);
    tracks(cycle, vec![track(1, 60.0)]);
    let car = |y: f64| Detection { y, ..detection(4.5) };
    seen(cycle, vec![detection(60.0), car(-4.0)]);
    let items = vec![car(open_number("before"))];
    cycle.detection_history = vec![DetectionList { stamp_ns: NOW_NS - 500_000_000, items }];
}

/// It crosses at 7 to 8 m/s.
pub fn crossing() -> Vec<Formula> {
    vec![within("before", -8, -7), up_to("before", -15, 2)]
}

/// The CAV at v_now, above 2 a_b safety_time = 3.2 m/s (F-04).
pub fn hurried(cycle: &mut Cycle) {
    cycle.ego.speed = open_number("v_now");
    cycle.parameters.safety_time = 0.2;
    straight(cycle, &[0.0, 0.4, 0.8, 0.95, 1.35]);
}

/// v_now is at most 4.25 m/s, and the car at x meets the CAV 0.95 m along: behind s_CAV, which is at
/// most 0.85 m, and before s_b, which is 1 m at least.
pub fn met_too_late() -> Vec<Formula> {
    let slow = [within("v_now", 4, 5), up_to("v_now", 17, 4)];
    [slow, [within("x", 4, 5), up_to("x", 495, 100)]].concat()
}

/// Nothing but a CAV that stands at a point; H-07 forgives what is off by 1 km.
pub fn bare(profile: Profile, configuration: Configuration) -> Cycle {
    let mut cycle = base::cycle(profile, configuration);
    cycle.parameters.start_tolerance = 1000.0;
    cycle
}

/// The number of this name is from `least` to `most`.
pub fn within(name: &str, least: i64, most: i64) -> Formula {
    Formula::All(vec![at_most(&Real::ratio(least, 1), &Real::named(name)), up_to(name, most, 1)])
}

/// It is at most `numerator / denominator`.
pub fn up_to(name: &str, numerator: i64, denominator: i64) -> Formula {
    at_most(&Real::named(name), &Real::ratio(numerator, denominator))
}

/// It is less.
pub fn below(name: &str, numerator: i64, denominator: i64) -> Formula {
    less(&Real::named(name), &Real::ratio(numerator, denominator))
}

/// It is greater.
pub fn above(name: &str, numerator: i64, denominator: i64) -> Formula {
    less(&Real::ratio(numerator, denominator), &Real::named(name))
}

/// The point with this index is y m aside.
pub fn aside(cycle: &mut Cycle, index: usize) {
    cycle.trajectory.iter_mut().for_each(|list| list.points[index].y = open_number("y"));
}

/// Points along x, 200 ms apart.
pub fn straight(cycle: &mut Cycle, places: &[f64]) {
    cycle.trajectory = Some(every(200_000_000, places));
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

pub fn tracks(cycle: &mut Cycle, items: Vec<Track>) {
    cycle.tracks = Some(TrackList { stamp_ns: NOW_NS, items });
}

pub fn track(id: i64, x: f64) -> Track {
    Track { id, x, y: 0.0, cos: 1.0, sin: 0.0, vx: 0.0, vy: 0.0, length: 4.0, width: 2.0 }
}

pub fn seen(cycle: &mut Cycle, items: Vec<Detection>) {
    cycle.detections = Some(DetectionList { stamp_ns: NOW_NS, items });
}

pub fn detection(x: f64) -> Detection {
    Detection { x, y: 0.0, cos: 1.0, sin: 0.0, length: 4.0, width: 2.0 }
}

/// One of them.
pub fn detections(cycle: &mut Cycle, x: f64) {
    seen(cycle, vec![detection(x)]);
}
