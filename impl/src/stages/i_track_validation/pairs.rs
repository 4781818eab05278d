//! What the assignment of stage i pairs, and what it costs
//! (`spec/3-stages.md#stage-i-track-validation`).

use core::ops::Range;

use crate::input::cycle::{Detection, Track};
use crate::input::scratch::{Column, NONE, Row};
use crate::numbers::rounding::Real;
use crate::stages::i_track_validation::assignment::Costs;
use crate::stages::i_track_validation::places::{Places, apart};
use crate::stages::i_track_validation::spatial_hash::ColumnsByCell;

/// What is paired.
#[derive(Clone, Copy)]
pub(crate) struct PairRules {
    /// Rows are detections, columns gated tracks.
    pub(crate) swapped: bool,
    /// Every pair has to be closer, m.
    pub(crate) limit: f64,
    /// What it costs to leave out a backed track, m.
    pub(crate) left_out: f64,
    /// Units of a cost per m.
    pub(crate) scale: f64,
}

/// Which track and detection a row and a column of the assignment stand for. Columns beyond these
/// are spare: the row of a backed track may take one, which leaves the track out.
pub(crate) struct Pairs<'a> {
    places: Places<'a>,
    detections: &'a [Detection],
    rules: PairRules,
    cells: ColumnsByCell,
}

/// A track and a detection.
struct Pair<'a>(&'a Track, &'a Detection);

impl<'a> Pairs<'a> {
    /// Prepares the columns. The gated tracks are those of the rows.
    pub(crate) fn new(
        (places, detections): (Places<'a>, &'a [Detection]),
        rules: PairRules,
        rows: &[Row],
        columns: &mut [Column],
    ) -> Self {
        let track = |row| gated(&places, rows, row).map(|track| places.of(track));
        let cells = ColumnsByCell::new(columns, |column| {
            if rules.swapped { track(column) } else { detection(detections, column) }
        });
        Self { places, detections, rules, cells }
    }

    /// The pair; `None` for a spare column.
    fn get(&self, rows: &[Row], row: usize, column: usize) -> Option<Pair<'a>> {
        let (track, detection) = if self.rules.swapped { (column, row) } else { (row, column) };
        Some(Pair(gated(&self.places, rows, track)?, self.detections.get(detection)?))
    }

    /// Whether the track of a row may be left out.
    fn is_backed(rows: &[Row], row: usize) -> bool {
        let track = rows.get(row).and_then(|row| rows.get(usize::from(row.track)));
        track.is_some_and(Row::is_backed)
    }

    /// How many tracks the assignment leaves out; `None` when one of them is not backed.
    pub(crate) fn left_out(&self, rows: &[Row], columns: &[Column]) -> Option<usize> {
        let spare = columns.iter().skip(self.detections.len());
        let mut left = spare.map(|column| column.row).filter(|&row| row != NONE);
        left.try_fold(0_usize, |count, row| {
            Self::is_backed(rows, usize::from(row)).then(|| count.saturating_add(1))
        })
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
            .fold(Real::ZERO, |sum, Pair(t, d)| sum + self.places.distance(t, d))
    }

    /// The same in plain doubles: relative error below 2^-41.
    pub(crate) fn plain_sum(&self, rows: &[Row], columns: &[Column]) -> f64 {
        self.assigned(rows, columns).map(|Pair(t, d)| self.places.metres(t, d)).sum()
    }

    /// The index of the first track of which no detection is near enough, and which may not be
    /// left out; `spare`: how many may.
    pub(crate) fn lone(&self, rows: &[Row], gated: usize, spare: usize) -> Option<usize> {
        let is_lone = |&row: &usize| {
            let track = rows.get(row).and_then(|row| rows.get(usize::from(row.track)));
            if spare > 0 && track.is_some_and(Row::is_backed) {
                return false;
            }
            let mut pairs = (0..self.detections.len()).filter_map(|it| self.get(rows, row, it));
            !pairs.any(|Pair(t, d)| certainly_closer(self.places.metres(t, d), self.rules.limit))
        };
        (0..gated).find(is_lone).and_then(|row| rows.get(row)).map(|row| usize::from(row.track))
    }
}

/// A row of the assignment: where it was, and how far it has moved since, m.
#[derive(Clone, Copy)]
pub(crate) struct Place {
    row: usize,
    at: [f64; 2],
    moved: [f64; 2],
}

impl Costs for Pairs<'_> {
    type Place = Place;

    fn place(&self, rows: &[Row], row: usize) -> Option<Place> {
        if self.rules.swapped {
            let at = detection(self.detections, row)?;
            return Some(Place { row, at, moved: [0.0; 2] });
        }
        let track = gated(&self.places, rows, row)?;
        Some(Place { row, at: [track.x, track.y], moved: self.places.moved(track) })
    }

    fn cost(&self, rows: &[Row], place: Place, column: usize) -> Option<i64> {
        let Place { row, at, moved } = place;
        let other = if self.rules.swapped {
            gated(&self.places, rows, column).map(|track| [track.x, track.y])
        } else {
            detection(self.detections, column)
        };
        let Some(other) = other else {
            return Self::is_backed(rows, row).then(|| self.units(self.rules.left_out));
        };
        let metres = apart(at, moved, other);
        certainly_closer(metres, self.rules.limit).then(|| self.units(metres))
    }

    fn lists(&self, place: Place) -> impl Iterator<Item = (i64, Range<usize>)> {
        let ([x, y], [dx, dy]) = (place.at, place.moved);
        let lists = self.cells.around([x + dx, y + dy]);
        lists
            .take_while(|&(metres, _)| metres <= self.rules.limit)
            // Distances and units are rounded by less than the margin of the cells.
            .map(|(metres, lists)| (if metres > 0.0 { self.units(metres) } else { 0 }, lists))
    }
}

impl Pairs<'_> {
    /// A distance in units, rounded up so that only coinciding points cost nothing. 2^20 m stand for
    /// everything farther: no mean below `theta_tr` <= 1000 m of at most 1024 pairs has a distance
    /// above 1,024,000 m.
    #[allow(clippy::cast_possible_truncation, reason = "the argument is within 0 and 2^56")]
    fn units(&self, metres: f64) -> i64 {
        let whole = (metres.min(1_048_576.0) * self.rules.scale) as i64;
        whole.saturating_add(i64::from(metres > 0.0))
    }
}

/// The gated track of a row.
fn gated<'a>(places: &Places<'a>, rows: &[Row], row: usize) -> Option<&'a Track> {
    places.tracks.get(usize::from(rows.get(row)?.track))
}

fn detection(detections: &[Detection], index: usize) -> Option<[f64; 2]> {
    detections.get(index).map(|detection| [detection.x, detection.y])
}

/// The bound covers the error of `Places::metres`; limits are at least 1e-3 m.
fn certainly_closer(metres: f64, limit: f64) -> bool {
    metres * (1.0 + 1e-14) + 1e-10 < limit
}

#[cfg(test)]
mod tests;
