//! Parameters of the stages and their defaults (`spec/3-stages.md`, paper Table II).

/// Parameters of the five stages; SI units, times in nanoseconds. Each default is the double
/// nearest to the decimal of `spec/3-stages.md` (I-12); domains in `spec/4-arithmetic.md#domain`.
#[derive(Clone, Debug, PartialEq)]
pub struct Parameters {
    /// Average assignment cost threshold of stage i, m.
    pub theta_tr: f64,
    /// Trajectory to map threshold of stage ii, m.
    pub theta_map: f64,
    /// Distance below which the low-level collision check examines an object, m.
    pub theta_obj: f64,
    /// Braking deceleration, m/s^2.
    pub a_b: f64,
    /// Time of the legal safety distance, s.
    pub safety_time: f64,
    /// Oldest age at which data count as current, ns.
    pub max_age_ns: i64,
    /// Number of disks that cover the footprint in stage v.
    pub n: i64,
    /// H-01: largest distance of a matched pair, m.
    pub theta_track_max: f64,
    /// H-01: gated tracks that may stay unmatched.
    pub miss_budget: i64,
    /// H-04: reaction time, s.
    pub tau: f64,
    /// H-04, H-12: largest acceleration of the CAV, m/s^2.
    pub a_max: f64,
    /// H-07, H-12: distance by which a trajectory may start off the CAV, m.
    pub start_tolerance: f64,
    /// H-11: largest speed of a trajectory, m/s.
    pub v_max: f64,
    /// H-11: longest time between trajectory points, ns.
    pub step_max_ns: i64,
    /// H-09: largest error of a track's velocity, m/s.
    pub theta_velocity: f64,
    /// Stage i: the strict reading fails when the assignment takes more work.
    pub work_limit: i64,
    /// Margin of the strict and the lax reading, m (`spec/4-arithmetic.md#strict-and-lax`).
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
