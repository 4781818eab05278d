//! Whether the path is within reach (`spec/hardened/H-14.md#requirements-reach`).

use crate::hardened::h14_fail_safe::path::{Nodes, Path};
use crate::hardened::h14_fail_safe::times::{Times, longest};
use crate::input::cycle::{Cycle, TrajectoryPoint};
use crate::numbers::plane::Vector;
use crate::numbers::range::{larger, smaller};
use crate::numbers::rounding::Real;
use crate::report::{Rule, Witness};
use crate::stages::distances::s_b;
use crate::stages::llcc::sweep::{minus, split};
use crate::stages::llcc::vector;

/// What a trajectory may start aside, m.
const ASIDE: f64 = 0.5;
/// For each m ahead: what it may start turned.
const TURNED: f64 = 0.17;
/// Half of what tyres hold, m/s^2.
const TYRES: f64 = 5.75;

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
    if nodes
        .lines()
        .all(|it| plain.is_within(it.from, it.to) && plain.is_short(it.length + it.more))
    {
        return None;
    }
    let path = Path::new(nodes);
    path.pieces().find_map(|piece| {
        let is_within = |run: [i64; 2]| {
            let [[x, y, _], [to_x, to_y, length]] = piece.between(run, p);
            plain.is_within([x, y], [to_x, to_y]) && plain.is_short(length)
        };
        piece.first_place(is_within, |place| {
            if place.number == 0 {
                return None;
            }
            let found = failure(cycle, &path.times, place.pose.at);
            // H-14.61
            let longest = longest(path.times.s_stop);
            let witness = || Witness::of(Rule::Reach, [place.length, longest].map(Real::value));
            let is_long = || !place.length.certainly_at_most(longest);
            found
                .or_else(|| is_long().then(witness))
                .map(|witness| witness.at_point(place.point(points.len())))
        })
    })
}

fn failure(cycle: &Cycle<'_>, times: &Times<Real>, x: Vector) -> Option<Witness> {
    let ego = &cycle.ego;
    let away = x - Vector::new(ego.x, ego.y);
    let h = vector([ego.cos, ego.sin]);
    let (f, aside) = (away.dot(h).max(Real::ZERO), away.cross(h).abs());
    // H-14.15
    if times.s_b.certainly_at_most(f) {
        return None;
    }
    let bound =
        Real::new(ASIDE) + Real::new(TURNED) * f + Real::new(TYRES) * times.last(f).squared();
    let witness = || Witness::of(Rule::Reach, [aside.value(), bound.value()]);
    (!aside.certainly_at_most(bound)).then(witness)
}

/// What plain doubles say, from p on: they err by less than 2^-20 m up to 2^26 m, and by less than 1e-12
/// of what is farther.
struct Plain {
    h: [f64; 2],
    v: f64,
    s_b: f64,
    longest: f64,
}

impl Plain {
    fn new(cycle: &Cycle<'_>) -> Self {
        let s_b = s_b(&cycle.parameters, cycle.ego.speed);
        let longest = longest(Times::<f64>::new(cycle).s_stop);
        Self { h: [cycle.ego.cos, cycle.ego.sin], v: cycle.ego.speed, s_b, longest }
    }

    /// Whether a length certainly is within the greatest.
    fn is_short(&self, length: f64) -> bool {
        length < self.longest * (1.0 - 1e-9) - 1e-6
    }

    /// Whether what is between two places certainly is: the distance is greatest at one of them, the
    /// bound least where that is nearest. To be at f takes at least f / v.
    fn is_within(&self, from: [f64; 2], to: [f64; 2]) -> bool {
        let [[f, aside], [f_to, aside_to]] = [from, to].map(|place| split(self.h, place));
        let size = larger(f.abs(), f_to.abs()) + larger(aside.abs(), aside_to.abs());
        let error = 1e-6 + 1e-12 * size;
        let f = smaller(f, f_to) - error;
        if f > self.s_b * (1.0 + 1e-12) {
            return true;
        }
        let t = if f > 0.0 { f / self.v } else { 0.0 };
        let bound = ASIDE + TURNED * larger(f, 0.0) + TYRES * (1.0 - 1e-9) * t * t;
        larger(aside.abs(), aside_to.abs()) + error < bound
    }
}
