//! Numbers of the planner.

use crate::vehicle::A_B;

/// What the planner wants.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// Greatest speed, m/s.
    pub speed: f64,
    /// Greatest acceleration across, m/s^2.
    pub lateral: f64,
    /// Acceleration, m/s^2.
    pub acceleration: f64,
    /// Comfortable deceleration, m/s^2.
    pub braking: f64,
    /// Greatest deceleration, m/s^2.
    pub a_b: f64,
    /// Distance to a standing leading vehicle, m.
    pub standing_gap: f64,
    /// Time gap to the leading vehicle, s, above the 1.8 s of `s_follow`.
    pub headway: f64,
    /// Distance between the front and where to stop, m.
    pub stop_margin: f64,
    /// Distance kept to who crosses, m, and time before and after it, s.
    pub crossing: (f64, f64),
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            speed: 13.9,
            lateral: 2.5,
            acceleration: 1.5,
            braking: 2.5,
            a_b: A_B,
            standing_gap: 3.0,
            headway: 2.0,
            stop_margin: 1.0,
            crossing: (2.0, 0.7),
        }
    }
}

/// Points of a trajectory: 5 s.
pub const POINTS: usize = 51;
/// Seconds between two points.
pub const STEP_S: f64 = 0.1;
