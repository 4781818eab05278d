//! The implementation as it is timed: validation of the input and each stage alone, and whole
//! cycles.

use mufasa::cycle::Cycle;
use mufasa::schedule::{Valid, check};
use mufasa::scratch::{Column, Row, Scratch, Sizes};
use mufasa::verdict::{Outcome, Report, Stage};

/// Scratch memory of one cycle.
pub struct Memory {
    rows: Vec<Row>,
    columns: Vec<Column>,
}

impl Memory {
    /// As much as the cycle needs.
    pub fn for_cycle(cycle: &Cycle<'_>) -> Self {
        let Sizes { rows, columns } = Sizes::for_cycle(cycle);
        Self { rows: vec![Row::default(); rows], columns: vec![Column::default(); columns] }
    }

    fn lend(&mut self) -> Scratch<'_> {
        Scratch::new(&mut self.rows, &mut self.columns)
    }

    /// The report on a cycle as a vehicle asks for it.
    ///
    /// # Panics
    /// When its input is invalid.
    pub fn check(&mut self, cycle: &Cycle<'_>) -> Report {
        check(cycle, &mut self.lend()).expect("the workloads are valid input")
    }

    /// Whether the input is valid.
    pub fn validate(&mut self, cycle: &Cycle<'_>) -> bool {
        Valid::new(cycle, &self.lend()).is_ok()
    }

    /// A stage of a cycle whose input has been checked before.
    pub fn stage(&mut self, valid: &Valid<'_, '_>, stage: Stage) -> bool {
        valid.stage(stage, &mut self.lend()) == Outcome::Passed
    }

    /// The cycle made valid.
    ///
    /// # Panics
    /// When its input is invalid.
    pub fn valid<'c, 'a>(&mut self, cycle: &'c Cycle<'a>) -> Valid<'c, 'a> {
        Valid::new(cycle, &self.lend()).expect("the workloads are valid input")
    }

    /// Validation and then all five stages, more than any configuration runs in one cycle; ends
    /// at the first that fails.
    pub fn all_stages(&mut self, cycle: &Cycle<'_>) -> bool {
        let valid = self.valid(cycle);
        Stage::ALL.into_iter().all(|stage| self.stage(&valid, stage))
    }
}
