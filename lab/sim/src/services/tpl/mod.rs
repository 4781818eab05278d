//! TPL: trajectory planning.
//!
//! A stand-in for the paper's planner (model predictive control by an AL-iLQR): the CAV returns to the path
//! by a cubic, and its speed is simulated forward under the hardest of a few laws: the intelligent driver
//! model behind the leading vehicle (Treiber 2000), stops, bends, the speed limit. It cannot show what an
//! optimiser does: swerving around an obstacle, comfort in jerk, or not converging.

mod bends;
mod profile;
pub mod settings;

use mufasa::input::cycle::{Ego, TrajectoryPoint};

use crate::path::Path;
use crate::services::env::model::Environment;
use crate::services::tpl::profile::speed_profile;

/// Time between two points, ns.
pub const STEP_NS: i64 = 100_000_000;

/// A trajectory of 5 s from the CAV's pose now: places of its reference point. `limit`: the speed limit at
/// an arc length of the path, m/s.
pub fn trajectory(
    now_ns: i64,
    ego: &Ego,
    path: &Path,
    environment: &Environment,
    limit: &impl Fn(f64) -> f64,
) -> Vec<TrajectoryPoint> {
    let ways = speed_profile(ego, path, environment, limit);
    let back = Return::new(environment, ego.speed);
    let point = |(index, way): (i64, f64)| {
        let t_ns = now_ns + index * STEP_NS;
        if way <= 0.0 {
            let Ego { x, y, cos, sin, .. } = *ego;
            return TrajectoryPoint { t_ns, x, y, cos, sin };
        }
        let s = environment.s + way;
        let pose = path.pose_at(s);
        let (left, slope) = back.at(way);
        let at = pose.ahead(0.0, left);
        // Beside a bend the same way along the path is longer or shorter.
        let stretch = (1.0 - back.curvature(path, s) * left).max(0.2);
        let norm = (stretch * stretch + slope * slope).sqrt();
        let (ahead, aside) = (stretch / norm, slope / norm);
        TrajectoryPoint {
            t_ns,
            x: at.x,
            y: at.y,
            cos: pose.cos * ahead - pose.sin * aside,
            sin: pose.sin * ahead + pose.cos * aside,
        }
    };
    (0..).zip(ways).map(point).collect()
}

/// The way back to the path: a cubic from where the CAV is, with its direction.
struct Return {
    left: f64,
    slope: f64,
    length: f64,
}

impl Return {
    fn new(environment: &Environment, speed: f64) -> Self {
        let (sin, cos) = environment.aside;
        // Farther aside than 60 degrees there is no return by a cubic: it is as good as it gets.
        let slope = (sin / cos.max(0.1)).clamp(-1.7, 1.7);
        let length = (1.5 * speed).max(8.0).max(4.0 * environment.left.abs());
        Self { left: environment.left, slope, length }
    }

    /// How far left of the path after a way along it, m, and the slope there.
    fn at(&self, way: f64) -> (f64, f64) {
        if way >= self.length {
            return (0.0, 0.0);
        }
        let share = way / self.length;
        let rest = 1.0 - share;
        let left =
            rest * rest * ((1.0 + 2.0 * share) * self.left + share * self.length * self.slope);
        let slope =
            -6.0 * share * rest * self.left / self.length + rest * (1.0 - 3.0 * share) * self.slope;
        (left, slope)
    }

    /// Curvature of the path, where it matters.
    fn curvature(&self, path: &Path, s: f64) -> f64 {
        if self.left.abs() < 0.05 { 0.0 } else { path.curvature_at(s) }
    }
}
