//! Items of lists with arbitrary numbers; near the origin and of the size of a vehicle where an engine samples.

use mufasa::input::cycle::{Detection, Track, TrajectoryPoint};

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
