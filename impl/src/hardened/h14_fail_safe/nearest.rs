//! Where the reference path is nearest to a place, and whether it is beside it, in plain doubles
//! (`spec/hardened/H-14.md#requirements-not-examined`).

use crate::hardened::h14_fail_safe::beside::{ERROR, SHORT};
use crate::input::cycle::CrossSection;
use crate::stages::ii_trajectory_to_map::indexed_route::{IndexedRoute, Segment};

impl<'a> IndexedRoute<'_, 'a> {
    /// The segments that may be as near as the nearest one (H-14.44), which is `away` m: `about` adds more than plain
    /// doubles err.
    pub(crate) fn nearest(&self, q: [f64; 2], away: f64) -> impl Iterator<Item = Segment> {
        self.segments(q, away).filter(move |it| it.square_to(q) <= away * away)
    }

    /// Whether a place certainly lies beyond neither end of the reference path, if it has ends (H-14.39).
    pub(crate) fn has_beside(&self, [x, y]: [f64; 2]) -> bool {
        self.ends().all(|(end, next)| {
            let (u, v) = (next.x - end.x, next.y - end.y);
            (x - end.x) * u + (y - end.y) * v > ERROR * (u.abs() + v.abs()) + SHORT
        })
    }

    /// The ends of an open route, each with the reference point next to it (H-14.39).
    fn ends(&self) -> impl Iterator<Item = (&'a CrossSection, &'a CrossSection)> {
        let (cross_sections, last) = (self.route.cross_sections, self.pairs());
        let ends = [[0, 1], [last, last.saturating_sub(1)]];
        let open = ends.into_iter().take(if self.route.closed { 0 } else { 2 });
        open.filter_map(move |[end, next]| cross_sections.get(end).zip(cross_sections.get(next)))
    }
}
