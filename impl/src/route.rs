//! The route as geometry: reference path and corridor
//! (`spec/3-stages.md#stage-ii-trajectory-to-map`).

use core::cmp::Ordering;

use crate::cycle::{Route, Station};
use crate::exact::orientation;
use crate::plane::{same_point, segment_distance};
use crate::rounding::Real;

/// A segment of the reference path.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Segment {
    pub(crate) index: usize,
    pub(crate) from: [f64; 2],
    pub(crate) to: [f64; 2],
}

/// The segments of the reference path in order. The closing segment of a closed route whose last
/// and first reference point are equal is a point of its neighbours, and none.
pub(crate) fn segments<'a>(route: &Route<'a>) -> impl Iterator<Item = Segment> + 'a {
    pairs(route).enumerate().filter_map(|(index, (a, b))| {
        let (from, to) = ([a.x, a.y], [b.x, b.y]);
        (!same_point(from, to)).then_some(Segment { index, from, to })
    })
}

/// Whether the point is in the corridor; exact.
pub(crate) fn in_corridor(route: &Route<'_>, q: [f64; 2]) -> bool {
    pairs(route).any(|(a, b)| {
        in_triangle([a.left, a.right, b.right], q) || in_triangle([a.left, b.right, b.left], q)
    })
}

/// Whether the point is certainly at most `limit` from the reference path.
pub(crate) fn certainly_near(route: &Route<'_>, q: [f64; 2], limit: f64) -> bool {
    segments(route).any(|segment| {
        let Segment { from, to, .. } = segment;
        apart(segment, q) <= limit
            && segment_distance(q, from, to).certainly_at_most(Real::new(limit))
    })
}

/// The distance to the reference path; `hint`: index of a segment that may be near. The indices of
/// the segments looked at depend on the hint, the result does not but for its bound.
pub(crate) fn path_distance(route: &Route<'_>, q: [f64; 2], hint: usize) -> (Real, usize) {
    let length = |s: &Segment| segment_distance(q, s.from, s.to);
    let first = segments(route).find(|segment| segment.index == hint);
    let unknown = (Real::new(f64::MAX), hint);
    let start = first.map_or(unknown, |segment| (length(&segment), hint));
    segments(route).fold(start, |(best, at), segment| {
        if apart(segment, q) > best.magnitude() {
            return (best, at);
        }
        let candidate = length(&segment);
        let nearer = (candidate - best).value() < 0.0;
        let at = if nearer { segment.index } else { at };
        (best.min(candidate), at)
    })
}

/// Lower bound on the distance from the point to the segment: to its bounding box, in plain
/// doubles, taken down by more than the one rounding it has.
pub(crate) fn apart(segment: Segment, q: [f64; 2]) -> f64 {
    let [ax, ay] = segment.from;
    let [bx, by] = segment.to;
    let [x, y] = q;
    let dx = (ax.min(bx) - x).max(x - ax.max(bx));
    let dy = (ay.min(by) - y).max(y - ay.max(by));
    dx.max(dy).max(0.0) * (1.0 - 1e-15)
}

/// Consecutive stations, with the last and the first one of a closed route.
fn pairs<'a>(route: &Route<'a>) -> impl Iterator<Item = (&'a Station, &'a Station)> + use<'a> {
    let stations = route.stations;
    let closing = if route.closed { stations.last().zip(stations.first()) } else { None };
    stations.iter().zip(stations.iter().skip(1)).chain(closing)
}

/// Whether the point is in the closed triangle; exact. Outside the bounding box it never is;
/// inside, the sides of a triangle without area see the point all on one side only on its line.
fn in_triangle(corners: [[f64; 2]; 3], q: [f64; 2]) -> bool {
    let [a, b, c] = corners;
    if !(0..2).all(|axis| in_range(corners, q, axis)) {
        return false;
    }
    let sides = [orientation(a, b, q), orientation(b, c, q), orientation(c, a, q)];
    sides.iter().all(|&side| side != Ordering::Less)
        || sides.iter().all(|&side| side != Ordering::Greater)
}

/// Whether the point is within the extent of the corners along one axis; comparisons are exact.
fn in_range(corners: [[f64; 2]; 3], q: [f64; 2], axis: usize) -> bool {
    let value = |[x, y]: [f64; 2]| if axis == 0 { x } else { y };
    corners.iter().any(|&corner| value(corner) <= value(q))
        && corners.iter().any(|&corner| value(corner) >= value(q))
}

#[cfg(test)]
mod tests;
