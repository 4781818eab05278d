//! H-01: all gated tracks are matched, each with a detection closer than theta_track_max, but for at
//! most miss_budget backed ones, which may be left out.

use crate::hardened::detection_history::{Seen, seen};
use crate::input::scene::{Object, Scene, Track, Tracks};
use crate::numbers::assignment::{Costs, costs_less, count, work};
use crate::numbers::real::Real;
use crate::report::{Rule, Witness};
use crate::stages::i_track_validation::{costs, judge_gated, over_work_limit};

/// Stage i with the place of a track for its position.
pub fn validation(scene: &Scene, tracks: &Tracks, detections: &[Object]) -> Option<Witness> {
    let seen = seen(scene, tracks);
    let tracks: Vec<(&Track, &Seen)> = tracks.items.iter().zip(&seen).collect();
    let judge = |gated: &[&(&Track, &Seen)]| matched_cost_failure(scene, gated, detections);
    judge_gated(scene, &tracks, |(_, seen)| seen.place.clone(), detections, judge)
}

/// Some of the gated tracks may be left out, and a pair must be close; nothing that remains passes.
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

/// How many tracks may be left out: min(miss_budget, backed gated tracks).
pub fn may_be_left_out(scene: &Scene, gated: &[(&Track, &Seen)]) -> usize {
    let backed = gated.iter().filter(|(_, seen)| seen.is_backed).count();
    usize::try_from(scene.parameters.miss_budget).unwrap_or(0).min(backed)
}

/// Why no choice of the left-out tracks leaves a mean < theta_tr of what remains; at least one gated
/// track remains. `costs` of gated tracks and detections.
///
/// Each track that may be left out is given a column of cost theta_tr to be left out by. Let g be the
/// number of gated tracks, m of these left out, and C the cost of the pairs of the others. The whole
/// assignment costs C + m theta_tr, and that is < g theta_tr exactly when C < (g - m) theta_tr: then
/// m < g, because C >= 0, and the mean C / (g - m) is < theta_tr. So some choice of the left-out
/// tracks has such a mean exactly when the cheapest assignment of all g tracks costs < g theta_tr.
pub fn mean_failure(scene: &Scene, gated: &[(&Track, &Seen)], costs: Costs) -> Option<Witness> {
    let theta_track_max = &scene.parameters.theta_track_max;
    // As the reading lowers it; where that is below 0 no mean is less.
    let theta_tr = scene.reads.lowered(&scene.parameters.theta_tr).max(Real::zero());
    let close = |cost: &Real| scene.reads.less(cost, theta_track_max);
    let left_out = may_be_left_out(scene, gated);
    let row = |(row, (_, seen)): (Vec<Option<Real>>, &(&Track, &Seen))| {
        let leaving = seen.is_backed.then(|| theta_tr.clone());
        let pairs = row.into_iter().map(|cost| cost.filter(close));
        pairs.chain(vec![leaving; left_out]).collect()
    };
    let detections = costs.first().map_or(0, Vec::len);
    let costs: Costs = costs.into_iter().zip(gated).map(row).collect();
    let tracks = gated.len();
    match costs_less(&costs, tracks, &(count(tracks) * &theta_tr)) {
        Ok(found) => {
            let left = found.pairs.iter().filter(|(_, column)| *column >= detections).count();
            // The witness has what was compared (SCHED-19): the mean of those that remain.
            let mean = (found.cost - count(left) * &theta_tr) / count(tracks - left);
            Witness::unless(found.less, Rule::MeanCost, &mean, &scene.parameters.theta_tr)
        }
        Err(most) => Some(no_assignment(gated, &costs, most)),
    }
}

/// Fewer pairs than tracks: the witness names the first gated track with no detection close to it
/// that may not be left out.
fn no_assignment(gated: &[(&Track, &Seen)], costs: &Costs, pairs: usize) -> Witness {
    let unmatched = costs.iter().position(|row| row.iter().all(Option::is_none));
    Witness {
        track: unmatched.map(|row| gated[row].0.id),
        ..Witness::new(Rule::NoAssignment, &count(pairs), &count(gated.len()))
    }
}
