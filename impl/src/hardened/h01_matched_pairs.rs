//! Stage i: every gated track but a few backed ones is paired, and closely (H-01 of
//! `spec/hardened/H-01.md`).

use core::ops::Range;

use crate::input::cycle::{Cycle, DetectionList, TrackList};
use crate::input::scratch::{Column, NONE, Row, Scratch};
use crate::report::Witness;
use crate::stages::i_track_validation::assignment::{Costs, assign};
use crate::stages::i_track_validation::gated_but_not_paired;
use crate::stages::i_track_validation::mean_cost::{
    columns_of, mean_cost_failure, no_assignment, over_work_limit,
};
use crate::stages::i_track_validation::pairing::PairLimits;
use crate::stages::i_track_validation::pairs::{Pair, Pairs, Place};
use crate::stages::i_track_validation::places::Places;

/// What the pairs have to keep: all but `miss_budget` (H-01.2), which have to be backed (H-01.3), closer
/// than `theta_track_max`.
pub(crate) fn pair_limits(cycle: &Cycle<'_>) -> PairLimits {
    let (theta_tr, limit) = (cycle.parameters.theta_tr, cycle.parameters.theta_track_max);
    PairLimits { limit, theta_tr, spare: budget(cycle), may_be_left: is_backed }
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
    // H-01.1
    let places = Places::at(tracks, detections.stamp_ns);
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
    let backed = (0..gated).filter(|&row| is_row_backed(scratch.rows, row)).count();
    // H-01.2
    let spare = budget(cycle).min(backed);
    // H-01.4: no track has to remain
    if spare == gated {
        return None;
    }
    // H-01.5
    let count = detections.items.len().saturating_add(spare);
    if let Some(witness) = over_work_limit(cycle, gated, count) {
        return Some(witness);
    }
    let columns = columns_of(scratch.columns, count);
    let (limit, left_out) = (cycle.parameters.theta_track_max, cycle.parameters.theta_tr);
    let pairs = Pairs::new((places, detections.items), false, SCALE, (scratch.rows, columns));
    let matched = MatchedPairs { pairs, limit, left_out };
    let assigned = assign(scratch.rows, gated, columns, &matched);
    if let (true, Some(left)) = (assigned == gated, matched.left_out(scratch.rows, columns)) {
        let k = gated.saturating_sub(left);
        // H-01.4
        return mean_cost_failure(cycle, &matched.pairs, scratch.rows, columns, k);
    }
    // The first track that is near no detection and may not be left out; else several compete, and no one of
    // them is it.
    let lone = matched.lone(scratch.rows, gated, spare).and_then(|index| places.tracks.get(index));
    Some(Witness { track: lone.map(|track| track.id), ..no_assignment(assigned, gated) })
}

/// Whether the track with this index is backed.
fn is_backed(rows: &[Row], track: usize) -> bool {
    rows.get(track).is_some_and(Row::is_backed)
}

/// Whether the track of a row of the assignment is.
fn is_row_backed(rows: &[Row], row: usize) -> bool {
    rows.get(row).is_some_and(|row| is_backed(rows, usize::from(row.track)))
}

/// Rows are gated tracks, which may be paired with near detections alone; the row of a backed track may
/// take a spare column, which leaves the track out.
struct MatchedPairs<'a> {
    pairs: Pairs<'a>,
    /// Every pair has to be closer, m.
    limit: f64,
    /// What it costs to leave out a backed track, m.
    left_out: f64,
}

impl Costs for MatchedPairs<'_> {
    type Place = Place;

    fn place(&self, rows: &[Row], row: usize) -> Option<Place> {
        self.pairs.place(rows, row)
    }

    fn cost(&self, rows: &[Row], place: Place, column: usize) -> Option<i64> {
        let Some(metres) = self.pairs.metres(rows, place, column) else {
            // H-01.3
            return is_row_backed(rows, place.row).then(|| self.pairs.units(self.left_out));
        };
        certainly_closer(metres, self.limit).then(|| self.pairs.units(metres))
    }

    fn lists(&self, place: Place) -> impl Iterator<Item = (i64, Range<usize>)> {
        let near = self.pairs.lists_around(place).take_while(|&(metres, _)| metres <= self.limit);
        near.map(|(metres, lists)| (self.pairs.least_units(metres), lists))
    }
}

impl MatchedPairs<'_> {
    /// How many tracks the assignment leaves out; `None` when one of them is not backed.
    fn left_out(&self, rows: &[Row], columns: &[Column]) -> Option<usize> {
        let spare = columns.iter().skip(self.pairs.detections.len());
        let mut left = spare.map(|column| column.row).filter(|&row| row != NONE);
        left.try_fold(0_usize, |count, row| {
            is_row_backed(rows, usize::from(row)).then(|| count.saturating_add(1))
        })
    }

    /// The index of the first track of which no detection is near enough, and which may not be
    /// left out; `spare`: how many may.
    fn lone(&self, rows: &[Row], gated: usize, spare: usize) -> Option<usize> {
        let Self { pairs, limit, .. } = self;
        let is_lone = |&row: &usize| {
            if spare > 0 && is_row_backed(rows, row) {
                return false;
            }
            let mut near = (0..pairs.detections.len()).filter_map(|it| pairs.get(rows, row, it));
            !near.any(|Pair(t, d)| certainly_closer(pairs.places.metres(t, d), *limit))
        };
        (0..gated).find(is_lone).and_then(|row| rows.get(row)).map(|row| usize::from(row.track))
    }
}

/// The bound covers the error of `Places::metres`; limits are at least 1e-3 m.
fn certainly_closer(metres: f64, limit: f64) -> bool {
    metres * (1.0 + 1e-14) + 1e-10 < limit
}
