//! The implementation as it is timed: validation of the input and each stage alone, and whole
//! cycles. As with the peers, the route is indexed outside the measured time.

use std::hint::black_box;

use mufasa::input::cycle::Cycle;
use mufasa::input::route_index::{Block, RouteIndex};
use mufasa::input::scratch::{Column, Row, Scratch, Sizes};
use mufasa::report::{Outcome, Report, Stage};
use mufasa::stages::{ValidCycle, check, check_indexed};

/// A cycle with its scratch memory and the index of its route.
pub struct Contestant<'a> {
    cycle: &'a Cycle<'a>,
    index: Option<&'a RouteIndex<'a>>,
    valid: ValidCycle<'a, 'a>,
    rows: Vec<Row>,
    columns: Vec<Column>,
}

impl<'a> Contestant<'a> {
    /// With an index of the route, which is never freed: a bench ends soon.
    ///
    /// # Panics
    /// When the input is invalid.
    pub fn new(cycle: &'a Cycle<'a>) -> Self {
        let blocks = vec![Block::default(); Block::needed(cycle.route.cross_sections.len())].leak();
        let index = RouteIndex::new(cycle.route, blocks).expect("the workloads are valid input");
        Self::with_index(cycle, Some(Box::leak(Box::new(index))))
    }

    /// With as much scratch as the cycle needs.
    ///
    /// # Panics
    /// When the input is invalid.
    pub fn with_index(cycle: &'a Cycle<'a>, index: Option<&'a RouteIndex<'a>>) -> Self {
        let Sizes { rows, columns } = Sizes::for_cycle(cycle);
        let (mut rows, mut columns) =
            (vec![Row::default(); rows], vec![Column::default(); columns]);
        let scratch = Scratch::new(&mut rows, &mut columns);
        let valid = ValidCycle::new(cycle, index, &scratch);
        let valid = valid.expect("the workloads are valid input");
        Self { cycle, index, valid, rows, columns }
    }

    /// The report on the cycle as a vehicle asks for it.
    ///
    /// # Panics
    /// Never: the input is valid.
    pub fn check(&mut self) -> Report {
        let mut scratch = Scratch::new(&mut self.rows, &mut self.columns);
        let cycle = black_box(self.cycle);
        match self.index {
            Some(index) => check_indexed(cycle, index, &mut scratch),
            None => check(cycle, &mut scratch),
        }
        .expect("valid input")
    }

    /// Whether the input is valid.
    pub fn validate(&mut self) -> bool {
        let scratch = Scratch::new(&mut self.rows, &mut self.columns);
        ValidCycle::new(black_box(self.cycle), self.index, &scratch).is_ok()
    }

    /// One stage, the input having been checked before; whether it passes.
    pub fn stage(&mut self, stage: Stage) -> bool {
        let mut scratch = Scratch::new(&mut self.rows, &mut self.columns);
        black_box(&self.valid).stage(stage, &mut scratch) == Outcome::Passed
    }

    /// Validation and then all five stages, more than any configuration runs in one cycle; ends
    /// at the first that fails.
    pub fn all_stages(&mut self) -> bool {
        self.validate() && Stage::ALL.into_iter().all(|stage| self.stage(stage))
    }
}
