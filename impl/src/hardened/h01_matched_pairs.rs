//! Stage i: every gated track but a budget is paired, and closely (H-01 of
//! `spec/3-stages.md#hardened-profile`).

use crate::input::cycle::{Cycle, DetectionList, TrackList};
use crate::input::scratch::Scratch;
use crate::report::Witness;
use crate::stages::i_track_validation::assignment::assign;
use crate::stages::i_track_validation::mean_cost::{
    columns_of, mean_cost_failure, no_assignment, over_work_limit,
};
use crate::stages::i_track_validation::pairing::PairLimits;
use crate::stages::i_track_validation::pairs::Pairs;

/// What the pairs have to keep: all but `miss_budget` closer than `theta_track_max`.
pub(crate) fn pair_limits(cycle: &Cycle<'_>) -> PairLimits {
    let spare = usize::try_from(cycle.parameters.miss_budget).unwrap_or(0);
    let (theta_tr, limit) = (cycle.parameters.theta_tr, cycle.parameters.theta_track_max);
    PairLimits { limit, theta_tr, spare }
}

/// k' = gated tracks less the budget. The budget is spare columns that cost nothing, so that
/// a minimal assignment of all gated tracks is a minimal choice of k' pairs; pairs beyond k' are of
/// coinciding points and add nothing to the sum.
pub(crate) fn matched_pairs(
    cycle: &Cycle<'_>,
    tracks: &TrackList<'_>,
    detections: &DetectionList<'_>,
    gated: usize,
    scratch: &mut Scratch<'_>,
) -> Option<Witness> {
    let spare = usize::try_from(cycle.parameters.miss_budget).unwrap_or(0).min(gated);
    let k = gated.saturating_sub(spare);
    if k == 0 {
        return None;
    }
    let count = detections.items.len().saturating_add(spare);
    if let Some(witness) = over_work_limit(cycle, gated, count) {
        return Some(witness);
    }
    let columns = columns_of(scratch.columns, count);
    let lists = (tracks.items, detections.items);
    let limit = cycle.parameters.theta_track_max;
    let pairs = Pairs::new(lists, false, limit, scratch.rows, columns);
    let assigned = assign(scratch.rows, gated, columns, &pairs);
    if assigned == gated {
        return mean_cost_failure(cycle, &pairs, scratch.rows, columns, k);
    }
    // The first track that is near no detection; else several compete, and no one of them is it.
    let lone = pairs.lone(scratch.rows, gated).and_then(|index| tracks.items.get(index));
    let witness = no_assignment(assigned.saturating_sub(spare), k);
    Some(Witness { track: lone.map(|track| track.id), ..witness })
}
