//! Stage i: paper Sec. IV-B, "Track Validation", Eq. (2)
//! (`spec/3-stages.md#stage-i-track-validation`, H-01):
//!
//! 1/k (c_1 + ... + c_k) < theta_tr
//!
//! where the c_i are the costs of the best match of tracks with detections.

use crate::hardened::detection_history::{Seen, ambiguous_failure, seen};
use crate::hardened::h01_matched_pairs::{may_be_left_out, mean_failure};
use crate::input::profile::HardenedRule;
use crate::input::scene::{Object, Scene, Track, Tracks};
use crate::numbers::assignment::{Costs, mean_less, work};
use crate::numbers::real::Real;
use crate::numbers::vector::Vector;
use crate::report::{Rule, Witness};

/// Compares the received tracks in the field of view with the detections; `None` passes. The field of
/// view reaches from the CAV, at p, to the farthest detection.
pub fn track_validation(scene: &Scene, tracks: &Tracks, detections: &[Object]) -> Option<Witness> {
    let p = &scene.ego.position;
    let r = detections.iter().map(|d| d.frame.origin.distance(p)).max().unwrap_or_else(Real::zero);
    let too_many = |delta: &Real| Witness::new(Rule::MeanCost, delta, delta);
    let asks_history =
        [HardenedRule::H01, HardenedRule::H14].into_iter().any(|rule| scene.profile.has(rule));
    let ambiguous = asks_history.then(|| ambiguous_failure(scene, tracks)).flatten();
    if !scene.profile.has(HardenedRule::H01) {
        let paper = || {
            scene.reads.judge_within(
                &tracks.items,
                |track| track.object.frame.origin.distance(p),
                &r,
                |gated| average_cost_failure(scene, gated, detections),
                too_many,
            )
        };
        return ambiguous.or_else(paper);
    }
    // The place of a track for its position.
    ambiguous.or_else(|| {
        let seen = seen(scene, tracks);
        let tracks: Vec<(&Track, &Seen)> = tracks.items.iter().zip(&seen).collect();
        scene.reads.judge_within(
            &tracks,
            |(_, seen)| seen.place.distance(p),
            &r,
            |gated| matched_cost_failure(scene, gated, detections),
            too_many,
        )
    })
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

/// H-01: some of the gated tracks may be left out, and a pair must be close; nothing that remains
/// passes.
fn matched_cost_failure(
    scene: &Scene,
    gated: &[&(&Track, &Seen)],
    detections: &[Object],
) -> Option<Witness> {
    let gated: Vec<(&Track, &Seen)> = gated.iter().map(|both| **both).collect();
    let left_out = may_be_left_out(scene, &gated);
    if left_out == gated.len() {
        return None;
    }
    over_work_limit(scene, work(gated.len(), detections.len() + left_out)).or_else(|| {
        let costs = gated.iter().map(|(_, seen)| costs(&seen.place, detections)).collect();
        mean_failure(scene, &gated, costs)
    })
}

/// The distances from a track to the detections, m.
fn costs(position: &Vector, detections: &[Object]) -> Vec<Option<Real>> {
    detections.iter().map(|d| Some(position.distance(&d.frame.origin))).collect()
}

/// A late answer is no answer: an implementation fails the stage instead of so much work.
pub fn over_work_limit(scene: &Scene, work: i128) -> Option<Witness> {
    let limit = i128::from(scene.parameters.work_limit);
    let [steps, most] = [work, limit].map(Real::from_integer);
    Witness::unless(!scene.reads.refuses(work, limit), Rule::WorkLimit, &steps, &most)
}
