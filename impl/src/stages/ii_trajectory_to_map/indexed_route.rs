//! The route as geometry: reference path and corridor, with the index of the route when there is
//! one (`spec/3-stages.md#stage-ii-trajectory-to-map`).

use core::cmp::Ordering;

use crate::input::cycle::{CrossSection, Route};
use crate::input::route_index::{RouteIndex, candidates};
use crate::numbers::exact::{certain_orientation, orientation};
use crate::numbers::plane::same_point;
use crate::numbers::range::{larger, smaller};
use crate::report::{Rule, Witness};
use crate::stages::llcc::sweep::minus;

/// A segment of the reference path.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Segment {
    pub(crate) index: usize,
    pub(crate) from: [f64; 2],
    pub(crate) to: [f64; 2],
}

/// A route, and its index when there is one.
#[derive(Clone, Copy, Debug)]
pub(crate) struct IndexedRoute<'c, 'a> {
    pub(crate) route: &'c Route<'a>,
    index: Option<&'c RouteIndex<'a>>,
}

/// How far along the route a search goes for the place of the next trajectory point.
pub(crate) const STEPS: usize = 64;

impl<'c, 'a> IndexedRoute<'c, 'a> {
    pub(crate) const fn new(route: &'c Route<'a>, index: Option<&'c RouteIndex<'a>>) -> Self {
        Self { route, index }
    }

    /// The segments of the reference path in order, at least those within `reach` of the point.
    /// The closing segment of a closed route whose last and first reference point are equal is a
    /// point of its neighbours, and none.
    pub(crate) fn segments(&self, q: [f64; 2], reach: f64) -> impl Iterator<Item = Segment> {
        candidates(self.index, self.pairs(), q, reach)
            .filter_map(|index| self.segment(index))
            .filter(move |segment| apart(*segment, q) <= reach)
    }

    pub(crate) fn segment(&self, index: usize) -> Option<Segment> {
        let (a, b) = self.pair(index)?;
        let (from, to) = ([a.x, a.y], [b.x, b.y]);
        (!same_point(from, to)).then_some(Segment { index, from, to })
    }

    /// Whether the point is in the corridor; exact. `hint`: the cross sections that the point may be
    /// between, and where it was found.
    pub(crate) fn in_corridor(&self, q: [f64; 2], hint: &mut usize) -> bool {
        if let Some(at) = self.walk(q, *hint) {
            *hint = at;
            return true;
        }
        self.search_corridor(q, hint)
    }

    /// As `in_corridor`, for a point that is not where it was expected; such points are few.
    #[cold]
    fn search_corridor(&self, q: [f64; 2], hint: &mut usize) -> bool {
        let mut blocks = self.index.into_iter().flat_map(|index| index.near(q, 0.0));
        if let Some(at) = blocks.find_map(|start| self.walk(q, start)) {
            *hint = at;
            return true;
        }
        let found = candidates(self.index, self.pairs(), q, 0.0).find(|&index| {
            // S2-02
            self.pair(index).is_some_and(|(a, b)| {
                triangles(a, b).into_iter().any(|triangle| in_triangle(triangle, q))
            })
        });
        *hint = found.unwrap_or(*hint);
        found.is_some()
    }

    /// Whether the point is certainly at most `limit` from the reference path (S2-01), in plain doubles.
    pub(crate) fn certainly_near(&self, q: [f64; 2], limit: f64) -> bool {
        let reach = limit - 1e-6;
        self.segments(q, reach).any(|it| it.square_to(q) <= reach * reach)
    }

    /// The distance to the reference path in plain doubles, which err by less than 2^-22 m, and the segment that is so
    /// near; `hint`: one that may be near.
    pub(crate) fn about(&self, q: [f64; 2], hint: usize) -> (f64, usize) {
        let near = self.nearer(q, hint);
        let reach = self.at_most(q, near);
        let (square, at) = self.segments(q, reach).fold((f64::MAX, near), |best, segment| {
            let square = segment.square_to(q);
            if square < best.0 { (square, segment.index) } else { best }
        });
        (libm::sqrt(square), at)
    }

    /// How many segments `about` looks at, with the hint that `nearer` gives.
    pub(crate) fn count_within(&self, q: [f64; 2], hint: usize) -> u64 {
        let seen = candidates(self.index, self.pairs(), q, self.at_most(q, hint)).count();
        u64::try_from(seen).unwrap_or(u64::MAX)
    }

    /// The segments that may be as near as the nearest one, which is `away` m in plain doubles.
    pub(crate) fn nearest(&self, q: [f64; 2], away: f64) -> impl Iterator<Item = Segment> {
        let reach = away + 1e-6;
        self.segments(q, reach).filter(move |it| it.square_to(q) <= reach * reach)
    }

    /// The witness that a place is too far from the reference path.
    pub(crate) fn too_far(&self, q: [f64; 2], hint: usize, rule: Rule, limit: f64) -> Witness {
        let (away, segment) = self.about(q, hint);
        Witness { segment: Some(segment), ..Witness::of(rule, [away, limit]) }
    }

    /// From the cross sections of the hint forward while the point is beyond the next ones, in plain
    /// doubles; where it is certainly between.
    fn walk(&self, q: [f64; 2], hint: usize) -> Option<usize> {
        let (mut start, mut rest) = self.route.cross_sections.get(hint..)?.split_first()?;
        for at in (hint..).take(STEPS) {
            let (end, after) = rest.split_first()?;
            if !is_beyond(end, q) {
                return certainly_between(start, end, q).then_some(at);
            }
            (start, rest) = (end, after);
        }
        None
    }

    /// How many pairs of consecutive cross sections there are, with the last and the first one of a
    /// closed route.
    pub(crate) fn pairs(&self) -> usize {
        self.route.cross_sections.len().saturating_sub(usize::from(!self.route.closed))
    }

    /// The pair from that of the hint on of which the point is not in front, up to rounding.
    pub(crate) fn walked(&self, q: [f64; 2], hint: usize) -> usize {
        let is_beyond = |at: usize| self.pair(at).is_some_and(|(_, end)| is_beyond(end, q));
        (hint..).take(STEPS).find(|&at| !is_beyond(at)).unwrap_or(hint)
    }

    /// The pairs whose corners are around the point, up to `reach`.
    pub(crate) fn pairs_around(&self, q: [f64; 2], reach: f64) -> impl Iterator<Item = usize> {
        candidates(self.index, self.pairs(), q, reach).filter(move |&at| {
            self.pair(at).is_some_and(|(a, b)| {
                let corners = [a.left, a.right, b.right, b.left];
                (0..2).all(|axis| in_range(corners, q, axis, reach))
            })
        })
    }

    /// The cross section after those of the pair.
    pub(crate) fn after(&self, index: usize) -> Option<&'a CrossSection> {
        let next = index.saturating_add(1);
        let first = (self.route.closed && next == self.pairs()).then_some(0);
        self.pair(first.unwrap_or(next)).map(|(_, after)| after)
    }

    /// Consecutive cross sections, in a closed route the last and the first one, too.
    pub(crate) fn pair(&self, index: usize) -> Option<(&'a CrossSection, &'a CrossSection)> {
        let cross_sections = self.route.cross_sections;
        let next = cross_sections.get(index.saturating_add(1));
        // S2-01, S2-02: of a closed route the last and the first one, too
        let next = next.or_else(|| cross_sections.first().filter(|_| self.route.closed));
        cross_sections.get(index).zip(next)
    }
}

impl Segment {
    pub(crate) fn way(&self) -> [f64; 2] {
        minus(self.to, self.from)
    }

    /// m.
    pub(crate) fn length(&self) -> f64 {
        let [x, y] = self.way();
        libm::sqrt(x * x + y * y)
    }

    /// The way from its nearest point to q, in plain doubles.
    pub(crate) fn towards(&self, q: [f64; 2]) -> [f64; 2] {
        let ([ux, uy], [x, y]) = (self.way(), minus(q, self.from));
        let part = (x * ux + y * uy) / (ux * ux + uy * uy);
        let part = if part > 0.0 { part.min(1.0) } else { 0.0 };
        [x - part * ux, y - part * uy]
    }

    /// The square of the distance from q, m^2.
    pub(crate) fn square_to(&self, q: [f64; 2]) -> f64 {
        let [x, y] = self.towards(q);
        x * x + y * y
    }
}

/// Lower bound on the distance from the point to the segment: to its bounding box, in plain
/// doubles, taken down by more than the one rounding it has.
pub(crate) fn apart(segment: Segment, q: [f64; 2]) -> f64 {
    let [ax, ay] = segment.from;
    let [bx, by] = segment.to;
    let [x, y] = q;
    let dx = larger(smaller(ax, bx) - x, x - larger(ax, bx));
    let dy = larger(smaller(ay, by) - y, y - larger(ay, by));
    larger(larger(dx, dy), 0.0) * (1.0 - 1e-15)
}

/// The triangles of the corridor between two cross sections (S2-02).
pub(crate) const fn triangles(a: &CrossSection, b: &CrossSection) -> [[[f64; 2]; 3]; 2] {
    [[a.left, a.right, b.right], [a.left, b.right, b.left]]
}

/// Whether the point is in front of the line through the boundaries, up to rounding.
fn is_beyond(cross_section: &CrossSection, [x, y]: [f64; 2]) -> bool {
    let ([lx, ly], [rx, ry]) = (cross_section.left, cross_section.right);
    (lx - rx) * (y - ry) < (ly - ry) * (x - rx)
}

/// Whether the point is certainly in one of the two triangles between the cross sections, when their
/// corners turn left, as they do where left is left: the diagonal says in which of the two, and
/// two sides are left.
fn certainly_between(a: &CrossSection, b: &CrossSection, q: [f64; 2]) -> bool {
    let diagonal = certain_orientation(a.left, b.right, q);
    if diagonal < 0.0 {
        certain_orientation(a.left, a.right, q) > 0.0
            && certain_orientation(a.right, b.right, q) > 0.0
    } else {
        diagonal > 0.0
            && certain_orientation(b.right, b.left, q) > 0.0
            && certain_orientation(b.left, a.left, q) > 0.0
    }
}

/// Whether the point is in the closed triangle; exact. Outside the bounding box it never is;
/// inside, the sides of a triangle without area see the point all on one side only on its line.
fn in_triangle(corners: [[f64; 2]; 3], q: [f64; 2]) -> bool {
    let [a, b, c] = corners;
    if !(0..2).all(|axis| in_range(corners, q, axis, 0.0)) {
        return false;
    }
    // Most are told apart without exact numbers, which a triangle without width would always need.
    let sides = [[a, b], [b, c], [c, a]];
    let certain = sides.map(|[from, to]| certain_orientation(from, to, q));
    if certain.iter().any(|&side| side > 0.0) && certain.iter().any(|&side| side < 0.0) {
        return false;
    }
    let sides = sides.map(|[from, to]| orientation(from, to, q));
    sides.iter().all(|&side| side != Ordering::Less)
        || sides.iter().all(|&side| side != Ordering::Greater)
}

/// Whether the point is within the extent of the corners along one axis, or at most `reach` outside up to
/// rounding; without reach exact.
fn in_range<const N: usize>(corners: [[f64; 2]; N], q: [f64; 2], axis: usize, reach: f64) -> bool {
    let value = |[x, y]: [f64; 2]| if axis == 0 { x } else { y };
    corners.iter().any(|&corner| value(corner) <= value(q) + reach)
        && corners.iter().any(|&corner| value(corner) >= value(q) - reach)
}

#[cfg(test)]
mod tests;
