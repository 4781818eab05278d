//! A cycle that every stage accepts with room to spare; generators move one thing of it to a
//! threshold.

use mufasa_model::input::cycle::{
    CrossSection, Cycle, Ego, Profile, Route, Trajectory, TrajectoryPoint,
};
use mufasa_model::input::parameters::Parameters;
use mufasa_model::services::configuration::Configuration;

use super::draw::Draw;

/// A frame in the world: the road's, the CAV's or an object's.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame {
    /// Origin, m.
    pub x: f64,
    /// Origin, m.
    pub y: f64,
    /// Direction.
    pub cos: f64,
    /// Direction.
    pub sin: f64,
}

impl Frame {
    /// The point (a, b) of the frame in the world, m.
    pub fn at(&self, a: f64, b: f64) -> (f64, f64) {
        (self.x + a * self.cos - b * self.sin, self.y + a * self.sin + b * self.cos)
    }

    /// A direction of the frame in the world.
    pub fn turn(&self, (cos, sin): (f64, f64)) -> (f64, f64) {
        (cos * self.cos - sin * self.sin, cos * self.sin + sin * self.cos)
    }
}

/// A road frame: at the origin, at UTM coordinates, or at the border of the domain; the
/// direction as in `Draw::direction`.
pub fn frame(draw: &mut Draw<'_>) -> Frame {
    const BORDER: f64 = 16_777_216.0;
    let (x, y) = match draw.below(8) {
        0..=3 => (0.0, 0.0),
        4 => (draw.range(-100.0, 100.0), draw.range(-100.0, 100.0)),
        5 => (573_412.25, 5_362_801.5),
        6 => (draw.range(5.6e5, 5.8e5), draw.range(5.35e6, 5.37e6)),
        _ => (BORDER - 300.0, 300.0 - BORDER),
    };
    let (cos, sin) = draw.direction();
    Frame { x, y, cos, sin }
}

/// A cycle without objects on a straight road in `frame`: a trajectory at constant speed along
/// the reference path until the CAV could stand, a corridor of half width 3 m.
pub fn cycle(
    draw: &mut Draw<'_>,
    frame: Frame,
    profile: Profile,
    configuration: Configuration,
) -> Cycle {
    let parameters = parameters(draw);
    let (length, width) = draw.pick(&[(4.8, 1.9), (4.0, 2.0), (12.0, 2.55), (2.0, 1.0)]);
    let ego = Ego {
        x: frame.x,
        y: frame.y,
        cos: frame.cos,
        sin: frame.sin,
        speed: speed(draw, frame, profile),
        length,
        width,
        center_offset: draw.pick(&[0.0, 1.4, 1.5, -0.25]),
    };
    let now_ns = draw.pick(&[1_000_000_000, 0, -7, i64::MAX - 70_000_000_000, 77_000_000_123]);
    let trajectory = Some(straight(&ego, frame, now_ns, &parameters));
    let route = road_to(frame, 3.0, end_of_road(&ego, &parameters));
    Cycle {
        profile,
        parameters,
        now_ns,
        configuration,
        ego,
        trajectory,
        tracks: None,
        detections: None,
        lead: None,
        route,
        grid: None,
        detection_history: Vec::new(),
    }
}

/// Whether the frame is not at the border of the domain, where a long road ends outside of it.
pub fn has_room(frame: Frame) -> bool {
    frame.x.abs() < 1.6e7
}

/// Mostly in a town; at times up to that of the domain, and in the hardened profile seldom, up to 32 m/s: the model
/// examines a place each 1/4 m of the way to a stop.
fn speed(draw: &mut Draw<'_>, frame: Frame, profile: Profile) -> f64 {
    let hardened = profile == Profile::HARDENED;
    let is_fast = draw.one_in(if hardened { 60 } else { 5 });
    if is_fast && has_room(frame) {
        return draw.range(4.0, if hardened { 5.0 } else { 7.2 }).exp2();
    }
    draw.pick(&[2.0, 0.0, 5.0, 8.0, 0.3, 10.0, 13.9])
}

/// The defaults or other values of the domain, and any margin.
fn parameters(draw: &mut Draw<'_>) -> Parameters {
    let mut parameters = Parameters::default();
    if draw.one_in(5) {
        parameters.theta_tr = draw.pick(&[0.25, 0.5, 1.0, 1e-3]);
        parameters.theta_map = draw.pick(&[0.5, 0.25, 1.0]);
        parameters.theta_obj = draw.pick(&[4.0, 8.0, 1.0]);
        parameters.a_b = draw.pick(&[8.0, 4.0, 6.5]);
        parameters.safety_time = draw.pick(&[1.5, 1.0, 2.0, 0.0]);
        parameters.tau = draw.pick(&[0.125, 0.0, 0.5]);
        parameters.a_max = draw.pick(&[2.0, 1.0, 4.0]);
        parameters.theta_track_max = draw.pick(&[0.5, 2.0, 0.3]);
        parameters.start_tolerance = draw.pick(&[1.0, 0.5, 3.0]);
        parameters.miss_budget = draw.pick(&[0, 1, 2, 64]);
        parameters.theta_velocity = draw.pick(&[1.0, 0.5, 4.0]);
        parameters.t_yield = draw.pick(&[0.0, 0.5, 30.0]);
        parameters.a_yield = draw.pick(&[1.0, 8.0]);
        parameters.lateral_tolerance = draw.pick(&[0.25, 1.0, 4.0]);
        parameters.work_limit = draw.pick(&[0, 1, 7, 8, 9, 30, i64::MAX]);
    }
    // The smallest margin asks the most of an implementation: half of the cases have it.
    parameters.delta = draw.pick(&[1e-6, 1e-6, 1e-8, 1e-8, 1e-8, 1e-7, 1e-4, 1e-2]);
    parameters
}

/// Constant speed along the frame's axis until `v_now` / `a_b`, below 40 m/s in steps that H-11 accepts,
/// above in fewer.
pub fn straight(ego: &Ego, frame: Frame, now_ns: i64, parameters: &Parameters) -> Trajectory {
    let is_town = ego.speed > 0.0 && ego.speed < 40.0;
    let step_s = if is_town { (0.9 * ego.length / ego.speed).min(0.2) } else { 0.2 };
    // No whole number of us, so that a program that rounds times is elsewhere.
    let dt_ns = (to_ns(step_s) / 1_000_000 * 1_000_000 - 123_457).max(1);
    let step_s = seconds(dt_ns);
    let mut points = Vec::new();
    let mut t_ns = now_ns;
    for i in 0..2 + count(ego.speed / parameters.a_b / step_s + 0.5) {
        let (x, y) = frame.at(ego.speed * step_s * i as f64, 0.0);
        points.push(TrajectoryPoint { t_ns, x, y, cos: frame.cos, sin: frame.sin });
        t_ns += dt_ns;
    }
    Trajectory { stamp_ns: now_ns, points }
}

/// Beyond all horizons of a CAV, 120 m ahead at least.
pub fn end_of_road(ego: &Ego, parameters: &Parameters) -> f64 {
    let v = ego.speed;
    (40.0 + 1.3 * (v * v / (2.0 * parameters.a_b) + parameters.safety_time * v)).max(120.0)
}

/// A straight road from 40 m behind to 120 m ahead of the frame.
pub fn road(frame: Frame, half_width: f64) -> Route {
    road_to(frame, half_width, 120.0)
}

/// The same to there.
pub fn road_to(frame: Frame, half_width: f64, end: f64) -> Route {
    let cross_sections = [-40.0, 0.0, 40.0, end];
    let cross_sections = cross_sections.map(|a| cross_section(frame, a, 0.0, half_width));
    Route { closed: false, cross_sections: cross_sections.to_vec() }
}

/// A cross section at (a, b) of the frame with boundaries `half_width` to both sides.
pub fn cross_section(frame: Frame, a: f64, b: f64, half_width: f64) -> CrossSection {
    let (x, y) = frame.at(a, b);
    let (left, right) = (frame.at(a, b + half_width), frame.at(a, b - half_width));
    CrossSection { x, y, left: [left.0, left.1], right: [right.0, right.1] }
}

/// Seconds of a time in ns.
#[expect(clippy::cast_precision_loss, reason = "a generator may round")]
pub fn seconds(ns: i64) -> f64 {
    ns as f64 / 1e9
}

/// Nanoseconds, rounded.
#[expect(clippy::cast_possible_truncation, reason = "a generator may round")]
pub fn to_ns(seconds: f64) -> i64 {
    (seconds * 1e9).round() as i64
}

/// The next whole number above, at most 1000; 0 for what is negative or not a number.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "clamped before")]
pub fn count(value: f64) -> usize {
    value.ceil().clamp(0.0, 1000.0) as usize
}

/// An object and the trajectory point at which it is where it is.
#[derive(Clone, Copy, Debug)]
pub struct Obstacle {
    /// Centre and direction.
    pub frame: Frame,
    /// Length and width, m.
    pub size: (f64, f64),
    /// Index of the trajectory point.
    pub point: usize,
    /// Unit vector away from the CAV's rectangle, along which it may move without harm.
    pub away: (f64, f64),
}

/// How hard tyres hold, m/s^2 (H-14.10).
pub fn a_tyre(parameters: &Parameters) -> f64 {
    parameters.a_b.max(11.5)
}

/// How far tyres move an object from its mean motion over dt at the age of a list, both s (SEEN-16, SEEN-17), m.
pub fn bend(parameters: &Parameters, dt: f64, age: f64) -> f64 {
    a_tyre(parameters) * (0.5 * age * (age - dt).abs())
}

/// `s_stop` of a trajectory that starts at the CAV, rounded, m.
pub fn s_stop(cycle: &Cycle) -> f64 {
    let (p, v) = (&cycle.parameters, cycle.ego.speed);
    let reached = v + p.a_max * p.tau;
    v * p.tau + p.a_max * p.tau * p.tau / 2.0 + reached * reached / (2.0 * p.a_b)
}
