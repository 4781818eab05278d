//! Stage i: paper Sec. IV-B, "Track Validation", Eq. (2)
//! (`spec/3-stages.md#stage-i-track-validation`):
//!
//! 1/k (c_1 + ... + c_k) < theta_tr
//!
//! where the c_i are the costs of the best match of tracks with detections.

use crate::input::scene::{Object, Scene, Track, Tracks};
use crate::numbers::assignment::{Costs, mean_less, work};
use crate::numbers::real::Real;
use crate::numbers::vector::Vector;
use crate::report::{Rule, Witness};

/// Compares the received tracks in the field of view with the detections; `None` passes.
pub fn track_validation(scene: &Scene, tracks: &Tracks, detections: &[Object]) -> Option<Witness> {
    let position = |track: &Track| track.object.frame.origin.clone();
    let judge = |gated: &[&Track]| average_cost_failure(scene, gated, detections);
    judge_gated(scene, &tracks.items, position, detections, judge)
}

/// Judges the tracks in the field of view, which reaches from the CAV, at p, to the farthest detection.
pub fn judge_gated<T>(
    scene: &Scene,
    tracks: &[T],
    position: impl Fn(&T) -> Vector,
    detections: &[Object],
    judge: impl Fn(&[&T]) -> Option<Witness>,
) -> Option<Witness> {
    let p = &scene.ego.position;
    let r = detections.iter().map(|d| d.frame.origin.distance(p)).max().unwrap_or_else(Real::zero);
    let too_many = |delta: &Real| Witness::new(Rule::MeanCost, delta, delta);
    scene.reads.judge_within(tracks, |track| position(track).distance(p), &r, judge, too_many)
}

/// 1/k (c_1 + ... + c_k) < theta_tr: the c_i are the costs in the cheapest assignment of
/// k = min(gated tracks, detections) pairs, a cost being the distance from track to detection.
fn average_cost_failure(scene: &Scene, gated: &[&Track], detections: &[Object]) -> Option<Witness> {
    let costs: Costs =
        gated.iter().map(|track| costs(&track.object.frame.origin, detections)).collect();
    let k = gated.len().min(detections.len());
    if k == 0 {
        return None;
    }
    over_work_limit(scene, work(gated.len(), detections.len())).or_else(|| {
        let theta_tr = &scene.parameters.theta_tr;
        let mean = mean_less(&scene.reads, &costs, k, theta_tr).expect("any two can be paired");
        Witness::unless(mean.less, Rule::MeanCost, &mean.cost, theta_tr)
    })
}

/// The distances from a track to the detections, m.
pub fn costs(position: &Vector, detections: &[Object]) -> Vec<Option<Real>> {
    detections.iter().map(|d| Some(position.distance(&d.frame.origin))).collect()
}

/// A late answer is no answer: an implementation fails the stage instead of so much work.
pub fn over_work_limit(scene: &Scene, work: i128) -> Option<Witness> {
    let limit = i128::from(scene.parameters.work_limit);
    let [steps, most] = [work, limit].map(Real::from_integer);
    Witness::unless(!scene.reads.refuses(work, limit), Rule::WorkLimit, &steps, &most)
}
