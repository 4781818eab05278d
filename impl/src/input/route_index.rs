//! A route that has been checked and indexed once, for many cycles: maps change rarely
//! (`spec/3-stages.md#stage-ii-trajectory-to-map`). No verdict depends on it, only time.

use crate::input::cycle::{CrossSection, Route};
use crate::input::domain::route::check_route;
use crate::report::{InvalidInput, Problem};

/// Cross sections, or blocks, that are under one box.
const FAN: usize = 16;

/// Working memory for the index: the box around some cross sections, or around some boxes. Source:
/// `spec/3-stages.md#stage-ii-trajectory-to-map`.
#[derive(Clone, Copy, Debug)]
pub struct Block {
    least: [f64; 2],
    most: [f64; 2],
}

impl Default for Block {
    fn default() -> Self {
        Self::EMPTY
    }
}

impl Block {
    /// A place to be lent; a constant, so that it needs no heap. Source:
    /// `spec/3-stages.md#stage-ii-trajectory-to-map`.
    pub const EMPTY: Self = Self { least: [f64::MAX; 2], most: [f64::MIN; 2] };

    /// How many blocks the index of a route needs. Source:
    /// `spec/3-stages.md#stage-ii-trajectory-to-map`.
    pub const fn needed(cross_sections: usize) -> usize {
        cross_sections.div_ceil(FAN).saturating_add(cross_sections.div_ceil(FAN * FAN))
    }

    fn include(&mut self, point: [f64; 2]) {
        for ((least, most), value) in self.least.iter_mut().zip(&mut self.most).zip(point) {
            *least = least.min(value);
            *most = most.max(value);
        }
    }

    /// Whether a point of the box may be at most `reach` away along both axes; the one rounding of
    /// each difference is covered.
    fn near(&self, [x, y]: [f64; 2], reach: f64) -> bool {
        let ([ax, ay], [bx, by]) = (self.least, self.most);
        let reach = reach * (1.0 + 1e-15);
        ax - x <= reach && x - bx <= reach && ay - y <= reach && y - by <= reach
    }
}

/// A valid route with its index. Source: `spec/3-stages.md#stage-ii-trajectory-to-map`.
#[derive(Clone, Copy, Debug)]
pub struct RouteIndex<'a> {
    route: Route<'a>,
    leaves: &'a [Block],
    groups: &'a [Block],
}

impl<'a> RouteIndex<'a> {
    /// Checks the route and indexes it in the caller's memory, at least `Block::needed` of the
    /// number of cross sections. Time: linear in the cross sections.
    ///
    /// Errors: the first invalid value; too little memory. Source:
    /// `spec/3-stages.md#invalid-input`.
    pub fn new(route: Route<'a>, memory: &'a mut [Block]) -> Result<Self, InvalidInput> {
        check_route(&route)?;
        let count = route.cross_sections.len().div_ceil(FAN);
        let needed = Block::needed(route.cross_sections.len());
        let Some((leaves, groups)) =
            memory.get_mut(..needed).and_then(|all| all.split_at_mut_checked(count))
        else {
            let problem = Problem::ScratchTooSmall;
            return Err(InvalidInput { field: "route", index: None, problem });
        };
        groups.fill(Block::default());
        for (index, leaf) in leaves.iter_mut().enumerate() {
            *leaf = Block::default();
            // The last cross section of a block is the first one of the next: a segment is in one block.
            let first = index.saturating_mul(FAN);
            let own = route.cross_sections.iter().skip(first).take(FAN.saturating_add(1));
            let is_last = index.saturating_add(1) == count;
            let closing = route.cross_sections.first().filter(|_| route.closed && is_last);
            for &CrossSection { x, y, left, right } in own.chain(closing) {
                [[x, y], left, right].into_iter().for_each(|point| leaf.include(point));
            }
            if let Some(group) = groups.get_mut(index.wrapping_div(FAN)) {
                group.include(leaf.least);
                group.include(leaf.most);
            }
        }
        Ok(Self { route, leaves, groups })
    }

    /// The index that `new` has left in this memory, of this very route; `None` where that cannot be.
    pub(crate) fn of_kept(route: Route<'a>, memory: &'a [Block]) -> Option<Self> {
        let count = route.cross_sections.len().div_ceil(FAN);
        let all = memory.get(..Block::needed(route.cross_sections.len()))?;
        let (leaves, groups) = all.split_at_checked(count)?;
        Some(Self { route, leaves, groups })
    }

    /// Whether this is the index of these very cross sections: they are borrowed, so that they have not
    /// changed since.
    pub(crate) fn is_of(&self, route: &Route<'_>) -> bool {
        self.route.closed == route.closed
            && core::ptr::eq(self.route.cross_sections, route.cross_sections)
    }

    /// The first cross section of each block that has a point at most `reach` away along both axes.
    pub(crate) fn near(&self, point: [f64; 2], reach: f64) -> impl Iterator<Item = usize> {
        let Self { leaves, groups, .. } = *self;
        let near = move |blocks: &[Block], at: usize| {
            blocks.get(at).is_some_and(|block| block.near(point, reach))
        };
        (0..groups.len())
            .filter(move |&group| near(groups, group))
            .flat_map(|group| {
                let first = group.saturating_mul(FAN);
                first..first.saturating_add(FAN)
            })
            .filter(move |&leaf| near(leaves, leaf))
            .map(|leaf| leaf.saturating_mul(FAN))
    }
}

/// The indices of the segments that have a point, or the corridor beside them, at most `reach`
/// away; without an index all of them.
pub(crate) fn candidates(
    index: Option<&RouteIndex<'_>>,
    segments: usize,
    point: [f64; 2],
    reach: f64,
) -> impl Iterator<Item = usize> {
    let indexed = index.into_iter().flat_map(move |index| {
        let range = move |first: usize| first..first.saturating_add(FAN).min(segments);
        index.near(point, reach).flat_map(range)
    });
    let all = if index.is_none() { 0..segments } else { 0..0 };
    indexed.chain(all)
}

#[cfg(test)]
mod tests;
