//! How much H-14 has done: steps as of `spec/4-arithmetic.md#steps`, counted where it does them. Above
//! `work_limit` it stops, and the stage fails. By sizes alone nearly every list would have to be refused.

use core::cell::Cell;

use crate::input::parameters::Parameters;
use crate::numbers::rounding::Real;
use crate::report::{Rule, Witness};

/// The steps so far, and the most.
#[derive(Debug)]
pub(crate) struct Work {
    taken: Cell<u64>,
    most: u64,
}

impl Work {
    pub(crate) fn new(parameters: &Parameters) -> Self {
        let most = u64::try_from(parameters.work_limit).unwrap_or(0);
        Self { taken: Cell::new(0), most }
    }

    #[inline]
    pub(crate) fn add(&self, steps: u64) {
        // H-14.51
        self.taken.set(self.taken.get().saturating_add(steps));
    }

    #[inline]
    pub(crate) fn is_too_much(&self) -> bool {
        self.taken.get() > self.most
    }

    /// Why the stage fails, if it was too much (H-14.52).
    pub(crate) fn failure(&self) -> Option<Witness> {
        let real = |steps: u64| Real::integer(i64::try_from(steps).unwrap_or(i64::MAX)).value();
        // How much more depends on the order of items in an index.
        let compared = || [self.most.saturating_add(1), self.most].map(real);
        self.is_too_much().then(|| Witness::of(Rule::WorkLimit, compared()))
    }
}
