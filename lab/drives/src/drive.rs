//! Drives: cycles made from recorded traffic, from maps, or read as records.

use std::fmt;
use std::sync::Arc;

use mufasa_model::input::cycle::Cycle;

use crate::readers::error::ReadError;

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

/// A drive whose cycles are made when they are asked for, and not kept: a cycle takes about 50 kB,
/// the state that it is made of about 50 B.
#[derive(Clone)]
pub struct Stream {
    /// As of a [`Drive`].
    pub name: String,
    /// As of a [`Drive`].
    pub source: String,
    /// As of a [`Drive`].
    pub lead_range_m: f64,
    /// As of a [`Drive`].
    pub notes: Vec<String>,
    /// Whether options were given that have no effect on its cycles, because each has its own.
    pub ignores_options: bool,
    count: usize,
    make: Arc<Make>,
}

type Make = dyn Fn(usize) -> Result<DriveCycle, ReadError> + Send + Sync;

impl Stream {
    /// A drive of `count` cycles. `make` makes that of an index below it, the same every time.
    pub fn new(
        name: String,
        source: String,
        count: usize,
        make: impl Fn(usize) -> DriveCycle + Send + Sync + 'static,
    ) -> Self {
        Self::fallible(name, source, count, move |index| Ok(make(index)))
    }

    /// As [`Self::new`], of cycles that may be lost before they are made, as with the disk that they are on.
    pub fn fallible(
        name: String,
        source: String,
        count: usize,
        make: impl Fn(usize) -> Result<DriveCycle, ReadError> + Send + Sync + 'static,
    ) -> Self {
        let make = Arc::new(make);
        let (notes, ignores_options) = (Vec::new(), false);
        Self { name, source, lead_range_m: 0.0, notes, ignores_options, count, make }
    }

    /// How many cycles it has.
    pub fn count(&self) -> usize {
        self.count
    }

    /// The cycle of an index below [`Self::count`], made now. Errors: what it is made of cannot be read again.
    pub fn cycle(&self, index: usize) -> Result<DriveCycle, ReadError> {
        (self.make)(index)
    }

    /// The cycles in their order, each made when it is asked for. Errors: as of [`Self::cycle`].
    pub fn cycles(&self) -> impl Iterator<Item = Result<DriveCycle, ReadError>> + '_ {
        (0..self.count).map(|index| self.cycle(index))
    }

    /// The drive with all its cycles at once. Errors: as of [`Self::cycle`].
    pub fn collect(self) -> Result<Drive, ReadError> {
        let cycles = self.cycles().collect::<Result<_, _>>()?;
        let Self { name, source, lead_range_m, notes, .. } = self;
        Ok(Drive { name, source, lead_range_m, cycles, notes })
    }
}

impl From<Drive> for Stream {
    fn from(drive: Drive) -> Self {
        let Drive { name, source, lead_range_m, cycles, notes } = drive;
        let count = cycles.len();
        let stream = Self::new(name, source, count, move |index| cycles[index].clone());
        Self { lead_range_m, notes, ..stream }
    }
}

impl fmt::Debug for Stream {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { name, source, lead_range_m, notes, ignores_options, count, make: _ } = self;
        let mut of = f.debug_struct("Stream");
        of.field("name", name).field("source", source).field("lead_range_m", lead_range_m);
        of.field("notes", notes).field("ignores_options", ignores_options);
        of.field("count", count).finish_non_exhaustive()
    }
}
