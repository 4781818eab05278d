//! How many close pairs are decided with error bounds, which takes a hundred times as long as plain
//! doubles do (`spec/4-arithmetic.md#strict-and-lax`, MARGIN-14, MARGIN-15).

use crate::report::{Rule, Witness};

/// So many in a stage, or in H-14.
const MOST: u16 = 1024;

/// The pairs that plain doubles left open and that are apart. Of those that meet there is one for each object.
#[derive(Debug, Default)]
pub(crate) struct ClosePairs {
    count: u16,
}

/// There are more than may be decided.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TooMany;

impl ClosePairs {
    /// Decides a pair that plain doubles leave open: what is found where it meets.
    pub(crate) fn decide<T>(&mut self, found: Option<T>) -> Result<Option<T>, TooMany> {
        self.count = self.count.saturating_add(u16::from(found.is_none()));
        if self.are_too_many() { Err(TooMany) } else { Ok(found) }
    }

    pub(crate) const fn are_too_many(&self) -> bool {
        self.count > MOST
    }

    /// Why the stage fails, if there are more than may be decided.
    pub(crate) fn failure(&self) -> Option<Witness> {
        let compared = || [self.count, MOST].map(f64::from);
        self.are_too_many().then(|| Witness::of(Rule::WorkLimit, compared()))
    }
}
