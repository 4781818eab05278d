//! Stage i: paper Sec. IV-B, "Track Validation", Eq. (2)
//! (`spec/3-stages.md#stage-i-track-validation`, H-01, H-09):
//!
//! 1/k (c_1 + ... + c_k) < theta_tr
//!
//! where the c_i are the costs of the best match of tracks with detections.

use crate::hardened::{h01_matched_pairs, h09_velocity};
use crate::input::profile::Profile;
use crate::input::scene::{Object, Scene, Track, Tracks};
use crate::numbers::assignment::{Costs, mean_less, work};
use crate::numbers::real::Real;
use crate::report::{Rule, Witness};

/// Compares the received tracks in the field of view with the detections; `None` passes. The field of
/// view reaches from the CAV, at p, to the farthest detection.
pub fn track_validation(scene: &Scene, tracks: &Tracks, detections: &[Object]) -> Option<Witness> {
    let p = &scene.ego.position;
    let r = detections.iter().map(|d| d.frame.origin.distance(p)).max().unwrap_or_else(Real::zero);
    let failure = scene.reads.judge_within(
        &tracks.items,
        |track| track.object.frame.origin.distance(p),
        &r,
        |gated| average_cost_failure(scene, gated, detections),
        |delta| Witness::new(Rule::MeanCost, delta, delta),
    );
    match scene.profile {
        Profile::Paper => failure,
        Profile::Hardened => failure.or_else(|| h09_velocity::velocity_failure(scene, tracks)),
    }
}

/// 1/k (c_1 + ... + c_k) < theta_tr: the c_i are the costs in the cheapest assignment of
/// k = min(gated tracks, detections) pairs, a cost being the distance from track to detection.
fn average_cost_failure(scene: &Scene, gated: &[&Track], detections: &[Object]) -> Option<Witness> {
    let c = |t: &Track, d: &Object| t.object.frame.origin.distance(&d.frame.origin);
    let costs: Costs =
        gated.iter().map(|t| detections.iter().map(|d| Some(c(t, d))).collect()).collect();
    let (costs, k, columns) = match scene.profile {
        Profile::Paper => (costs, gated.len().min(detections.len()), detections.len()),
        Profile::Hardened => h01_matched_pairs::to_assign(scene, costs, detections.len()),
    };
    if k == 0 {
        return None;
    }
    over_work_limit(scene, work(gated.len(), columns)).or_else(|| {
        let theta_tr = &scene.parameters.theta_tr;
        match mean_less(&scene.reads, &costs, k, theta_tr) {
            Ok(mean) => Witness::unless(mean.less, Rule::MeanCost, &mean.cost, theta_tr),
            Err(most) => Some(h01_matched_pairs::no_assignment(gated, &costs, most, k)),
        }
    })
}

/// A late answer is no answer: an implementation fails the stage instead of so much work.
fn over_work_limit(scene: &Scene, work: i128) -> Option<Witness> {
    let limit = i128::from(scene.parameters.work_limit);
    let [steps, most] = [work, limit].map(Real::from_integer);
    Witness::unless(!scene.reads.refuses(work, limit), Rule::WorkLimit, &steps, &most)
}
