//! Drives: cycles made from recorded traffic, from maps, or read as records.
//!
//! A drive is a sequence of cycles for the monitor. What the source does not say (which groups
//! are remote, what the sensors saw, how old the data are) comes from [`Options`] and is written
//! down in [`Drive::notes`].

mod error;
mod options;

pub use error::ReadError;
pub use options::{GridSize, Options, Sensor, Tail};

use mufasa_model::cycle::Cycle;

/// A sequence of cycles with its origin.
#[derive(Clone, Debug, PartialEq)]
pub struct Drive {
    /// Short name, unique among the drives of one run.
    pub name: String,
    /// Files that it was read from.
    pub source: String,
    /// Cycles in order of time.
    pub cycles: Vec<DriveCycle>,
    /// Decisions of the reader that a judgement of this drive depends on.
    pub notes: Vec<String>,
}

/// One cycle of a drive.
#[derive(Clone, Debug, PartialEq)]
pub struct DriveCycle {
    /// Identity of the cycle, unique within the drive.
    pub id: String,
    /// The record.
    pub cycle: Cycle,
}
