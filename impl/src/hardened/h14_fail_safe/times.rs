//! When the CAV is where (H-14.10, `spec/hardened/H-14.md#requirements-windows`), in numbers with error
//! bounds or in plain doubles.

use crate::input::cycle::Cycle;
use crate::input::parameters::Parameters;
use crate::numbers::range::larger;
use crate::numbers::rounding::Real;
use crate::stages::distances::{Number, s_b};

/// What tyres hold, m/s^2.
pub(super) const TYRES: f64 = 11.5;

/// What the CAV can do from now on; m, s, m/s.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Times<N> {
    v: N,
    a_b: N,
    a_tyre: N,
    a_max: N,
    tau: N,
    pub(crate) v_tau: N,
    pub(crate) s_tau: N,
    /// `s_stop`
    pub(crate) s_stop: N,
    /// T
    pub(crate) until_stop: N,
    /// `s_tyre(v)`: from here on the CAV may stand.
    pub(crate) s_tyre: N,
    /// What plain doubles err in the square of a speed.
    rough: N,
}

impl<N: Number> Times<N> {
    pub(crate) fn new(cycle: &Cycle<'_>) -> Self {
        let parameters = &cycle.parameters;
        //
        let [v, a_b, a_max, tau] =
            [cycle.ego.speed, parameters.a_b, parameters.a_max, parameters.tau].map(N::from_double);
        let half = N::from_double(0.5);
        let v_tau = v.plus(a_max.times(tau));
        let s_tau = v.times(tau).plus(a_max.times(tau.times(tau)).times(half));
        Self {
            v,
            a_b,
            a_tyre: N::from_double(a_tyre(parameters)),
            a_max,
            tau,
            v_tau,
            s_tau,
            s_stop: s_tau.plus(s_b(parameters, v_tau)),
            until_stop: tau.plus(v_tau.divided_by(a_b)),
            s_tyre: s_tyre(parameters, v),
            rough: N::from_double(N::ROUGH).times(v_tau.times(v_tau)),
        }
    }

    /// The earliest time at f, or less: where it is open which of the two formulas holds, the one
    /// for less is below the other one. In plain doubles up to 1e-9 s more.
    pub(crate) fn first(&self, f: N) -> N {
        let zero = N::from_double(0.0);
        if f.exceeds(self.s_tau) {
            let braked = double(self.a_b).times(f.minus(self.s_tau));
            let squared = self.v_tau.times(self.v_tau).minus(braked).plus(self.rough);
            let left = squared.or_larger(zero).root();
            return self.tau.plus(self.v_tau.minus(left).divided_by(self.a_b));
        }
        let gained = double(self.a_max).times(f);
        let squared = self.v.times(self.v).plus(gained).minus(self.rough);
        squared.or_larger(zero).root().minus(self.v).divided_by(self.a_max)
    }

    /// The latest time at f < `s_tyre(v)`. In plain doubles up to 1e-9 s less.
    pub(crate) fn last(&self, f: N) -> N {
        let braked = double(self.a_tyre).times(f);
        let squared = self.v.times(self.v).minus(braked).minus(self.rough);
        let left = squared.or_larger(N::from_double(0.0)).root();
        self.v.minus(left).divided_by(self.a_tyre)
    }
}

impl Times<Real> {
    /// `first` in plain doubles, of all that f may be. They err by less than 1e-15 of T, and by the root of
    /// what f errs by.
    pub(super) fn plainly_first(&self, f: Real) -> f64 {
        /// m; takes less than 1e-29 s, and twice `a_max` times more does not underflow.
        const NOTHING: f64 = 1e-60;
        let ([v, a_max], [way, _]) = ([self.v, self.a_max].map(Real::value), ends(f));
        if way > self.s_tau.value() {
            let [_, left] = ends(self.s_stop - f);
            self.until_stop.value() - plainly_stops(left, self.a_b)
        } else if way > NOTHING {
            way / (0.5 * (libm::sqrt(v * v + 2.0 * a_max * way) + v))
        } else {
            0.0
        }
    }

    /// `last` in plain doubles, as exactly.
    pub(super) fn plainly_last(&self, f: Real) -> f64 {
        let [left, _] = ends(self.s_tyre - f);
        self.v.value() / self.a_tyre.value() - plainly_stops(left, self.a_tyre)
    }
}

/// How long braking with `a` to a stop takes on so many m, s.
fn plainly_stops(way: f64, a: Real) -> f64 {
    libm::sqrt(2.0 * larger(way, 0.0) / a.value())
}

/// `a_tyre` = max(`a_b`, 11.5 m/s^2): no vehicle brakes harder (H-14.10). One of the two, not rounded.
pub(crate) fn a_tyre(parameters: &Parameters) -> f64 {
    // A-09; A-10
    larger(parameters.a_b, TYRES)
}

/// `s_tyre(v)` = v^2 / (2 `a_tyre`), m.
pub(crate) fn s_tyre<N: Number>(parameters: &Parameters, v: N) -> N {
    // H-14.10
    v.times(v).divided_by(N::from_double(2.0 * a_tyre(parameters)))
}

/// The least and the greatest that a number may be, each rounded once.
fn ends(number: Real) -> [f64; 2] {
    [number.value() - number.off(), number.value() + number.off()]
}

/// No path within reach is longer, m (H-14.60, H-14.61).
pub(crate) fn longest<N: Number>(s_stop: N) -> N {
    double(s_stop).plus(N::from_double(1.0))
}

fn double<N: Number>(number: N) -> N {
    number.plus(number)
}
