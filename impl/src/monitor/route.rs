//! The route of the CAV with its index, in lent memory (`spec/monitor.md#monitor`).

use crate::input::cycle::{CrossSection, Route};
use crate::input::domain::route::check_route;
use crate::input::route_index::{Block, RouteIndex};
use crate::report::{InvalidInput, Problem};

/// A copy of the route that was set last, and its index; at first none.
#[derive(Debug)]
pub(crate) struct KeptRoute<'a> {
    pub(crate) cross_sections: &'a mut [CrossSection],
    pub(crate) blocks: &'a mut [Block],
    pub(crate) count: usize,
    pub(crate) closed: bool,
}

impl<'a> KeptRoute<'a> {
    pub(super) fn new(cross_sections: &'a mut [CrossSection], blocks: &'a mut [Block]) -> Self {
        Self { cross_sections, blocks, count: 0, closed: false }
    }

    /// Takes the place of the route before, or changes nothing.
    pub(crate) fn set(&mut self, route: &Route<'_>) -> Result<(), InvalidInput> {
        // MON-18
        check_route(route)?;
        let count = route.cross_sections.len();
        if self.cross_sections.len() < count || self.blocks.len() < Block::needed(count) {
            let problem = Problem::ScratchTooSmall;
            return Err(InvalidInput { field: "route", index: None, problem });
        }
        let pairs = self.cross_sections.iter_mut().zip(route.cross_sections);
        pairs.for_each(|(place, cross_section)| *place = *cross_section);
        (self.count, self.closed) = (count, route.closed);
        let kept = self.cross_sections.get(..count).unwrap_or(&[]);
        let kept = Route { closed: route.closed, cross_sections: kept };
        RouteIndex::new(kept, self.blocks).map(|_| ())
    }

    /// Without one it has no cross section, which no cycle accepts.
    pub(crate) fn route(&self) -> Route<'_> {
        let cross_sections = self.cross_sections.get(..self.count).unwrap_or(&[]);
        Route { closed: self.closed, cross_sections }
    }

    /// Whether one was set.
    pub(super) const fn is_set(&self) -> bool {
        self.count > 0
    }

    /// The index of that very route.
    pub(super) fn index(&self) -> Option<RouteIndex<'_>> {
        if self.count == 0 { None } else { RouteIndex::of_kept(self.route(), self.blocks) }
    }
}
