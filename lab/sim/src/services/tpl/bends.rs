//! How fast bends may be driven.

use crate::path::Path;
use crate::pose::Pose;
use crate::services::tpl::settings::{BRAKING, LATERAL, SPEED};

/// The greatest speed at ways ahead that lets every bend behind be driven, too.
pub(super) struct Bends {
    speeds: Vec<f64>,
}

/// Distance between two of the places looked at, m.
const STEP_M: f64 = 2.0;

impl Bends {
    /// Speeds from an arc length on, as far as the CAV gets at `speed`, m/s, and has to brake for.
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // a few hundred metres
    pub(super) fn new(path: &Path, s: f64, speed: f64, limit: &impl Fn(f64) -> f64) -> Self {
        let fastest = speed.max(SPEED);
        let reach = 5.0 * fastest + fastest * fastest / (2.0 * BRAKING);
        let count = (reach / STEP_M) as u32 + 2;
        let poses: Vec<Pose> =
            (0..=count).map(|step| path.pose_at(s + STEP_M * (f64::from(step) - 0.5))).collect();
        let of_place =
            |(step, pair): (u32, &[Pose])| of_bend(pair).min(limit(s + STEP_M * f64::from(step)));
        let mut speeds: Vec<f64> = (0..).zip(poses.windows(2)).map(of_place).collect();
        for index in (0..speeds.len() - 1).rev() {
            let next = speeds[index + 1];
            let braking = 0.8 * BRAKING;
            speeds[index] = speeds[index].min((next * next + 2.0 * braking * STEP_M).sqrt());
        }
        Self { speeds }
    }

    /// The greatest speed at a way ahead, m/s.
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // held within the list
    pub(super) fn at(&self, way: f64) -> f64 {
        let step = (way / STEP_M).max(0.0);
        let last = self.speeds.len() - 1;
        let before = (step as usize).min(last);
        let (from, to) = (self.speeds[before], self.speeds[(before + 1).min(last)]);
        from + (to - from) * (step - step.floor())
    }
}

/// The greatest speed between two poses.
fn of_bend(pair: &[Pose]) -> f64 {
    let [from, to] = [pair[0], pair[1]];
    let sine = (from.cos * to.sin - from.sin * to.cos).abs();
    let curvature = sine / STEP_M;
    if curvature <= LATERAL / (SPEED * SPEED) { SPEED } else { (LATERAL / curvature).sqrt() }
}
