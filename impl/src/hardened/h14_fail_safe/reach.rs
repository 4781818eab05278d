//! Whether the path is within reach (`spec/hardened/H-14.md#requirements-reach`).

use crate::hardened::h14_fail_safe::nodes::Nodes;
use crate::hardened::h14_fail_safe::path::{Path, Place};
use crate::hardened::h14_fail_safe::times::{TYRES, Times, longest};
use crate::input::cycle::{Cycle, TrajectoryPoint};
use crate::numbers::plane::Vector;
use crate::numbers::range::{larger, smaller};
use crate::numbers::rounding::Real;
use crate::report::{Rule, Witness};
use crate::stages::llcc::sweep::{minus, split};
use crate::stages::llcc::vector;

/// What a trajectory may start aside, m, and what a turn may be off times f.
const ASIDE: f64 = 0.5;
/// For each m ahead: what it may start turned.
const TURNED: f64 = 0.17;
/// A car is taken to turn on no smaller circle, m: its radius.
const CIRCLE: f64 = 3.0;
/// Half of what tyres hold, m/s^2.
const HALF_TYRES: f64 = 0.5 * TYRES;

/// The first point that is no node, or place, that is not certainly within reach. Most paths are told line by line:
/// without that stage ii of W1 and W2 takes a third more instructions.
pub(crate) fn reach_failure(cycle: &Cycle<'_>, points: &[TrajectoryPoint]) -> Option<Witness> {
    let (nodes, plain) = (Nodes::new(cycle, points), Plain::new(cycle));
    let p = [cycle.ego.x, cycle.ego.y];
    let aside = nodes.others(points).iter().enumerate().find_map(|(index, point)| {
        let q = minus([point.x, point.y], p);
        if plain.is_within(q, q) {
            return None;
        }
        let found = failure(cycle, &Times::new(cycle), Vector::new(point.x, point.y));
        found.map(|witness| witness.at_point(index))
    });
    if aside.is_some() {
        return aside;
    }
    let holds = |ends: [[f64; 2]; 2], heading: [f64; 2], length: f64| {
        plain.is_within(ends[0], ends[1]) && plain.is_short(length) && plain.is_along(ends, heading)
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
            let found = failure(cycle, &path.times, place.pose.at)
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
    // H-14.62; A-10
    let (along, sine) = (h.dot(heading), h.cross(heading).abs());
    if !Real::ZERO.certainly_below(along) {
        return Some(Witness::of(Rule::Reach, [along.value(), 0.0]));
    }
    let turned = Real::new(TURNED);
    let arc = [f * sine, turned * f + aside + aside + Real::new(ASIDE)];
    let circle = [sine, turned + f.over(Real::new(CIRCLE))];
    let beyond = |[turned, bound]: &[Real; 2]| !turned.certainly_at_most(*bound);
    let found = [arc, circle].into_iter().find(beyond);
    found.map(|compared| Witness::of(Rule::Reach, compared.map(Real::value)))
}

fn failure(cycle: &Cycle<'_>, times: &Times<Real>, x: Vector) -> Option<Witness> {
    let ego = &cycle.ego;
    let away = x - Vector::new(ego.x, ego.y);
    let h = vector([ego.cos, ego.sin]);
    let (f, aside) = (away.dot(h).max(Real::ZERO), away.cross(h).abs());
    // H-14.15; A-10
    if times.s_b.certainly_at_most(f) {
        return None;
    }
    let t = times.braking_with_a_b(f);
    let bound = Real::new(ASIDE) + Real::new(TURNED) * f + Real::new(HALF_TYRES) * t.squared();
    let witness = || Witness::of(Rule::Reach, [aside.value(), bound.value()]);
    (!aside.certainly_at_most(bound)).then(witness)
}

/// What plain doubles say, from p on: they err by less than 2^-20 m up to 2^26 m, and by less than 1e-12
/// of what is farther.
struct Plain {
    h: [f64; 2],
    times: Times<f64>,
    longest: f64,
}

impl Plain {
    fn new(cycle: &Cycle<'_>) -> Self {
        let times = Times::new(cycle);
        Self { h: [cycle.ego.cos, cycle.ego.sin], times, longest: longest(times.s_stop) }
    }

    /// Whether a length certainly is within the greatest.
    fn is_short(&self, length: f64) -> bool {
        length < self.longest * (1.0 - 1e-9) - 1e-6
    }

    /// Whether the heading certainly is near to that of an arc, and of one that a car can drive, at all that is between two
    /// places: f is greatest at one of them and least at one, the distance least at one or 0.
    fn is_along(&self, ends: [[f64; 2]; 2], heading: [f64; 2]) -> bool {
        let [along, turned] = split(self.h, heading);
        let [[f, aside], [f_to, aside_to]] = ends.map(|place| split(self.h, place));
        let apart = aside * aside_to > 0.0;
        let aside = if apart { smaller(aside.abs(), aside_to.abs()) } else { 0.0 };
        let [least, f] = [smaller(f, f_to), larger(f, f_to)].map(|f| larger(f, 0.0));
        let (error, turned) = (1e-6 + 1e-9 * f, turned.abs() - TURNED);
        along > 1e-6 && f * turned + error < 2.0 * aside + ASIDE && CIRCLE * turned + error < least
    }

    /// Whether what is between two places certainly is: the distance is greatest at one of them, the
    /// bound least where that is nearest.
    fn is_within(&self, from: [f64; 2], to: [f64; 2]) -> bool {
        let [[f, aside], [f_to, aside_to]] = [from, to].map(|place| split(self.h, place));
        let size = larger(f.abs(), f_to.abs()) + larger(aside.abs(), aside_to.abs());
        let error = 1e-6 + 1e-12 * size;
        let f = smaller(f, f_to) - error;
        if f > self.times.s_b * (1.0 + 1e-12) {
            return true;
        }
        let t = if f > 0.0 { self.times.braking_with_a_b(f) } else { 0.0 };
        let bound = ASIDE + TURNED * larger(f, 0.0) + HALF_TYRES * (1.0 - 1e-9) * t * t;
        larger(aside.abs(), aside_to.abs()) + error < bound
    }
}
