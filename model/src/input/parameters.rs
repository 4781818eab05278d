//! Parameters of the stages, their defaults and their domains (`spec/3-stages.md`, paper Table II;
//! `spec/4-arithmetic.md#domain`).

/// The list of the parameters, and the only place where they stand: `parameters!(callback)` expands
/// to `callback! { .. }` with one entry for each, in this order:
/// `/// documentation` `name: type = default in domain;`, where the type is `f64` or `i64`.
#[macro_export]
macro_rules! parameters {
    ($callback:ident) => {
        $callback! {
            /// Average assignment cost threshold of stage i, m.
            theta_tr: f64 = 0.2 in 1e-3..=1e3;
            /// Trajectory to map threshold of stage ii, m.
            theta_map: f64 = 0.3 in 1e-3..=1e3;
            /// Distance below which the low-level collision check examines an object, m.
            theta_obj: f64 = 5.0 in 1e-3..=1e3;
            /// Braking deceleration, m/s^2.
            a_b: f64 = 8.0 in 0.1..=100.0;
            /// Time of the legal safety distance, s.
            safety_time: f64 = 1.8 in 0.0..=60.0;
            /// Oldest age at which data count as current, ns.
            max_age_ns: i64 = 100_000_000 in 0..=60_000_000_000;
            /// Number of disks that cover the footprint in stage v.
            n: i64 = 4 in 1..=64;
            /// H-01: largest distance of a matched pair, m.
            theta_track_max: f64 = 1.0 in 1e-3..=1e3;
            /// H-01: gated tracks that may stay unmatched.
            miss_budget: i64 = 4 in 0..=64;
            /// H-14: reaction time, s.
            tau: f64 = 0.1 in 0.0..=60.0;
            /// H-14: largest acceleration of the CAV, m/s^2.
            a_max: f64 = 3.0 in 0.1..=100.0;
            /// H-07: how much farther from the CAV than it can drive a point may be, m.
            start_tolerance: f64 = 2.0 in 1e-3..=1e3;
            /// H-11: largest speed of a trajectory, m/s.
            v_max: f64 = 150.0 in f64::from_bits(1)..=1000.0;
            /// H-11: longest time between trajectory points, ns.
            step_max_ns: i64 = 200_000_000 in 0..=60_000_000_000;
            /// Largest error of a track's velocity, m/s.
            theta_velocity: f64 = 2.0 in f64::from_bits(1)..=1000.0;
            /// H-07, H-14: how far aside a trajectory may pass the CAV, and its greatest excess, m.
            lateral_tolerance: f64 = 0.5 in 1e-3..=1e3;
            /// H-14: the greatest speed of an object that is looked for, m/s.
            v_object: f64 = 70.0 in f64::from_bits(1)..=1000.0;
            /// H-14: after this time others brake for a standing CAV, s.
            t_yield: f64 = 2.0 in 0.0..=60.0;
            /// H-14: how hard others brake for a standing CAV, m/s^2.
            a_yield: f64 = 3.0 in 0.1..=100.0;
            /// Stage i, H-14: the strict reading fails when the assignment, or H-14, takes more work.
            work_limit: i64 = 700_000 in 0..=i64::MAX;
            /// Margin of the strict and the lax reading, m (`spec/4-arithmetic.md#strict-and-lax`).
            delta: f64 = 1e-6 in 1e-8..=1e-2;
        }
    };
}

macro_rules! parameters_and_defaults {
    ($($(#[$doc:meta])* $name:ident: $number:ident = $default:literal in $domain:expr;)*) => {
        /// Parameters of the five stages; SI units, times in nanoseconds. Each default is the double
        /// nearest to the decimal of `spec/3-stages.md` (I-12).
        #[derive(Clone, Debug, PartialEq)]
        pub struct Parameters {
            $($(#[$doc])* pub $name: $number,)*
        }

        impl Default for Parameters {
            fn default() -> Self {
                Self { $($name: $default,)* }
            }
        }
    };
}

parameters!(parameters_and_defaults);
