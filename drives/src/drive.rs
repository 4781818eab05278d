//! Drives: cycles made from recorded traffic, from maps, or read as records.

use mufasa_model::input::cycle::Cycle;

/// A sequence of cycles with its origin.
#[derive(Clone, Debug, PartialEq)]
pub struct Drive {
    /// Short name, unique among the drives of one run.
    pub name: String,
    /// Files that it was read from.
    pub source: String,
    /// Cycles: of recordings and maps in order of time, of records in the order of their lines,
    /// whatever times they have.
    pub cycles: Vec<DriveCycle>,
    /// Who provides `previous_tracks`.
    pub previous_tracks: PreviousTracks,
    /// Decisions of the reader that a judgement of this drive depends on.
    pub notes: Vec<String>,
}

/// Who provides the `previous_tracks` of the cycles of a drive.
///
/// By H-09 (`spec/3-stages.md#hardened-profile`) they are the last list that stage i passed in a
/// safe cycle, so a source without verdicts cannot know them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PreviousTracks {
    /// The check, which carries them from cycle to cycle; the reader leaves `None`.
    Carried,
    /// The source; they stay as they are, `None` included.
    AsGiven,
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
