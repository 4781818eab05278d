//! Parameters of the stages and their defaults (`spec/3-stages.md`, paper Table II).

/// Parameters of the five stages; SI units, times in nanoseconds. Each default is the double
/// nearest to the decimal of `spec/3-stages.md` (I-12); domains in `spec/4-arithmetic.md#domain`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parameters {
    /// Stage i: the mean distance of the assigned pairs has to be below this, m.
    pub theta_tr: f64,
    /// Stage ii: farthest a point outside the corridor may be from the reference path, m.
    pub theta_map: f64,
    /// Stages iii and iv: objects nearer than this are examined, m.
    pub theta_obj: f64,
    /// Braking deceleration, m/s^2.
    pub a_b: f64,
    /// Time of the safety distance required by law, s.
    pub safety_time: f64,
    /// Oldest age at which data count as current, ns.
    pub max_age_ns: i64,
    /// Stage v: disks that cover the footprint.
    pub n: i64,
    /// H-01: every assigned pair has to be closer than this, m.
    pub theta_track_max: f64,
    /// H-01: gated tracks that may stay without a detection.
    pub miss_budget: i64,
    /// H-04: time before the CAV brakes, s.
    pub tau: f64,
    /// H-04, H-12: greatest acceleration of the CAV, m/s^2.
    pub a_max: f64,
    /// H-07, H-12: how far off the CAV a trajectory may start, m.
    pub start_tolerance: f64,
    /// H-11: greatest speed of a trajectory, m/s.
    pub v_max: f64,
    /// H-11: longest time between two trajectory points, ns.
    pub step_max_ns: i64,
    /// H-09: greatest error of the velocity of a track, m/s.
    pub theta_velocity: f64,
    /// Stage i fails rather than begin an assignment of more work than this.
    pub work_limit: i64,
    /// Margin of the strict and the lax model, m; no verdict of this crate depends on it.
    pub delta: f64,
}

impl Default for Parameters {
    fn default() -> Self {
        Self {
            theta_tr: 0.2,
            theta_map: 0.3,
            theta_obj: 5.0,
            a_b: 8.0,
            safety_time: 1.8,
            max_age_ns: 100_000_000,
            n: 4,
            theta_track_max: 1.0,
            miss_budget: 0,
            tau: 0.1,
            a_max: 3.0,
            start_tolerance: 2.0,
            v_max: 150.0,
            step_max_ns: 200_000_000,
            theta_velocity: 2.0,
            work_limit: 10_000_000_000,
            delta: 1e-6,
        }
    }
}
