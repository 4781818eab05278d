//! Scratch memory that the caller lends to stage i, and to what rests on the detection history (`spec/4-arithmetic.md#conformance-of-an-implementation`).

use core::mem::size_of;

use crate::input::cycle::Cycle;
use crate::report::{InvalidInput, Problem};

/// Working memory for one row of the assignment; its content between cycles means nothing. Source:
/// `spec/4-arithmetic.md#conformance-of-an-implementation`.
#[derive(Clone, Copy, Debug, Default)]
pub struct Row {
    /// Dual potential.
    pub(crate) potential: i64,
    /// Index of a gated track in the track list.
    pub(crate) track: u16,
    /// Column assigned to this row, or `NONE`.
    pub(crate) column: u16,
    /// Of the track with the index of this row: its detection, where `seen` says that there is one.
    pub(crate) detection: u16,
    /// Of the track with the index of this row: what the CAV saw of it, see `detection_history`.
    pub(crate) seen: u16,
}

impl Row {
    /// A place to be lent; a constant, so that it needs no heap. Source:
    /// `spec/4-arithmetic.md#conformance-of-an-implementation`.
    pub const EMPTY: Self = Self { potential: 0, track: 0, column: 0, detection: 0, seen: 0 };
}

/// Working memory for one column of the assignment; its content between cycles means nothing.
/// Source: `spec/4-arithmetic.md#conformance-of-an-implementation`.
#[derive(Clone, Copy, Debug, Default)]
pub struct Column {
    /// Dual potential.
    pub(crate) potential: i64,
    /// Length of the shortest path that is known, or `UNKNOWN`.
    pub(crate) distance: i64,
    /// Row assigned to this column, or `NONE`.
    pub(crate) row: u16,
    /// Row before this column on the shortest path.
    pub(crate) before: u16,
    /// A column that a path reaches, see `assignment::Paths`.
    pub(crate) reached: u16,
    /// Stage i's lists of columns by their places.
    pub(crate) near: Link,
    /// Whether a track of stage i has taken the detection with the index of this column, see `pairing`.
    pub(crate) is_taken: bool,
    /// Which track has the item with the index of this column, see `detection_history::own`.
    pub(crate) owner: u16,
    /// Which track may explain the detection with the index of this column, see `explained`.
    pub(crate) explained_by: u16,
    /// The items of earlier lists by squares, see `detection_history::squares`.
    pub(crate) squares: [Link; 4],
}

/// Lists in an array: of the list with the index of its element the head, and of the item with that index
/// the next one.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Link {
    pub(crate) head: u16,
    pub(crate) next: u16,
}

impl Column {
    /// A place to be lent; a constant, so that it needs no heap. Source:
    /// `spec/4-arithmetic.md#conformance-of-an-implementation`.
    pub const EMPTY: Self = Self {
        potential: 0,
        distance: 0,
        row: 0,
        before: 0,
        reached: 0,
        near: Link::EMPTY,
        is_taken: false,
        owner: 0,
        explained_by: 0,
        squares: [Link::EMPTY; 4],
    };
}

impl Link {
    const EMPTY: Self = Self { head: 0, next: 0 };
}

/// No row, column or detection: there are at most 2112.
pub(crate) const NONE: u16 = u16::MAX;
/// No path.
pub(crate) const UNKNOWN: i64 = i64::MAX;

/// An index as it is kept here.
pub(crate) fn short(index: usize) -> u16 {
    u16::try_from(index).unwrap_or(NONE)
}

/// How many elements of each kind a cycle needs. Source:
/// `spec/4-arithmetic.md#conformance-of-an-implementation`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Sizes {
    /// Elements of the slice of rows.
    pub rows: usize,
    /// Elements of the slice of columns.
    pub columns: usize,
}

impl Sizes {
    /// What any cycle within the domain needs.
    pub const MAX: Self = Self { rows: 1024, columns: 2112 };

    /// How many bytes that is: 16 for a row and 48 for a column where 64-bit integers are aligned
    /// to 8 bytes, at most 117,760 in all. Nothing else is needed, however large the grid. Source:
    /// `spec/4-arithmetic.md#conformance-of-an-implementation`.
    pub const fn bytes(self) -> usize {
        let rows = self.rows.saturating_mul(size_of::<Row>());
        rows.saturating_add(self.columns.saturating_mul(size_of::<Column>()))
    }

    /// What this cycle needs; O(1). Source:
    /// `spec/4-arithmetic.md#conformance-of-an-implementation`.
    pub fn for_cycle(cycle: &Cycle<'_>) -> Self {
        let tracks = cycle.tracks.map_or(0, |list| list.items.len());
        let detections = cycle.detections.map_or(0, |list| list.items.len());
        let spare = usize::try_from(cycle.parameters.miss_budget).unwrap_or(0).min(tracks);
        let history = cycle.detection_history.iter().map(|list| list.items.len());
        let columns = detections.saturating_add(spare).max(tracks);
        Self { rows: tracks, columns: history.fold(columns, usize::max) }
    }
}

/// Memory lent by the caller for one call of `cycle::check`. Source:
/// `spec/4-arithmetic.md#conformance-of-an-implementation`.
#[derive(Debug)]
pub struct Scratch<'a> {
    pub(crate) rows: &'a mut [Row],
    pub(crate) columns: &'a mut [Column],
}

impl<'a> Scratch<'a> {
    /// Scratch from two slices of at least the `Sizes` of the cycle. Source:
    /// `spec/4-arithmetic.md#conformance-of-an-implementation`.
    pub fn new(rows: &'a mut [Row], columns: &'a mut [Column]) -> Self {
        Self { rows, columns }
    }

    /// Whether the slices are large enough; an error with field `scratch` otherwise.
    pub(crate) fn fits(&self, cycle: &Cycle<'_>) -> Result<(), InvalidInput> {
        let sizes = Sizes::for_cycle(cycle);
        if self.rows.len() < sizes.rows || self.columns.len() < sizes.columns {
            let problem = Problem::ScratchTooSmall;
            return Err(InvalidInput { field: "scratch", index: None, problem });
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::Sizes;

    #[test]
    fn the_bytes_are_as_documented() {
        assert_eq!(Sizes { rows: 1, columns: 0 }.bytes(), 16);
        assert_eq!(Sizes { rows: 0, columns: 1 }.bytes(), 48);
        assert_eq!(Sizes::MAX.bytes(), 117_760);
    }
}
