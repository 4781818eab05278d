//! Distances that a cycle looks ahead (`spec/3-stages.md#distances`), in numbers with error bounds
//! or in plain doubles.

use crate::input::cycle::{Cycle, Lead};
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
}

/// How far stages iii, iv and v look.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Horizon<'c> {
    /// `s_CAV`
    Cav,
    /// `s_valid`, with the current leading vehicle.
    Valid(Option<&'c Lead>),
    /// `s_b(v_now)`
    Braking,
}

impl Horizon<'_> {
    /// The distance, m.
    pub(crate) fn distance<N: Number>(self, cycle: &Cycle<'_>) -> N {
        let (parameters, v_now) = (&cycle.parameters, cycle.ego.speed);
        match self {
            Self::Cav => s_cav(parameters, v_now),
            Self::Valid(Some(lead)) => s_follow(parameters, v_now, lead.speed),
            Self::Valid(None) | Self::Braking => s_b(parameters, N::from_double(v_now)),
        }
    }
}

/// `s_CAV` = `safety_time` * `v_now`, m.
fn s_cav<N: Number>(parameters: &Parameters, v_now: f64) -> N {
    N::from_double(parameters.safety_time).times(N::from_double(v_now))
}

/// `s_b(v)` = v^2 / (2 `a_b`), m.
pub(crate) fn s_b<N: Number>(parameters: &Parameters, v: N) -> N {
    v.times(v).divided_by(N::from_double(2.0 * parameters.a_b))
}

/// `s_follow` = max(`s_b(v_now)` - `s_b(v_lead)`, 0) + `s_CAV`, m.
pub(crate) fn s_follow<N: Number>(parameters: &Parameters, v_now: f64, v_lead: f64) -> N {
    let [now, lead] = [v_now, v_lead].map(|v| s_b(parameters, N::from_double(v)));
    now.minus(lead).or_larger(N::from_double(0.0)).plus(s_cav(parameters, v_now))
}

/// H-04: `s_stop` = e + v tau + `a_max` tau^2/2 + (v + `a_max` tau)^2/(2 `a_b`), m; `e` is how far
/// the CAV is from the first point.
pub(crate) fn s_stop<N: Number>(cycle: &Cycle<'_>, e: N) -> N {
    let Parameters { tau, a_max, .. } = cycle.parameters;
    let [v, tau, a_max, half] = [cycle.ego.speed, tau, a_max, 0.5].map(N::from_double);
    let reaction = v.times(tau).plus(a_max.times(tau.times(tau)).times(half));
    e.plus(reaction).plus(s_b(&cycle.parameters, v.plus(a_max.times(tau))))
}
