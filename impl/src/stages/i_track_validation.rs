//! Stage i: track validation (`spec/3-stages.md#stage-i-track-validation`).

pub(crate) mod assignment;
pub(crate) mod gate;
pub(crate) mod mean_cost;
pub(crate) mod pairing;
pub(crate) mod pairs;
pub(crate) mod places;
pub(crate) mod spatial_hash;

use crate::input::cycle::{Cycle, DetectionList, TrackList};
use crate::input::scratch::Scratch;
use crate::report::Witness;
use crate::stages::i_track_validation::assignment::assign;
use crate::stages::i_track_validation::gate::gated_tracks;
use crate::stages::i_track_validation::mean_cost::{
    columns_of, mean_cost_failure, no_assignment, over_work_limit,
};
use crate::stages::i_track_validation::pairing::{PairLimits, certainly_pass};
use crate::stages::i_track_validation::pairs::Pairs;
use crate::stages::i_track_validation::places::Places;

/// Why stage i fails, if it does.
pub(crate) fn track_validation(
    cycle: &Cycle<'_>,
    tracks: &TrackList<'_>,
    detections: &DetectionList<'_>,
    scratch: &mut Scratch<'_>,
) -> Option<Witness> {
    let places = Places::standing(tracks.items);
    let theta_tr = cycle.parameters.theta_tr;
    let limits = PairLimits { theta_tr, limit: f64::MAX, spare: 0, may_be_left: |_, _| false };
    let gated = gated_but_not_paired(cycle, &places, detections, limits, scratch)?;
    mean_cost(cycle, places, detections, gated, scratch)
}

/// How many tracks are gated, which are in the rows then, unless a quick search finds pairs that keep the
/// limits.
pub(crate) fn gated_but_not_paired(
    cycle: &Cycle<'_>,
    places: &Places<'_>,
    detections: &DetectionList<'_>,
    limits: PairLimits,
    scratch: &mut Scratch<'_>,
) -> Option<usize> {
    let p = [cycle.ego.x, cycle.ego.y];
    let columns = columns_of(scratch.columns, detections.items.len());
    if certainly_pass(p, places, detections.items, limits, (scratch.rows, columns)) {
        return None;
    }
    Some(gated_tracks(p, places, detections.items, scratch.rows))
}

/// Units of a cost per m: costs are at most 2^20 m.
const SCALE: f64 = 4_294_967_296.0;

/// k = min(gated tracks, detections) pairs, the fewer of the two as rows.
fn mean_cost(
    cycle: &Cycle<'_>,
    places: Places<'_>,
    detections: &DetectionList<'_>,
    gated: usize,
    scratch: &mut Scratch<'_>,
) -> Option<Witness> {
    let detected = detections.items.len();
    // S1-04; k = 0 passes: I-02
    let k = gated.min(detected);
    if k == 0 {
        return None;
    }
    if let Some(witness) = over_work_limit(cycle, gated, detected) {
        return Some(witness);
    }
    let columns = columns_of(scratch.columns, gated.max(detected));
    let swapped = gated > detected;
    let pairs = Pairs::new((places, detections.items), swapped, SCALE, (scratch.rows, columns));
    let assigned = assign(scratch.rows, k, columns, &pairs);
    if assigned < k {
        // Every row may be paired with every column: never, but if so, nothing has been shown.
        return Some(no_assignment(assigned, k));
    }
    mean_cost_failure(cycle, &pairs, scratch.rows, columns, k)
}
