//! Stage i: every gated track but a few backed ones is paired, and closely (H-01 of
//! `spec/3-stages.md#hardened-profile`).

use crate::input::cycle::{Cycle, DetectionList, TrackList};
use crate::input::scratch::{Row, Scratch};
use crate::report::Witness;
use crate::stages::i_track_validation::assignment::assign;
use crate::stages::i_track_validation::gated_but_not_paired;
use crate::stages::i_track_validation::mean_cost::{
    columns_of, mean_cost_failure, no_assignment, over_work_limit,
};
use crate::stages::i_track_validation::pairing::PairLimits;
use crate::stages::i_track_validation::pairs::{PairRules, Pairs};
use crate::stages::i_track_validation::places::Places;

/// What the pairs have to keep: all but `miss_budget` closer than `theta_track_max`.
pub(crate) fn pair_limits(cycle: &Cycle<'_>) -> PairLimits {
    let (theta_tr, limit) = (cycle.parameters.theta_tr, cycle.parameters.theta_track_max);
    PairLimits { limit, theta_tr, spare: budget(cycle) }
}

fn budget(cycle: &Cycle<'_>) -> usize {
    usize::try_from(cycle.parameters.miss_budget).unwrap_or(0)
}

/// Units of a cost per m. Costs are at most 1000 m.
const SCALE: f64 = 68_719_476_736.0;

/// Why stage i fails, if it does. Which tracks are backed stands in the scratch.
pub(crate) fn matched_tracks(
    cycle: &Cycle<'_>,
    tracks: &TrackList<'_>,
    detections: &DetectionList<'_>,
    scratch: &mut Scratch<'_>,
) -> Option<Witness> {
    let places = Places::then(tracks, detections);
    let gated = gated_but_not_paired(cycle, &places, detections, pair_limits(cycle), scratch)?;
    matched_pairs(cycle, places, detections, gated, scratch)
}

/// Leaving out a backed track costs `theta_tr`: the mean of what remains of g tracks after j are
/// left out is below `theta_tr` exactly when its sum and j `theta_tr` are below g `theta_tr`. So one
/// minimal assignment, with a spare column for each track that may be left out, decides for every
/// choice. Costs are rounded up to units of 2^-36 m: what is found costs at most that and 1e-10 m
/// for each of the tracks more than the least, of which at most 64 are not paired by both.
fn matched_pairs(
    cycle: &Cycle<'_>,
    places: Places<'_>,
    detections: &DetectionList<'_>,
    gated: usize,
    scratch: &mut Scratch<'_>,
) -> Option<Witness> {
    let tracks = scratch.rows.iter().take(gated).map(|row| usize::from(row.track));
    let is_backed = |&track: &usize| scratch.rows.get(track).is_some_and(Row::is_backed);
    let backed = tracks.filter(is_backed).count();
    let spare = budget(cycle).min(backed);
    if spare == gated {
        return None;
    }
    let count = detections.items.len().saturating_add(spare);
    if let Some(witness) = over_work_limit(cycle, gated, count) {
        return Some(witness);
    }
    let columns = columns_of(scratch.columns, count);
    let (limit, left_out) = (cycle.parameters.theta_track_max, cycle.parameters.theta_tr);
    let rules = PairRules { swapped: false, limit, left_out, scale: SCALE };
    let pairs = Pairs::new((places, detections.items), rules, scratch.rows, columns);
    let assigned = assign(scratch.rows, gated, columns, &pairs);
    if let (true, Some(left)) = (assigned == gated, pairs.left_out(scratch.rows, columns)) {
        let k = gated.saturating_sub(left);
        return mean_cost_failure(cycle, &pairs, scratch.rows, columns, k);
    }
    // The first track that is near no detection and may not be left out; else several compete, and no one of them is it.
    let lone = pairs.lone(scratch.rows, gated, spare).and_then(|index| places.tracks.get(index));
    Some(Witness { track: lone.map(|track| track.id), ..no_assignment(assigned, gated) })
}
