//! Where and when a trajectory starts, and that it keeps to the corridor and its direction (H-07
//! of `spec/hardened/H-07.md`).

use crate::hardened::h14_fail_safe::widening::passes;
use crate::input::cycle::{Cycle, TrajectoryPoint};
use crate::numbers::plane::{Vector, distance};
use crate::numbers::range::larger;
use crate::numbers::rounding::Real;
use crate::numbers::time::{elapsed_ns, seconds};
use crate::report::{Rule, Witness};
use crate::stages::distances::Number;
use crate::stages::ii_trajectory_to_map::indexed_route::{IndexedRoute, STEPS, Segment};
use crate::stages::llcc::sweep::{minus, split};

/// Abs(heading x heading) at most this: a planner starts its trajectory at most 50 ms from now when
/// it turns faster than 1.7 rad/s.
const MOST_TURNED: f64 = 0.17;

/// Time and heading of the first point, where each point is at its time, and where the trajectory passes the CAV.
pub(crate) fn start_failure(cycle: &Cycle<'_>, points: &[TrajectoryPoint]) -> Option<Witness> {
    let first = points.first()?;
    let age_ns = elapsed_ns(first.t_ns, cycle.now_ns);
    let max_age_ns = cycle.parameters.max_age_ns;
    // H-07.1
    if !is_in_time(age_ns, max_age_ns) {
        let compared =
            [age_ns.saturating_abs(), max_age_ns].map(|time_ns| Real::seconds(time_ns).value());
        return Some(Witness::of(Rule::StartTime, compared).at_point(0));
    }
    let ahead = position_failure(cycle, points);
    if ahead.is_some() {
        return ahead;
    }
    let [own, heading] = [(cycle.ego.cos, cycle.ego.sin), (first.cos, first.sin)]
        .map(|(cos, sin)| Vector::new(cos, sin));
    let (along, turned) = (own.dot(heading), own.cross(heading).abs());
    let at_most = |value: Real, limit: Real| (value, limit, value.certainly_at_most(limit));
    let rules = [
        // H-07.3, H-07.4
        (Rule::StartHeading, (along, Real::ZERO, Real::ZERO.certainly_below(along))),
        (Rule::StartHeading, at_most(turned, Real::new(MOST_TURNED))),
        // H-07.5
        (
            Rule::StartOffset,
            at_most(passes(cycle, points), Real::new(cycle.parameters.lateral_tolerance)),
        ),
    ];
    let broken = rules.into_iter().find(|&(_, (.., is_kept))| !is_kept);
    broken.map(|(rule, (value, limit, _))| {
        Witness::of(rule, [value.value(), limit.value()]).at_point(0)
    })
}

/// A point that is farther from the CAV than it can drive by then (H-07.2).
fn position_failure(cycle: &Cycle<'_>, points: &[TrajectoryPoint]) -> Option<Witness> {
    let p = [cycle.ego.x, cycle.ego.y];
    points.iter().enumerate().find_map(|(index, point)| {
        let (to, t_ns) = ([point.x, point.y], elapsed_ns(cycle.now_ns, point.t_ns));
        let (way, time_ns) = (minus(to, p), t_ns.saturating_abs());
        // Of most points plain doubles tell, which err by less than a millionth.
        let rough = farthest(cycle, t_ns, seconds(time_ns)) * (1.0 - 1e-6);
        if split(way, way)[0] < rough * rough {
            return None;
        }
        let (off, limit) = (distance(p, to), farthest(cycle, t_ns, Real::seconds(time_ns)));
        let witness = Witness::of(Rule::Position, [off.value(), limit.value()]).at_point(index);
        (!off.certainly_at_most(limit)).then_some(witness)
    })
}

/// How far from p a point may be whose time is so far from now.
fn farthest<N: Number>(cycle: &Cycle<'_>, t_ns: i64, time: N) -> N {
    let parameters = &cycle.parameters;
    let a_max = if t_ns < 0 { 0.0 } else { parameters.a_max };
    let [tolerance, v_now, half] =
        [parameters.start_tolerance, cycle.ego.speed, a_max * 0.5].map(N::from_double);
    tolerance.plus(v_now.times(time)).plus(half.times(time).times(time))
}

/// Whether a trajectory that is so old starts about now.
pub(crate) const fn is_in_time(age_ns: i64, max_age_ns: i64) -> bool {
    max_age_ns.saturating_neg() <= age_ns && age_ns <= max_age_ns
}

/// A point outside the corridor (H-07.6).
pub(crate) fn corridor_failure(
    route: IndexedRoute<'_, '_>,
    points: &[TrajectoryPoint],
) -> Option<Witness> {
    let mut hint = 0;
    points.iter().enumerate().find_map(|(index, point)| {
        let q = [point.x, point.y];
        //
        let inside = route.in_corridor(q, &mut hint);
        (!inside).then(|| route.too_far(q, hint, Rule::Corridor, 0.0).at_point(index))
    })
}

/// A point at which the heading is not certainly along every segment that may be nearest (H-07.7).
pub(crate) fn direction_failure(
    route: IndexedRoute<'_, '_>,
    points: &[TrajectoryPoint],
) -> Option<Witness> {
    let mut hint = 0;
    if let Some(first) = points.first() {
        // Segments beside a point in the corridor are near it.
        route.in_corridor([first.x, first.y], &mut hint);
    }
    let (mut rest, mut from) = (points, 0_usize);
    while !rest.is_empty() {
        let (run, behind) = rest.split_at_checked(RUN).unwrap_or((rest, &[]));
        if !all_certainly_along(route, run, &mut hint) {
            let not_along = |(point, index): (&TrajectoryPoint, usize)| {
                not_along(route, point, &mut hint).map(|it| it.at_point(index))
            };
            let found = run.iter().zip(from..).find_map(not_along);
            if found.is_some() {
                return found;
            }
        }
        (rest, from) = (behind, from.saturating_add(RUN));
    }
    None
}

/// A segment that may be nearest, and along which the heading of the point is not for certain.
fn not_along(
    route: IndexedRoute<'_, '_>,
    point: &TrajectoryPoint,
    hint: &mut usize,
) -> Option<Witness> {
    let q = [point.x, point.y];
    *hint = route.nearer(q, *hint);
    // Of these the nearest is one.
    if route.segments(q, route.at_most(q, *hint)).all(|it| is_along(point, &it)) {
        return None;
    }
    let (away, nearest) = route.about(q, *hint);
    *hint = nearest;
    // H-07.7
    let found = route.nearest(q, away).find(|it| !is_along(point, it))?;
    let [along, _] = split([point.cos, point.sin], found.way());
    let witness = Witness::of(Rule::Direction, [along, 0.0]);
    Some(Witness { segment: Some(found.index), ..witness })
}

/// Whether the heading certainly is along the segment. A dot product errs by less than 2^-50 of the sum of its
/// summands' sizes.
fn is_along(point: &TrajectoryPoint, segment: &Segment) -> bool {
    let [x, y] = segment.way();
    let (x, y) = (point.cos * x, point.sin * y);
    x + y > (x.abs() + y.abs()) * 1e-15 + 1e-300
}

/// So many points are looked at together.
const RUN: usize = 16;

/// Whether the headings are certainly along every segment that may be nearest to any of the points: all
/// headings and all segments within reach of the points are less than 45 degrees from the heading in the
/// middle. No segment that is nearest to a point is farther from the middle than twice as far as the
/// points are, and the segment of the hint. Directions are as long as 1 but for 5e-7, and products err
/// far less. Without it stage ii of W1 and W2 takes more than twice as many instructions.
fn all_certainly_along(
    route: IndexedRoute<'_, '_>,
    points: &[TrajectoryPoint],
    hint: &mut usize,
) -> bool {
    let Some(middle) = points.get(points.len() >> 1) else { return true };
    let (mut farthest, mut is_straight) = (0.0, true);
    for point in points {
        let (x, y) = (point.x - middle.x, point.y - middle.y);
        farthest = larger(farthest, x * x + y * y);
        let along = middle.cos * point.cos + middle.sin * point.sin;
        is_straight &= along > (middle.cos * point.sin - middle.sin * point.cos).abs() + 1e-3;
    }
    let q = [middle.x, middle.y];
    let near = route.nearer(q, *hint);
    let reach = route.at_most(q, near) + 2.0 * libm::sqrt(farthest) + 1e-3;
    let are_along = is_straight
        && route.segments(q, reach).all(|segment| {
            let ([ax, ay], [bx, by]) = (segment.from, segment.to);
            let (x, y) = (bx - ax, by - ay);
            let along = middle.cos * x + middle.sin * y;
            along > (middle.cos * y - middle.sin * x).abs() * (1.0 + 1e-3) + 1e-300
        });
    if are_along {
        *hint = near;
    }
    are_along
}

impl IndexedRoute<'_, '_> {
    /// Upper bound on the distance to a segment, and so to the reference path: to a point of it.
    /// Plain doubles err by less than 2^-22 m.
    pub(crate) fn at_most(&self, q: [f64; 2], index: usize) -> f64 {
        let square = self.segment(index).map(|segment| segment.square_to(q));
        square.map_or(f64::MAX, |square| libm::sqrt(square) + 1e-6)
    }

    /// A segment that is at least as near as that of the hint, as far as walking along the route
    /// leads there. A guess, in plain doubles.
    pub(crate) fn nearer(&self, q: [f64; 2], hint: usize) -> usize {
        let mut at = hint;
        for _ in 0..STEPS {
            let Some(Segment { from: [ax, ay], to: [bx, by], .. }) = self.segment(at) else {
                break;
            };
            let ([x, y], ux, uy) = (q, bx - ax, by - ay);
            let along = (x - ax) * ux + (y - ay) * uy;
            let next = at.saturating_add(1);
            if along > ux * ux + uy * uy && next < self.pairs() {
                at = next;
            } else {
                break;
            }
        }
        at
    }
}
