//! Drives: cycles made from recorded traffic, from maps, or read as records.

use mufasa_model::input::cycle::Cycle;

/// A sequence of cycles with its origin.
#[derive(Clone, Debug, PartialEq)]
pub struct Drive {
    /// Short name, unique among the drives of one run.
    pub name: String,
    /// Files that it was read from.
    pub source: String,
    /// How far the CAV's own sensor sees the leading vehicle, m; an attack under which the CAV
    /// drives elsewhere measures it anew.
    pub lead_range_m: f64,
    /// Cycles: of recordings and maps in order of time, of records in the order of their lines,
    /// whatever times they have.
    pub cycles: Vec<DriveCycle>,
    /// Decisions of the reader that a judgement of this drive depends on.
    pub notes: Vec<String>,
}

/// One cycle of a drive.
#[derive(Clone, Debug, PartialEq)]
pub struct DriveCycle {
    /// Name of the cycle: of recordings and maps unique within the drive, of records the id that
    /// they have, even if others have it as well.
    pub id: String,
    /// The record.
    pub cycle: Cycle,
}
