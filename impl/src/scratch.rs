//! Scratch memory that the caller lends to stage i (`spec/4-arithmetic.md#conformance-of-an-implementation`).

use crate::cycle::Cycle;
use crate::verdict::{InvalidInput, Problem};

/// Working memory for one row of the assignment; its content between cycles means nothing.
#[derive(Clone, Copy, Debug, Default)]
pub struct Row {
    /// Index of a gated track in the track list.
    pub(crate) track: usize,
    /// Column assigned to this row, if any.
    pub(crate) column: Option<usize>,
    /// Dual potential.
    pub(crate) potential: i64,
}

/// Working memory for one column of the assignment; its content between cycles means nothing.
#[derive(Clone, Copy, Debug, Default)]
pub struct Column {
    /// Row assigned to this column, if any.
    pub(crate) row: Option<usize>,
    /// Row before this column on the shortest path.
    pub(crate) before: usize,
    /// Dual potential.
    pub(crate) potential: i64,
    /// Length of the shortest path that is known, if one is.
    pub(crate) distance: Option<i64>,
    /// The shortest path is final.
    pub(crate) scanned: bool,
}

/// How many elements of each kind a cycle needs.
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

    /// What this cycle needs; O(tracks + detections).
    pub fn for_cycle(cycle: &Cycle<'_>) -> Self {
        let tracks = cycle.tracks.map_or(0, |list| list.items.len());
        let detections = cycle.detections.map_or(0, |list| list.items.len());
        let spare = usize::try_from(cycle.parameters.miss_budget).unwrap_or(0).min(tracks);
        Self { rows: tracks, columns: detections.saturating_add(spare).max(tracks) }
    }
}

/// Memory lent by the caller for one call of `schedule::check`.
#[derive(Debug)]
pub struct Scratch<'a> {
    pub(crate) rows: &'a mut [Row],
    pub(crate) columns: &'a mut [Column],
}

impl<'a> Scratch<'a> {
    /// Scratch from two slices of at least the `Sizes` of the cycle.
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
