//! What the caller keeps between cycles: its route and its lists of detections, checked and indexed
//! once. No verdict depends on it, only time (`spec/4-arithmetic.md#conformance-of-an-implementation`).

use crate::input::cycle::{Cycle, Detection};
use crate::input::detection_index::DetectionIndex;
use crate::input::domain::{CheckedBefore, Fault, Usable, validate};
use crate::input::route_index::RouteIndex;

/// Indexes of some of a cycle's lists: the same items in the same memory; those of other lists are
/// not used. Source: `spec/4-arithmetic.md#conformance-of-an-implementation`.
#[derive(Clone, Copy, Debug, Default)]
pub struct Indexes<'i, 'a> {
    /// Of the route.
    pub route: Option<&'i RouteIndex<'a>>,
    /// Of current and earlier detections, in any order.
    pub detections: &'i [DetectionIndex<'a>],
}

impl<'i, 'a> Indexes<'i, 'a> {
    /// Checks all that has no index.
    pub(crate) fn validate(&self, cycle: &Cycle<'_>) -> Result<Usable, Fault> {
        let detections = &|items: &[Detection]| self.of(items).is_some();
        validate(cycle, &CheckedBefore { route: self.route.is_some(), detections })
    }

    /// The index of these detections.
    pub(crate) fn of(&self, items: &[Detection]) -> Option<&'i DetectionIndex<'a>> {
        self.detections.iter().find(|index| index.is_of(items))
    }
}
