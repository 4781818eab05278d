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

/// Any number, for sampling engines one of the domain up to ten times the default.
trait Sampled: Sized {
    fn near_default(least: Self, most: Self, default: Self) -> Self;
}

impl Sampled for f64 {
    fn near_default(least: Self, most: Self, default: Self) -> Self {
        near(least, most.min(10.0 * default))
    }
}

impl Sampled for i64 {
    fn near_default(least: Self, most: Self, default: Self) -> Self {
        near_integer(least, most.min(default.saturating_mul(10)))
    }
}

macro_rules! any_parameters {
    ($($(#[$doc:meta])* $name:ident: $number:ident = $default:literal in [$least:expr, $most:expr];)*) => {
        Parameters { $($name: Sampled::near_default($least, $most, $default),)* }
    };
}

/// Any parameters.
pub fn parameters() -> Parameters {
    mufasa::parameters!(any_parameters)
}
