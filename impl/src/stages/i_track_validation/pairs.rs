//! What the assignment of stage i pairs, and what it costs
//! (`spec/3-stages.md#stage-i-track-validation`).

use core::ops::Range;

use crate::input::cycle::{Detection, Track};
use crate::input::scratch::{Column, NONE, Row};
use crate::numbers::rounding::Real;
use crate::stages::i_track_validation::assignment::Costs;
use crate::stages::i_track_validation::places::{Places, apart};
use crate::stages::i_track_validation::spatial_hash::ColumnsByCell;

/// Which track and detection a row and a column of the assignment stand for. Columns beyond these
/// are spare, and no pair.
pub(crate) struct Pairs<'a> {
    pub(crate) places: Places<'a>,
    pub(crate) detections: &'a [Detection],
    /// Rows are detections, columns gated tracks.
    swapped: bool,
    /// Units of a cost per m.
    scale: f64,
    cells: ColumnsByCell,
}

/// A track and a detection.
pub(crate) struct Pair<'a>(pub(crate) &'a Track, pub(crate) &'a Detection);

impl<'a> Pairs<'a> {
    /// Prepares the columns. The gated tracks are those of the rows.
    pub(crate) fn new(
        (places, detections): (Places<'a>, &'a [Detection]),
        swapped: bool,
        scale: f64,
        (rows, columns): (&[Row], &mut [Column]),
    ) -> Self {
        let track = |row| gated(&places, rows, row).map(|track| places.of(track));
        let cells = ColumnsByCell::new(columns, |column| {
            if swapped { track(column) } else { detection(detections, column) }
        });
        Self { places, detections, swapped, scale, cells }
    }

    /// The pair; `None` for a spare column.
    pub(crate) fn get(&self, rows: &[Row], row: usize, column: usize) -> Option<Pair<'a>> {
        let (track, detection) = if self.swapped { (column, row) } else { (row, column) };
        Some(Pair(gated(&self.places, rows, track)?, self.detections.get(detection)?))
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
        // S1-04
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
}

/// A row of the assignment: where it was, and how far it has moved since, m.
#[derive(Clone, Copy)]
pub(crate) struct Place {
    pub(crate) row: usize,
    at: [f64; 2],
    moved: [f64; 2],
}

impl Costs for Pairs<'_> {
    type Place = Place;

    fn place(&self, rows: &[Row], row: usize) -> Option<Place> {
        if self.swapped {
            let at = detection(self.detections, row)?;
            return Some(Place { row, at, moved: [0.0; 2] });
        }
        let track = gated(&self.places, rows, row)?;
        Some(Place { row, at: [track.x, track.y], moved: self.places.moved(track) })
    }

    fn cost(&self, rows: &[Row], place: Place, column: usize) -> Option<i64> {
        self.metres(rows, place, column).map(|metres| self.units(metres))
    }

    fn lists(&self, place: Place) -> impl Iterator<Item = (i64, Range<usize>)> {
        self.lists_around(place).map(|(metres, lists)| (self.least_units(metres), lists))
    }
}

impl Pairs<'_> {
    /// How far a row is from a column, m; `None` where that is spare.
    pub(crate) fn metres(&self, rows: &[Row], place: Place, column: usize) -> Option<f64> {
        let other = if self.swapped {
            gated(&self.places, rows, column).map(|track| [track.x, track.y])
        } else {
            detection(self.detections, column)
        };
        other.map(|other| apart(place.at, place.moved, other))
    }

    /// The lists of columns from near ones to far ones, with a lower bound on the distance, m.
    pub(crate) fn lists_around(&self, place: Place) -> impl Iterator<Item = (f64, Range<usize>)> {
        let ([x, y], [dx, dy]) = (place.at, place.moved);
        self.cells.around([x + dx, y + dy])
    }

    /// A distance in units, rounded up so that only coinciding points cost nothing. 2^20 m stand for
    /// everything farther: no mean below `theta_tr` <= 1000 m of at most 1024 pairs has a distance
    /// above 1,024,000 m.
    #[allow(clippy::cast_possible_truncation, reason = "the argument is within 0 and 2^56")]
    pub(crate) fn units(&self, metres: f64) -> i64 {
        let whole = (metres.min(1_048_576.0) * self.scale) as i64;
        whole.saturating_add(i64::from(metres > 0.0))
    }

    /// What a bound on distances says of costs: both are rounded by less than the margin of the cells.
    pub(crate) fn least_units(&self, metres: f64) -> i64 {
        if metres > 0.0 { self.units(metres) } else { 0 }
    }
}

/// The gated track of a row.
fn gated<'a>(places: &Places<'a>, rows: &[Row], row: usize) -> Option<&'a Track> {
    places.tracks.get(usize::from(rows.get(row)?.track))
}

fn detection(detections: &[Detection], index: usize) -> Option<[f64; 2]> {
    detections.get(index).map(|detection| [detection.x, detection.y])
}

#[cfg(test)]
mod tests;
