//! What the assignment of stage i pairs, and what it costs
//! (`spec/3-stages.md#stage-i-track-validation`).

use core::ops::Range;

use crate::input::cycle::{Detection, Track};
use crate::input::scratch::{Column, NONE, Row};
use crate::numbers::plane::distance;
use crate::numbers::rounding::Real;
use crate::stages::i_track_validation::assignment::Costs;
use crate::stages::i_track_validation::gate::apart_squared;
use crate::stages::i_track_validation::spatial_hash::ColumnsByCell;

/// Which track and detection a row and a column of the assignment stand for. Columns beyond these
/// are spare: any row may take one, at no cost.
pub(crate) struct Pairs<'a> {
    tracks: &'a [Track],
    detections: &'a [Detection],
    /// Rows are detections, columns gated tracks.
    swapped: bool,
    /// Every pair has to be closer, m.
    limit: f64,
    cells: ColumnsByCell,
}

/// A track and a detection.
struct Pair<'a>(&'a Track, &'a Detection);

impl<'a> Pairs<'a> {
    /// Prepares the columns. The gated tracks are those of the rows.
    pub(crate) fn new(
        (tracks, detections): (&'a [Track], &'a [Detection]),
        swapped: bool,
        limit: f64,
        rows: &[Row],
        columns: &mut [Column],
    ) -> Self {
        let cells = ColumnsByCell::new(columns, |column| {
            if swapped { track(tracks, rows, column) } else { detection(detections, column) }
        });
        Self { tracks, detections, swapped, limit, cells }
    }

    /// The pair; `None` for a spare column.
    fn get(&self, rows: &[Row], row: usize, column: usize) -> Option<Pair<'a>> {
        let (track, detection) = if self.swapped { (column, row) } else { (row, column) };
        let track = self.tracks.get(usize::from(rows.get(track)?.track))?;
        Some(Pair(track, self.detections.get(detection)?))
    }

    /// All pairs that were assigned.
    fn assigned(&self, rows: &[Row], columns: &[Column]) -> impl Iterator<Item = Pair<'a>> {
        columns.iter().enumerate().filter_map(|(column, entry)| {
            let row = usize::from(entry.row);
            if entry.row == NONE { None } else { self.get(rows, row, column) }
        })
    }

    /// Whether at least `k` pairs were assigned and no row twice: looked at again, so that no
    /// acceptance rests on the search.
    pub(crate) fn are_one_to_one(&self, rows: &[Row], columns: &[Column], k: usize) -> bool {
        let is_its_rows = |(index, column): (usize, &Column)| {
            let row = rows.get(usize::from(column.row));
            column.row == NONE || row.is_some_and(|row| usize::from(row.column) == index)
        };
        columns.iter().enumerate().all(is_its_rows) && self.assigned(rows, columns).count() >= k
    }

    /// The sum of the distances of all assigned pairs, m.
    pub(crate) fn sum(&self, rows: &[Row], columns: &[Column]) -> Real {
        self.assigned(rows, columns)
            .fold(Real::ZERO, |sum, Pair(t, d)| sum + distance([t.x, t.y], [d.x, d.y]))
    }

    /// The same in plain doubles: relative error below 2^-41.
    pub(crate) fn plain_sum(&self, rows: &[Row], columns: &[Column]) -> f64 {
        self.assigned(rows, columns).map(|pair| pair.metres()).sum()
    }

    /// The index of the first track of which no detection is near enough.
    pub(crate) fn lone(&self, rows: &[Row], gated: usize) -> Option<usize> {
        let is_lone = |&row: &usize| {
            let mut pairs = (0..self.detections.len()).filter_map(|it| self.get(rows, row, it));
            !pairs.any(|pair| certainly_closer(pair.metres(), self.limit))
        };
        (0..gated).find(is_lone).and_then(|row| rows.get(row)).map(|row| usize::from(row.track))
    }
}

impl Costs for Pairs<'_> {
    type Place = [f64; 2];

    fn place(&self, rows: &[Row], row: usize) -> Option<[f64; 2]> {
        if self.swapped { detection(self.detections, row) } else { track(self.tracks, rows, row) }
    }

    fn cost(&self, rows: &[Row], row: [f64; 2], column: usize) -> Option<i64> {
        let place = if self.swapped {
            track(self.tracks, rows, column)
        } else {
            detection(self.detections, column)
        };
        let Some(place) = place else { return Some(0) };
        let metres = metres(row, place);
        certainly_closer(metres, self.limit).then(|| units(metres))
    }

    fn lists(&self, row: [f64; 2]) -> impl Iterator<Item = (i64, Range<usize>)> {
        let lists = self.cells.around(row);
        lists
            .take_while(|&(metres, _)| metres <= self.limit)
            // Distances and units are rounded by less than the margin of the cells.
            .map(|(metres, lists)| (if metres > 0.0 { units(metres) } else { 0 }, lists))
    }
}

impl Pair<'_> {
    fn metres(&self) -> f64 {
        let Self(track, detection) = self;
        metres([track.x, track.y], [detection.x, detection.y])
    }
}

/// Distance in plain doubles, m: relative error below 4 * 2^-53, for distances above 1e-130.
fn metres(a: [f64; 2], b: [f64; 2]) -> f64 {
    libm::sqrt(apart_squared(a, b))
}

/// Where the gated track of a row is.
fn track(tracks: &[Track], rows: &[Row], row: usize) -> Option<[f64; 2]> {
    tracks.get(usize::from(rows.get(row)?.track)).map(|track| [track.x, track.y])
}

fn detection(detections: &[Detection], index: usize) -> Option<[f64; 2]> {
    detections.get(index).map(|detection| [detection.x, detection.y])
}

/// A distance in units of 2^-32 m, rounded up so that only coinciding points cost nothing. 2^20 m
/// stand for everything farther: no mean below `theta_tr` <= 1000 m of at most 1024 pairs has a
/// distance above 1,024,000 m.
#[allow(clippy::cast_possible_truncation, reason = "the argument is within 0 and 2^52")]
fn units(metres: f64) -> i64 {
    let whole = (metres.min(1_048_576.0) * 4_294_967_296.0) as i64;
    whole.saturating_add(i64::from(metres > 0.0))
}

/// The bound covers the error of `metres`; limits are at least 1e-3 m.
fn certainly_closer(metres: f64, limit: f64) -> bool {
    metres * (1.0 + 1e-14) < limit
}

#[cfg(test)]
mod tests;
