//! Items of lists, a CAV and its parameters with arbitrary numbers; near the origin and of the size of a vehicle where an engine
//! samples.

use mufasa::input::cycle::{Detection, Ego, Track, TrajectoryPoint};
use mufasa::input::parameters::Parameters;

use super::any::{near, near_integer};

/// Largest position that a sampling engine prefers, m: near enough for lists to meet.
const FAR: f64 = 8.0;

/// Any coordinate.
pub fn position() -> f64 {
    near(-FAR, FAR)
}

/// Any track of this direction.
pub fn track([cos, sin]: [f64; 2]) -> Track {
    Track {
        id: near_integer(1, 3),
        x: position(),
        y: position(),
        cos,
        sin,
        vx: near(-30.0, 30.0),
        vy: near(-30.0, 30.0),
        length: near(0.01, 12.0),
        width: near(0.01, 3.0),
    }
}

/// Any detection of this direction.
pub fn detection(direction: [f64; 2]) -> Detection {
    let Track { x, y, cos, sin, length, width, .. } = track(direction);
    Detection { x, y, cos, sin, length, width }
}

/// Any point of this direction. The range of times is a hint for engines that sample.
pub fn point([cos, sin]: [f64; 2], [first_ns, last_ns]: [i64; 2]) -> TrajectoryPoint {
    let t_ns = near_integer(first_ns, last_ns);
    TrajectoryPoint { t_ns, x: position(), y: position(), cos, sin }
}

/// Any CAV of this direction.
pub fn ego([cos, sin]: [f64; 2]) -> Ego {
    Ego {
        x: position(),
        y: position(),
        cos,
        sin,
        speed: near(0.0, 60.0),
        length: near(0.01, 12.0),
        width: near(0.01, 3.0),
        center_offset: near(-2.0, 2.0),
    }
}

/// Any parameters.
pub fn parameters() -> Parameters {
    Parameters {
        theta_tr: near(0.1, 10.0),
        theta_map: near(0.1, 10.0),
        theta_obj: near(0.1, 10.0),
        a_b: near(0.1, 10.0),
        safety_time: near(0.0, 2.0),
        max_age_ns: near_integer(0, 60_000_000_000),
        n: near_integer(1, 2),
        theta_track_max: near(0.1, 10.0),
        miss_budget: near_integer(0, 2),
        tau: near(0.0, 1.0),
        a_max: near(0.1, 10.0),
        start_tolerance: near(0.1, 1e3),
        v_max: near(1.0, 1e3),
        step_max_ns: near_integer(0, 60_000_000_000),
        theta_velocity: near(0.1, 1e3),
        lateral_tolerance: near(0.1, 10.0),
        v_object: near(1.0, 1e3),
        t_yield: near(0.0, 2.0),
        a_yield: near(0.1, 10.0),
        work_limit: near_integer(0, 10_000_000_000),
        delta: near(1e-8, 1e-2),
    }
}
