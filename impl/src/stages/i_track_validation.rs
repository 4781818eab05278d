//! Stage i: track validation (`spec/3-stages.md#stage-i-track-validation`).

pub(crate) mod assignment;
pub(crate) mod gate;
pub(crate) mod mean_cost;
pub(crate) mod pairing;
pub(crate) mod pairs;
pub(crate) mod places;
pub(crate) mod spatial_hash;

use crate::hardened::h01_matched_pairs::{matched_pairs, pair_limits};
use crate::input::cycle::{Cycle, DetectionList, TrackList};
use crate::input::profile::HardenedRule;
use crate::input::scratch::{Row, Scratch};
use crate::report::Witness;
use crate::stages::i_track_validation::assignment::assign;
use crate::stages::i_track_validation::gate::gated_tracks;
use crate::stages::i_track_validation::mean_cost::{
    columns_of, mean_cost_failure, no_assignment, over_work_limit,
};
use crate::stages::i_track_validation::pairing::{PairLimits, certainly_pass};
use crate::stages::i_track_validation::pairs::{PairRules, Pairs};
use crate::stages::i_track_validation::places::Places;

/// Why stage i fails, if it does. Which tracks are backed stands in the scratch.
pub(crate) fn track_validation(
    cycle: &Cycle<'_>,
    tracks: &TrackList<'_>,
    detections: &DetectionList<'_>,
    scratch: &mut Scratch<'_>,
) -> Option<Witness> {
    let places = Places::new(cycle, tracks, detections);
    if pairs_found(cycle, &places, detections, scratch) {
        return None;
    }
    let p = [cycle.ego.x, cycle.ego.y];
    let gated = gated_tracks(p, &places, detections.items, scratch.rows);
    if cycle.profile.has(HardenedRule::H01) {
        matched_pairs(cycle, places, detections, gated, scratch)
    } else {
        mean_cost(cycle, places, detections, gated, scratch)
    }
}

/// Whether a quick search finds pairs that keep the rules of the profile.
fn pairs_found(
    cycle: &Cycle<'_>,
    places: &Places<'_>,
    detections: &DetectionList<'_>,
    scratch: &mut Scratch<'_>,
) -> bool {
    let limits = if cycle.profile.has(HardenedRule::H01) {
        pair_limits(cycle)
    } else {
        PairLimits { theta_tr: cycle.parameters.theta_tr, limit: f64::MAX, spare: 0 }
    };
    let columns = columns_of(scratch.columns, detections.items.len());
    let p = [cycle.ego.x, cycle.ego.y];
    let rows = &*scratch.rows;
    let is_backed = |track: usize| rows.get(track).is_some_and(Row::is_backed);
    certainly_pass(p, places, detections.items, limits, is_backed, columns)
}

/// Units of a cost per m: costs are at most 2^20 m.
const SCALE: f64 = 4_294_967_296.0;

/// The stage of the paper: k = min(gated tracks, detections) pairs, the fewer of the two as rows.
fn mean_cost(
    cycle: &Cycle<'_>,
    places: Places<'_>,
    detections: &DetectionList<'_>,
    gated: usize,
    scratch: &mut Scratch<'_>,
) -> Option<Witness> {
    let detected = detections.items.len();
    let k = gated.min(detected);
    if k == 0 {
        return None;
    }
    if let Some(witness) = over_work_limit(cycle, gated, detected) {
        return Some(witness);
    }
    let columns = columns_of(scratch.columns, gated.max(detected));
    let swapped = gated > detected;
    let rules = PairRules { swapped, limit: f64::MAX, left_out: f64::MAX, scale: SCALE };
    let pairs = Pairs::new((places, detections.items), rules, scratch.rows, columns);
    let assigned = assign(scratch.rows, k, columns, &pairs);
    if assigned < k {
        // Every row may be paired with every column: never, but if so, nothing has been shown.
        return Some(no_assignment(assigned, k));
    }
    mean_cost_failure(cycle, &pairs, scratch.rows, columns, k)
}
