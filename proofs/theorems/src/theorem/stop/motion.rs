//! What the CAV and a lead may do in a motion, the stop invariant, and the lemmas: no motion breaks it.

use crate::claim::{Theorem, Wrong};
use crate::hardened::h14_fail_safe::times::{Driving, a_tyre};
use crate::numbers::real::Real;
use crate::numbers::real::formula::{
    Formula, at_most, equal, forget_of_what_products_are, given, implies, less,
};
use crate::stages::distances::s_b;
use crate::theorem::h04_gap::gone_farther;
use crate::theorem::h14_fail_safe::times::{Cav, driven};

/// Of all numbers.
pub const DOMAIN: &str = "all times, speeds, tau >= 0, a_max, a_b > 0";

/// The lemmas of the system.
pub const THEOREMS: &[Theorem] = &[
    Theorem {
        id: "going_on_until_brake_by_never_moves_the_stopping_place_of_the_CAV_ahead",
        statement: "A-08, A-10: left being the time until brake_by, after any motion for dt <= left with at most a_max, way + \
                    s_stop(speed after it, left - dt) <= s_stop(v, left), and s_stop >= 0",
        domain: DOMAIN,
        claim: || {
            let limits = Limits::any();
            let [v, left, dt] = ["v", "left", "dt"].map(at_least_zero);
            limits.keeps(&v, &left, &Motion::any(&dt), Duty::GoesOn)
        },
        wrong: Wrong {
            statement: "for any dt, left being 0 from brake_by on",
            claim: || {
                let limits = Limits::any();
                let [v, left, dt] = ["v", "left", "dt"].map(at_least_zero);
                let motion = Motion::any(&dt);
                given(limits.is_possible(&v, &motion));
                let rest = (&left - &dt).max(Real::zero());
                limits.is_no_farther(&v, &left, &motion, &rest)
            },
        },
    },
    Theorem {
        id: "braking_from_brake_by_on_never_moves_the_stopping_place_of_the_CAV_ahead",
        statement: "A-07, A-08: after any motion with at least a_b, or standing, way + s_b(speed after it) <= s_b(v)",
        domain: DOMAIN,
        claim: || {
            let limits = Limits::any();
            let [v, left, dt] = ["v", "left", "dt"].map(at_least_zero);
            limits.keeps(&v, &left, &Motion::any(&dt), Duty::Brakes)
        },
        wrong: Wrong {
            statement: "after one with at most a_max",
            claim: || {
                let limits = Limits::any();
                let [v, dt] = ["v", "dt"].map(at_least_zero);
                let motion = Motion::any(&dt);
                given(limits.is_possible(&v, &motion));
                limits.is_no_farther(&v, &Real::zero(), &motion, &Real::zero())
            },
        },
    },
    Theorem {
        id: "the_stopping_place_of_a_lead_never_moves_back",
        statement: "A-09: after any motion of a lead with at most a_tyre, way + s_tyre(speed after it) >= s_tyre(w)",
        domain: DOMAIN,
        claim: || lead_stops(1),
        wrong: Wrong { statement: "with at most 2 a_tyre", claim: || lead_stops(2) },
    },
    Theorem {
        id: "a_lead_is_not_reached_within_a_motion_that_keeps_the_stop_invariant",
        statement: "F-04: if the invariant holds, no motion that goes on until brake_by, and none that brakes from then on, reaches a lead \
                    that brakes with at most a_tyre",
        domain: DOMAIN,
        claim: || lead_is_not_reached(&[Duty::GoesOn, Duty::Brakes], &Real::zero()),
        wrong: Wrong {
            statement: "braking it comes no nearer than 1 cm",
            claim: || lead_is_not_reached(&[Duty::Brakes], &Real::ratio(1, 100)),
        },
    },
];

/// tau, a_max and a_b.
#[derive(Clone, Debug)]
pub struct Limits {
    /// s.
    pub tau: Real,
    /// m/s^2.
    pub a_max: Real,
    /// m/s^2.
    pub a_b: Real,
}

/// A motion for the time dt, of any shape: the way, and the speed after it.
#[derive(Clone, Debug)]
pub struct Motion {
    /// s.
    pub dt: Real,
    /// m.
    pub way: Real,
    /// m/s.
    pub speed: Real,
}

/// What a cycle examined, as it is now.
#[derive(Clone, Debug)]
pub struct Examined {
    /// Time left until tau after the cycle, s: until `brake_by`.
    pub left: Real,
    /// Free way up to what is ahead, m.
    pub gap: Real,
    /// Speed of what is ahead, m/s; the constant 0 of what stands.
    pub w: Real,
}

/// What is ahead.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ahead {
    /// Something that stands.
    Standing,
    /// A lead that brakes with at most a_tyre.
    Lead,
}

/// What a motion is to control.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Duty {
    /// It goes on up to `brake_by`.
    GoesOn,
    /// It brakes from then on.
    Brakes,
}

/// A number >= 0.
pub fn at_least_zero(name: &str) -> Real {
    let number = Real::variable(name);
    given(at_most(&Real::zero(), &number));
    number
}

impl Limits {
    /// All that are in the domain.
    pub fn any() -> Self {
        let [a_max, a_b] = ["a_max", "a_b"].map(|name| {
            let number = Real::variable(name);
            given(less(&Real::zero(), &number));
            number
        });
        Self { tau: at_least_zero("tau"), a_max, a_b }
    }

    fn s_stop(&self, v: &Real, left: &Real) -> Real {
        Driving { v, tau: left, a_max: &self.a_max, a_b: &self.a_b }.s_stop()
    }

    /// The invariant: what is ahead is not reached, and would stand beyond the place where the CAV stands that speeds
    /// up until `brake_by` and then brakes. That is gap > s_react with the time left in the place of tau,
    /// and gap > s_stop where w = 0.
    pub fn holds(&self, v: &Real, Examined { left, gap, w }: &Examined) -> Formula {
        Formula::All(vec![
            at_most(&Real::zero(), left),
            less(&Real::zero(), gap),
            less(&self.s_stop(v, left), &(gap + s_b(w, &a_tyre(&self.a_b)))),
        ])
    }

    /// at no time more than a_max.
    pub fn is_possible(&self, v: &Real, Motion { dt, way, speed }: &Motion) -> Formula {
        Formula::All(vec![
            at_most(way, &driven(v, &self.a_max, dt)),
            at_most(speed, &(v + &self.a_max * dt)),
        ])
    }

    /// at each time at least a_b, down to standstill.
    pub fn is_braking(&self, v: &Real, Motion { dt, way, speed }: &Motion) -> Formula {
        let (braked, stopped) = (v - &self.a_b * dt, s_b(v, &self.a_b));
        let goes = vec![at_most(way, &driven(v, &-&self.a_b, dt)), at_most(speed, &braked)];
        let stands = vec![at_most(way, &stopped), at_most(speed, &Real::zero())];
        by_standstill(&braked, goes, stands)
    }

    /// Way + s_stop(speed, rest) <= s_stop(v, left).
    fn is_no_farther(&self, v: &Real, left: &Real, motion: &Motion, rest: &Real) -> Formula {
        at_most(&(&motion.way + self.s_stop(&motion.speed, rest)), &self.s_stop(v, left))
    }

    /// What A-10 asks of a motion that begins this time before `brake_by`.
    fn is_dutiful(&self, v: &Real, left: &Real, motion: &Motion, duty: Duty) -> Formula {
        match duty {
            Duty::GoesOn => {
                Formula::All(vec![self.is_possible(v, motion), at_most(&motion.dt, left)])
            }
            Duty::Brakes => {
                Formula::All(vec![self.is_braking(v, motion), equal(left, &Real::zero())])
            }
        }
    }

    fn keeps(&self, v: &Real, left: &Real, motion: &Motion, duty: Duty) -> Formula {
        let rest = duty.rest(left, &motion.dt);
        let conclusions = vec![
            self.is_no_farther(v, left, motion, &rest),
            at_most(&Real::zero(), &self.s_stop(&motion.speed, &rest)),
        ];
        implies(self.is_dutiful(v, left, motion, duty), Formula::All(conclusions))
    }

    /// at no time more than so many times a_tyre.
    fn is_of_lead(&self, w: &Real, Motion { dt, way, speed }: &Motion, times: i128) -> Formula {
        let a = Real::from_integer(times) * a_tyre(&self.a_b);
        let braked = w - &a * dt;
        let goes = vec![at_most(&driven(w, &-&a, dt), way), at_most(&braked, speed)];
        let stopped = s_b(w, &a);
        by_standstill(&braked, goes, vec![at_most(&stopped, way)])
    }

    fn lead_keeps(&self, w: &Real, motion: &Motion, times: i128) -> Formula {
        let a_tyre = a_tyre(&self.a_b);
        let stops = &motion.way + s_b(&motion.speed, &a_tyre);
        implies(self.is_of_lead(w, motion, times), at_most(&s_b(w, &a_tyre), &stops))
    }

    /// A lead ahead is farther than `least` after a dutiful motion of the CAV.
    fn lead_is_not_reached(
        &self,
        v: &Real,
        examined: &Examined,
        [of_cav, of_lead]: [&Motion; 2],
        duty: Duty,
        least: &Real,
    ) -> Formula {
        let Examined { left, gap, w } = examined;
        let premises = vec![
            self.holds(v, examined),
            self.is_dutiful(v, left, of_cav, duty),
            self.is_of_lead(w, of_lead, 1),
        ];
        let rest = gap + &of_lead.way - &of_cav.way;
        implies(Formula::All(premises), less(least, &rest))
    }
}

impl Duty {
    /// The time left after dt.
    fn rest(self, left: &Real, dt: &Real) -> Real {
        match self {
            Self::GoesOn => left - dt,
            Self::Brakes => left.clone(),
        }
    }
}

/// The one while something brakes, of this speed or less, the other when it stands.
fn by_standstill(braked: &Real, goes: Vec<Formula>, stands: Vec<Formula>) -> Formula {
    Formula::All(vec![
        implies(at_most(&Real::zero(), braked), Formula::All(goes)),
        implies(less(braked, &Real::zero()), Formula::All(stands)),
    ])
}

fn lead_stops(times: i128) -> Formula {
    let limits = Limits::any();
    let [w, dt] = ["w", "dt"].map(at_least_zero);
    limits.lead_keeps(&w, &Motion::any(&dt), times)
}

fn lead_is_not_reached(duties: &[Duty], least: &Real) -> Formula {
    let limits = Limits::any();
    let [v, left, dt] = ["v", "left", "dt"].map(at_least_zero);
    let examined = Examined::any(left, Ahead::Lead);
    let [of_cav, of_lead] = [Motion::any(&dt), Motion::any(&dt)];
    let Limits { a_max, a_b, .. } = limits.clone();
    let duty = duties[one_of(duties.len())];
    if duty == Duty::GoesOn {
        forget_of_what_products_are();
    }
    given(limits.is_dutiful(&v, &examined.left, &of_cav, duty));
    let tau = match duty {
        Duty::GoesOn => examined.left.clone(),
        Duty::Brakes => Real::zero(),
    };
    let cav = Cav { v: v.clone(), tau, a_max, a_b };
    given(gone_farther(&cav, &examined.w, &dt, at_most));
    limits.lead_is_not_reached(&v, &examined, [&of_cav, &of_lead], duty, least)
}

impl Motion {
    /// Any.
    pub fn any(dt: &Real) -> Self {
        let [way, speed] = ["way", "speed"].map(at_least_zero);
        Self { dt: dt.clone(), way, speed }
    }
}

impl Examined {
    /// Any, before the invariant is assumed.
    pub fn any(left: Real, ahead: Ahead) -> Self {
        let w = match ahead {
            Ahead::Standing => Real::zero(),
            Ahead::Lead => at_least_zero("w"),
        };
        Self { left, gap: Real::variable("gap"), w }
    }

    /// After a motion of the CAV, and one of a lead. What the lemmas say of them is assumed.
    pub fn after(&self, limits: &Limits, v: &Real, motion: &Motion, duty: Duty) -> Self {
        let Self { left, gap, w } = self;
        given(limits.keeps(v, left, motion, duty));
        let left = duty.rest(left, &motion.dt);
        if w.polynomial().as_constant().is_some() {
            return Self { left, gap: gap - &motion.way, w: w.clone() };
        }
        let of_lead = Motion::any(&motion.dt);
        given(limits.is_of_lead(w, &of_lead, 1));
        given(limits.lead_keeps(w, &of_lead, 1));
        given(limits.lead_is_not_reached(v, self, [motion, &of_lead], duty, &Real::zero()));
        Self { left, gap: gap + of_lead.way - &motion.way, w: of_lead.speed }
    }
}

/// One of so many, each on a path of its own.
pub fn one_of(count: usize) -> usize {
    let choice = Real::variable("choice");
    let upper = (1..count).zip(1..).find(|(_, bound)| choice < Real::from_integer(*bound));
    upper.map_or(count, |(number, _)| number) - 1
}
