//! Whether the path is within reach (`spec/hardened/H-14.md#requirements-reach`).

use crate::hardened::h14_fail_safe::excess::Excess;
use crate::hardened::h14_fail_safe::nodes::Nodes;
use crate::hardened::h14_fail_safe::path::{Path, Place};
use crate::hardened::h14_fail_safe::times::{Times, longest};
use crate::input::cycle::{Cycle, TrajectoryPoint};
use crate::numbers::plane::Vector;
use crate::numbers::range::{larger, smaller};
use crate::numbers::rounding::Real;
use crate::report::{Rule, Witness};
use crate::stages::llcc::sweep::split;
use crate::stages::llcc::vector;

/// How far a turn may be off times f, m.
const ASIDE: f64 = 0.5;
/// For each m ahead: what it may start turned.
const TURNED: f64 = 0.17;
/// How far behind an earlier point one may be that is no node, m.
const BACK: f64 = 0.125;

/// The first point that is no node, or place, that is not certainly within reach. Most paths are told line by line:
/// without that stage ii of W1 and W2 takes a third more instructions. `aside`: not below any excess, m.
pub(crate) fn reach_failure(
    cycle: &Cycle<'_>,
    points: &[TrajectoryPoint],
    aside: f64,
) -> Option<Witness> {
    let (nodes, plain) = (Nodes::new(cycle, points), Plain::new(cycle));
    let (excess, p) = (Excess::new(cycle), [cycle.ego.x, cycle.ego.y]);
    let tolerance = Real::new(cycle.parameters.lateral_tolerance);
    let may_exceed = aside > cycle.parameters.lateral_tolerance;
    let failure = |excess: Real| {
        // H-14.15
        let witness = || Witness::of(Rule::Reach, [excess, tolerance].map(Real::value));
        (may_exceed && !excess.certainly_at_most(tolerance)).then(witness)
    };
    let mut farthest = None;
    let mut others = nodes.others(points).iter().enumerate();
    let beyond = others.find_map(|(index, point)| {
        let at = Vector::new(point.x, point.y) - vector(p);
        let progress = at.dot(vector([cycle.ego.cos, cycle.ego.sin]));
        let ahead = farthest.map_or(progress, |it: Real| it.max(progress));
        farthest = Some(ahead);
        let found = failure(excess.of_point(point)).or_else(|| back_failure(ahead - progress));
        found.map(|witness| witness.at_point(index))
    });
    if beyond.is_some() {
        return beyond;
    }
    let holds = |ends: [[f64; 2]; 2], heading: [f64; 2], length: f64| {
        plain.is_short(length)
            && plain.is_along(ends, heading)
            && (!may_exceed || excess.at_most(ends, heading) + 1e-6 < tolerance.value())
    };
    if nodes.lines().all(|it| holds([it.from, it.to], it.heading, it.length + it.more)) {
        return None;
    }
    let path = Path::new(nodes);
    path.pieces().find_map(|piece| {
        let holds = |run: [i64; 2]| {
            let [[x, y, _], [to_x, to_y, length]] = piece.between(run, p);
            holds([[x, y], [to_x, to_y]], piece.heading(), length)
        };
        piece.first_place(holds, |place| {
            if place.number == 0 {
                return None;
            }
            let found = failure(excess.of_place(&place.pose))
                .or_else(|| length_failure(piece.length_at(place), &path.times))
                .or_else(|| heading_failure(cycle, place));
            found.map(|witness| witness.at_point(place.point(points.len())))
        })
    })
}

fn length_failure(length: Real, times: &Times<Real>) -> Option<Witness> {
    // H-14.61
    let longest = longest(times.s_stop);
    let witness = || Witness::of(Rule::Reach, [length, longest].map(Real::value));
    (!length.certainly_at_most(longest)).then(witness)
}

fn heading_failure(cycle: &Cycle<'_>, place: &Place) -> Option<Witness> {
    let ego = &cycle.ego;
    let (h, away) = (vector([ego.cos, ego.sin]), place.pose.at - Vector::new(ego.x, ego.y));
    let (f, aside) = (away.dot(h).max(Real::ZERO), away.cross(h).abs());
    let heading = vector(place.pose.heading);
    // H-14.62
    let (along, sine) = (h.dot(heading), h.cross(heading).abs());
    if !Real::ZERO.certainly_below(along) {
        return Some(Witness::of(Rule::Reach, [along.value(), 0.0]));
    }
    let turned = Real::new(TURNED);
    let arc = [f * sine, turned * f + aside + aside + Real::new(ASIDE)];
    let witness = || Witness::of(Rule::Reach, arc.map(Real::value));
    (!arc[0].certainly_at_most(arc[1])).then(witness)
}

/// So far behind an earlier point, m.
fn back_failure(back: Real) -> Option<Witness> {
    // H-14.67
    let most = Real::new(BACK);
    let witness = || Witness::of(Rule::Reach, [back, most].map(Real::value));
    (!back.certainly_at_most(most)).then(witness)
}

/// What plain doubles say, from p on: they err by less than 2^-20 m up to 2^26 m, and by less than 1e-12
/// of what is farther.
struct Plain {
    h: [f64; 2],
    longest: f64,
}

impl Plain {
    fn new(cycle: &Cycle<'_>) -> Self {
        let s_stop = Times::<f64>::new(cycle).s_stop;
        Self { h: [cycle.ego.cos, cycle.ego.sin], longest: longest(s_stop) }
    }

    /// Whether a length certainly is within the greatest.
    fn is_short(&self, length: f64) -> bool {
        length < self.longest * (1.0 - 1e-9) - 1e-6
    }

    /// Whether the heading certainly is near to that of an arc, at all that is between two places: f is greatest at one of
    /// them, the way aside least at one or 0.
    fn is_along(&self, ends: [[f64; 2]; 2], heading: [f64; 2]) -> bool {
        let [along, turned] = split(self.h, heading);
        let [[f, aside], [f_to, aside_to]] = ends.map(|place| split(self.h, place));
        let apart = aside * aside_to > 0.0;
        let aside = if apart { smaller(aside.abs(), aside_to.abs()) } else { 0.0 };
        let f = larger(larger(f, f_to), 0.0);
        along > 1e-6 && f * (turned.abs() - TURNED) + 1e-6 + 1e-9 * f < 2.0 * aside + ASIDE
    }
}
