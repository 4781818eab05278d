//! Distances that a cycle looks ahead (DIST-01, `spec/3-stages.md#distances`), in numbers with
//! error bounds or in plain doubles.

use crate::input::parameters::Parameters;
use crate::numbers::range::larger;
use crate::numbers::rounding::Real;

/// The two kinds of numbers; neither has arithmetic that overflows to a panic.
pub(crate) trait Number: Copy {
    fn from_double(value: f64) -> Self;
    fn plus(self, other: Self) -> Self;
    fn minus(self, other: Self) -> Self;
    fn times(self, other: Self) -> Self;
    fn divided_by(self, other: Self) -> Self;
    fn or_larger(self, other: Self) -> Self;
    /// The square root of a number >= 0.
    fn root(self) -> Self;
    /// Whether it is certainly above the other one; of plain doubles, whether they are.
    fn exceeds(self, other: Self) -> bool;
    /// A few operations err by less than this of the largest number, but where `Real` says by what.
    const ROUGH: f64;
}

impl Number for Real {
    fn from_double(value: f64) -> Self {
        Self::new(value)
    }

    fn plus(self, other: Self) -> Self {
        self + other
    }

    fn minus(self, other: Self) -> Self {
        self - other
    }

    fn times(self, other: Self) -> Self {
        self * other
    }

    fn divided_by(self, other: Self) -> Self {
        self.over(other)
    }

    fn or_larger(self, other: Self) -> Self {
        self.max(other)
    }

    fn root(self) -> Self {
        self.sqrt()
    }

    fn exceeds(self, other: Self) -> bool {
        other.certainly_below(self)
    }

    const ROUGH: f64 = 0.0;
}

impl Number for f64 {
    fn from_double(value: f64) -> Self {
        value
    }

    fn plus(self, other: Self) -> Self {
        self + other
    }

    fn minus(self, other: Self) -> Self {
        self - other
    }

    fn times(self, other: Self) -> Self {
        self * other
    }

    fn divided_by(self, other: Self) -> Self {
        self / other
    }

    fn or_larger(self, other: Self) -> Self {
        larger(self, other)
    }

    fn root(self) -> Self {
        libm::sqrt(self)
    }

    fn exceeds(self, other: Self) -> bool {
        self > other
    }

    const ROUGH: f64 = 1e-14;
}

/// `s_CAV` = `safety_time` * `v_now`, m.
pub(crate) fn s_cav<N: Number>(parameters: &Parameters, v_now: f64) -> N {
    N::from_double(parameters.safety_time).times(N::from_double(v_now))
}

/// `s_b(v)` = v^2 / (2 `a_b`), m.
pub(crate) fn s_b<N: Number>(parameters: &Parameters, v: N) -> N {
    //
    v.times(v).divided_by(N::from_double(2.0 * parameters.a_b))
}

/// `s_follow` = max(`s_b(v_now)` - `s_b(v_lead)`, 0) + `s_CAV`, m.
pub(crate) fn s_follow<N: Number>(parameters: &Parameters, v_now: f64, v_lead: f64) -> N {
    //
    let ways = [v_now, v_lead].map(|v| s_b(parameters, N::from_double(v)));
    follow(ways, s_cav(parameters, v_now))
}

/// The same of `s_b(v_now)`, `s_b(v_lead)` and `s_CAV`, m.
pub(crate) fn follow<N: Number>([now, lead]: [N; 2], s_cav: N) -> N {
    now.minus(lead).or_larger(N::from_double(0.0)).plus(s_cav)
}

/// `s_valid` = `s_follow` behind a leading vehicle, else `s_b(v_now)`, m.
pub(crate) fn s_valid<N: Number>(parameters: &Parameters, v_now: f64, v_lead: Option<f64>) -> N {
    match v_lead {
        Some(v_lead) => s_follow(parameters, v_now, v_lead),
        None => s_b(parameters, N::from_double(v_now)),
    }
}
