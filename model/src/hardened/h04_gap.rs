//! H-04: the gap to the leading vehicle is compared with s_follow whether stage iv runs or not.

use crate::input::profile::Profile;
use crate::input::scene::Scene;
use crate::report::{Stage, Witness};
use crate::stages::iv_detections::gap_failure;

/// At the place of stage iv when that did not run: the gap is <= s_follow, and there is a current
/// trajectory.
pub fn failure_without_stage_iv(scene: &Scene, stage: Stage) -> Option<Witness> {
    let applies =
        scene.profile == Profile::Hardened && stage == Stage::Iv && scene.trajectory.is_some();
    applies.then(|| gap_failure(scene)).flatten()
}
