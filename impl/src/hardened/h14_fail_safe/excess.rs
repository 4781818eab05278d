//! By how much a point is beyond what the CAV can drive (H-14.64, `spec/hardened/H-14.md#requirements-reach`).

use crate::hardened::h14_fail_safe::times::TYRES;
use crate::input::cycle::{Cycle, TrajectoryPoint};
use crate::numbers::plane::Vector;
use crate::numbers::range::{larger, smaller};
use crate::numbers::rounding::Real;
use crate::stages::distances::Number;
use crate::stages::llcc::sweep::split;
use crate::stages::llcc::{Pose, vector};

/// A car is taken to turn on no smaller circle, m: its radius.
const CIRCLE: f64 = 3.0;
/// Up to this speed tyres hold the CAV on that circle, m/s: its square is below 11.5 * 3.
const SLOW: f64 = 5.8;
/// More than what a few operations in plain doubles err by, relatively.
const ROUGH: f64 = 4e-15;

/// What the CAV can drive from where it is, braking with `a_b`.
#[derive(Clone, Copy, Debug)]
struct Drivable<N> {
    v: N,
    a_b: N,
    /// From the reference point to the farther end of the CAV, m.
    lever: N,
}

impl<N: Number> Drivable<N> {
    fn new(cycle: &Cycle<'_>) -> Self {
        let ego = &cycle.ego;
        let half = N::from_double(0.5 * ego.length);
        let lever = N::from_double(ego.center_offset.abs()).plus(half);
        let [v, a_b] = [ego.speed, cycle.parameters.a_b].map(N::from_double);
        Self { v, a_b, lever }
    }

    /// Of what is f ahead or behind and so far aside, with a heading of that sine; without signs.
    fn excess(&self, f: N, aside: N, sine: N) -> N {
        let radius = self.radius(f);
        let beside = aside.minus(f.times(f).divided_by(radius.plus(radius)));
        let swung = sine.minus(f.divided_by(radius)).times(self.lever);
        beside.or_larger(swung)
    }

    /// R
    fn radius(&self, f: N) -> N {
        //
        let (v, least) = (self.v, N::from_double(CIRCLE));
        if !v.exceeds(N::from_double(SLOW)) {
            return least;
        }
        let slower = v.minus(self.a_b.times(f).divided_by(v));
        let u = slower.or_larger(v.times(N::from_double(0.5)));
        u.times(u).divided_by(N::from_double(TYRES)).or_larger(least)
    }
}

/// The excess of points and places.
#[derive(Clone, Copy, Debug)]
pub(super) struct Excess {
    p: [f64; 2],
    h: [f64; 2],
    exact: Drivable<Real>,
    plain: Drivable<f64>,
}

impl Excess {
    pub(super) fn new(cycle: &Cycle<'_>) -> Self {
        let ego = &cycle.ego;
        let (p, h) = ([ego.x, ego.y], [ego.cos, ego.sin]);
        Self { p, h, exact: Drivable::new(cycle), plain: Drivable::new(cycle) }
    }

    pub(super) fn of_point(&self, point: &TrajectoryPoint) -> Real {
        self.of(Vector::new(point.x, point.y), Real::ZERO)
    }

    pub(super) fn of_place(&self, pose: &Pose) -> Real {
        self.of(pose.at, vector(self.h).cross(vector(pose.heading)).abs())
    }

    fn of(&self, at: Vector, sine: Real) -> Real {
        let (away, h) = (at - vector(self.p), vector(self.h));
        self.exact.excess(away.dot(h).abs(), away.cross(h).abs(), sine)
    }

    /// Not below the excess of any place between two, of which each part is known from p on to one part in 10^15, with
    /// one heading; in plain doubles. Exact 0 for what is straight ahead on an axis.
    pub(super) fn at_most(&self, ends: [[f64; 2]; 2], heading: [f64; 2]) -> f64 {
        let [cos, sin] = self.h;
        let [f, f_to] = ends.map(|it| split(self.h, it)[0]);
        // On the line between them the way aside is greatest at an end, and the way ahead least at one or 0.
        let least = if f * f_to > 0.0 { smaller(f.abs(), f_to.abs()) } else { 0.0 };
        let size = larger(ends[0][0].abs() + ends[0][1].abs(), ends[1][0].abs() + ends[1][1].abs());
        let [aside, aside_to] = ends.map(|[x, y]| product_difference([x, sin], [y, cos]));
        let sine = product_difference([heading[0], sin], [heading[1], cos]);
        let least = larger(least - ROUGH * size, 0.0) * (1.0 - ROUGH);
        self.plain.excess(least, larger(aside, aside_to), sine) * (1.0 + ROUGH)
    }
}

/// Not below abs(a b - c d).
fn product_difference([a, b]: [f64; 2], [c, d]: [f64; 2]) -> f64 {
    let (one, other) = (a * b, c * d);
    (one - other).abs() + ROUGH * (one.abs() + other.abs())
}
