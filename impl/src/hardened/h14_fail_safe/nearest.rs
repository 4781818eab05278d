//! Where the reference path is nearest to a place, and whether it is beside it
//! (`spec/hardened/H-14.md#requirements-not-examined`).

use crate::input::cycle::CrossSection;
use crate::numbers::plane::{Vector, distance_to_segment};
use crate::numbers::rounding::Real;
use crate::stages::ii_trajectory_to_map::indexed_route::{IndexedRoute, Segment};

impl<'a> IndexedRoute<'_, 'a> {
    /// The distance of a place to the reference path.
    pub(crate) fn nearest(&self, place: Vector, hint: usize) -> Real {
        let (about, _) = self.about([place.x.value(), place.y.value()], hint);
        self.around(place, about)
            .map(|segment| distance_to_segment(place, segment.from, segment.to))
            .fold(Real::new(f64::MAX), Real::min)
    }

    /// Calls `ask` for each segment that may be as near as the nearest one (H-14.44).
    pub(crate) fn each_nearest(&self, place: Vector, least: Real, mut ask: impl FnMut(&Segment)) {
        let is_nearest = |segment: &Segment| {
            distance_to_segment(place, segment.from, segment.to).possibly_at_most(least)
        };
        self.around(place, least.value()).filter(is_nearest).for_each(|segment| ask(&segment));
    }

    /// The segments so near to a place that is rounded; 1e-3 m more than that errs, and `at_most`.
    fn around(&self, place: Vector, reach: f64) -> impl Iterator<Item = Segment> {
        let q = [place.x.value(), place.y.value()];
        let reach = reach + place.x.off() + place.y.off() + 1e-3;
        self.segments(q, reach).filter(move |segment| self.at_most(q, segment.index) <= reach)
    }

    /// Whether a place lies beyond neither end of the reference path, if it has ends; in plain doubles,
    /// if these tell.
    pub(crate) fn plainly_has_beside(&self, [x, y]: [f64; 2]) -> Option<bool> {
        let mut answer = Some(true);
        for (end, next) in self.ends() {
            let (u, v) = (next.x - end.x, next.y - end.y);
            let (along, error) = ((x - end.x) * u + (y - end.y) * v, 1e-6 * (u.abs() + v.abs()));
            if along < -error {
                return Some(false);
            }
            answer = answer.filter(|_| along > error);
        }
        answer
    }

    /// The same, where it certainly does (H-14.39).
    pub(crate) fn certainly_has_beside(&self, place: Vector) -> bool {
        self.ends().all(|(end, next)| {
            let along = Vector::between([end.x, end.y], [next.x, next.y]);
            Real::ZERO.certainly_below((place - Vector::new(end.x, end.y)).dot(along))
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
