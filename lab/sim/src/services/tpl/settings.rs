//! Numbers of the planner.

/// Greatest speed, m/s.
pub const SPEED: f64 = 13.9;
/// Greatest acceleration across, m/s^2.
pub const LATERAL: f64 = 2.5;
/// Acceleration, m/s^2.
pub const ACCELERATION: f64 = 1.5;
/// Comfortable deceleration, m/s^2.
pub const BRAKING: f64 = 2.5;
/// Distance to a standing leading vehicle, m.
pub const STANDING_GAP: f64 = 3.0;
/// Time gap to the leading vehicle, s, above the 1.8 s of `s_follow`.
pub const HEADWAY: f64 = 2.0;
/// Distance between the front and where to stop, m.
pub const STOP_MARGIN: f64 = 1.0;
/// Distance kept to who crosses, m, and time before and after it, s.
pub const CROSSING: (f64, f64) = (2.0, 0.7);
/// Points of a trajectory: 5 s.
pub const POINTS: usize = 51;
/// Seconds between two points.
pub const STEP_S: f64 = 0.1;
