//! When the CAV is where, going on for tau at most and then braking to a stop, with a_b or harder
//! (`spec/hardened/H-14.md#requirements-windows`).

use crate::input::scene::Scene;
use crate::numbers::reading::Comparisons;
use crate::numbers::real::Real;
use crate::stages::distances::s_b;

/// How the CAV goes on and brakes: v in m/s, tau in s, a_max and a_b in m/s^2.
#[derive(Clone, Copy, Debug)]
pub struct Driving<'a> {
    /// v, m/s.
    pub v: &'a Real,
    /// tau, s.
    pub tau: &'a Real,
    /// a_max, m/s^2.
    pub a_max: &'a Real,
    /// a_b, m/s^2.
    pub a_b: &'a Real,
}

impl<'a> Driving<'a> {
    /// That of a cycle.
    pub fn of(scene: &'a Scene) -> Self {
        let p = &scene.parameters;
        Self { v: &scene.ego.v_now, tau: &p.tau, a_max: &p.a_max, a_b: &p.a_b }
    }

    /// v_tau = v + a_max tau, m/s.
    pub fn v_tau(&self) -> Real {
        self.v + self.a_max * self.tau
    }

    /// s_tau = v tau + a_max tau^2 / 2, m.
    pub fn s_tau(&self) -> Real {
        self.v * self.tau + self.a_max * self.tau.square() / two()
    }

    /// s_stop = s_tau + v_tau^2 / (2 a_b), m.
    pub fn s_stop(&self) -> Real {
        self.s_tau() + s_b(&self.v_tau(), self.a_b)
    }

    /// s_b(v), m.
    pub fn s_b(&self) -> Real {
        s_b(self.v, self.a_b)
    }

    /// s_tyre(speed) = speed^2 / (2 a_tyre), m.
    pub fn s_tyre(&self, speed: &Real) -> Real {
        s_b(speed, &a_tyre(self.a_b))
    }

    /// T = tau + v_tau / a_b, s: from then on the CAV surely stands.
    pub fn t_stop(&self) -> Real {
        self.tau + self.v_tau() / self.a_b
    }

    /// The earliest time at which the CAV can have driven f, s: (sqrt(v^2 + 2 a_max f) - v) / a_max up to s_tau, and
    /// tau + (v_tau - sqrt(max(v_tau^2 - 2 a_b (f - s_tau), 0))) / a_b from there on.
    pub fn first(&self, f: &Real) -> Real {
        let (v_tau, s_tau) = (self.v_tau(), self.s_tau());
        if *f <= s_tau {
            return ((self.v.square() + two() * self.a_max * f).sqrt() - self.v) / self.a_max;
        }
        let squared = v_tau.square() - two() * self.a_b * (f - s_tau);
        self.tau + (v_tau - squared.max(Real::zero()).sqrt()) / self.a_b
    }

    /// The latest time at which it has driven no more than f < s_tyre(v), s: (v - sqrt(max(v^2 - 2 a_tyre f, 0))) / a_tyre.
    pub fn last(&self, f: &Real) -> Real {
        let a_tyre = a_tyre(self.a_b);
        let squared = self.v.square() - two() * &a_tyre * f;
        (self.v - squared.max(Real::zero()).sqrt()) / a_tyre
    }
}

/// a_tyre = max(a_b, 11.5 m/s^2): no vehicle brakes harder.
pub fn a_tyre(a_b: &Real) -> Real {
    a_b.clone().max(Real::from_double(11.5))
}

fn two() -> Real {
    Real::from_integer(2)
}

/// When the CAV is examined at a place.
#[derive(Clone, Debug)]
pub struct Window {
    /// first(least progress around the place), s.
    pub begin: Real,
    /// last(length at the place after), s; none where the CAV may stand.
    pub end: Option<Real>,
}

/// The window of a place: from first(least progress around it, at least 0) to last(length at the place after it), or
/// without an end where the CAV may stand there (length >= s_tyre(v)), and at the last place (`None`).
pub fn window(
    reads: &Comparisons,
    driving: &Driving,
    least: &Real,
    length_after: Option<&Real>,
) -> Window {
    let may_stand = |length: &Real| *length >= reads.lowered(&driving.s_tyre(driving.v));
    let after = length_after.filter(|length| !may_stand(length));
    Window { begin: driving.first(least), end: after.map(|length| driving.last(length)) }
}
