//! Parameters of the stages, with defaults and domains (`spec/3-stages.md`, paper Table II).

/// All parameters of the stages; nothing else of this crate names them all. `parameters!(each)`
/// expands to `each! { .. }` with one entry for each, in the order in which they are checked:
/// `/// what it is` `name: type = default in domain;`, the type being `f64` or `i64`, and the
/// domain the least and the greatest value. Source: `spec/3-stages.md`,
/// `spec/4-arithmetic.md#domain`.
#[macro_export]
macro_rules! parameters {
    ($each:ident) => {
        // DOM-01
        $each! {
            /// Stage i: the mean distance of the assigned pairs has to be below this, m.
            theta_tr: f64 = 0.2 in [1e-3, 1e3];
            /// Stage ii: farthest a point outside the corridor may be from the reference path, m.
            theta_map: f64 = 0.3 in [1e-3, 1e3];
            /// Stages iii and iv: objects nearer than this are examined, m.
            theta_obj: f64 = 5.0 in [1e-3, 1e3];
            /// Braking deceleration, m/s^2.
            a_b: f64 = 8.0 in [0.1, 100.0];
            /// Time of the safety distance required by law, s.
            safety_time: f64 = 1.8 in [0.0, 60.0];
            /// Oldest age at which data count as current, ns; what is later than now is not current either.
            max_age_ns: i64 = 100_000_000 in [0, 60_000_000_000];
            /// Stage v: disks that cover the footprint.
            n: i64 = 4 in [1, 64];
            /// H-01: every assigned pair has to be closer than this, m.
            theta_track_max: f64 = 1.0 in [1e-3, 1e3];
            /// H-01: gated tracks that may stay without a detection.
            miss_budget: i64 = 4 in [0, 64];
            /// H-14: the longest time from measuring pose and speed to braking, s.
            tau: f64 = 0.1 in [0.0, 60.0];
            /// H-14: greatest acceleration of the CAV, m/s^2.
            a_max: f64 = 3.0 in [0.1, 100.0];
            /// H-07: how much farther from the CAV than it can drive a point may be, m.
            start_tolerance: f64 = 2.0 in [1e-3, 1e3];
            /// H-11: greatest speed of a trajectory, m/s.
            v_max: f64 = 150.0 in [f64::from_bits(1), 1e3];
            /// H-11: longest time between two trajectory points, ns.
            step_max_ns: i64 = 200_000_000 in [0, 60_000_000_000];
            /// Greatest error of the velocity of a track, m/s.
            theta_velocity: f64 = 2.0 in [f64::from_bits(1), 1e3];
            /// H-07, H-14: how far aside a trajectory may pass the CAV, and its greatest excess, m.
            lateral_tolerance: f64 = 0.5 in [1e-3, 1e3];
            /// H-14: the greatest speed of an object that is looked for, m/s.
            v_object: f64 = 70.0 in [f64::from_bits(1), 1e3];
            /// H-14: how long after the CAV others begin to brake for it, s.
            t_yield: f64 = 2.0 in [0.0, 60.0];
            /// H-14: how hard they brake then, m/s^2.
            a_yield: f64 = 3.0 in [0.1, 100.0];
            /// Stage i fails rather than begin an assignment of more steps than this, H-14 once it has taken more.
            work_limit: i64 = 700_000 in [0, i64::MAX];
            /// Margin of the strict and the lax model, m; no verdict of this crate depends on it.
            delta: f64 = 1e-6 in [1e-8, 1e-2];
        }
    };
}

macro_rules! fields {
    ($($(#[$doc:meta])* $name:ident: $number:ident = $default:literal in $domain:expr;)*) => {
        /// Parameters of the five stages; SI units, times in nanoseconds. Each default is the
        /// double nearest to the decimal of `spec/3-stages.md` (I-12).
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub struct Parameters {
            $(
                $(#[$doc])*
                ///
                #[doc = concat!("Default ", stringify!($default), ", from ", stringify!($domain), ".")]
                pub $name: $number,
            )*
        }

        impl Default for Parameters {
            fn default() -> Self {
                // DOM-02
                Self { $($name: $default,)* }
            }
        }
    };
}

parameters!(fields);
