//! The transition system of the stop theorem.
//!
//! A run is a sequence of [`STEPS`]. Between two events lies one motion, whose duration is any, so that what is
//! kept by a motion holds at every time within it. That a run is an induction over its steps is not asked of the
//! solver.

use super::motion::{Ahead, Duty, Examined, Limits, Motion, at_least_zero, one_of};
use crate::numbers::real::Real;
use crate::numbers::real::formula::{
    Formula, at_most, equal, forget_of_what_products_are, given, less,
};

/// The CAV, what it follows and what is being decided.
#[derive(Clone, Debug)]
pub struct State {
    /// Its speed, m/s.
    v: Real,
    /// Of the last trajectory that came out (with `supervise_local` also a plan of the CAV's own that passed). None: control
    /// follows a plan that nothing examined, and nothing is claimed.
    followed: Option<Examined>,
    /// Of a cycle that will be safe with a current trajectory, from its measurement to its verdict.
    asked: Option<Examined>,
}

/// The transitions. A cycle that is lost, unsafe or without a current trajectory, and a fallback, are none:
/// control goes on with what it has.
pub const STEPS: [fn(&Limits, State, Ahead) -> State; 5] =
    [goes_on, brakes, measures, passes, own_plan];

impl State {
    /// Any in which the invariant holds.
    fn any(limits: &Limits, ahead: Ahead) -> Self {
        let v = at_least_zero("v");
        let [followed, asked] = [0, 1].map(|_| {
            let examined = Examined::any(Real::variable("left"), ahead);
            (one_of(2) == 1).then(|| {
                given(limits.holds(&v, &examined));
                examined
            })
        });
        Self { v, followed, asked }
    }

    /// After a motion. A verdict that has not come tau after its measurement comes too late.
    fn after(self, limits: &Limits, motion: Motion, duty: Duty) -> Self {
        given(limits.is_possible(&self.v, &motion));
        let v = &self.v;
        let followed = self.followed.map(|it| it.after(limits, v, &motion, duty));
        let asked = self.asked.filter(|asked| motion.dt <= asked.left);
        let asked = asked.map(|it| it.after(limits, v, &motion, Duty::GoesOn));
        Self { v: motion.speed, followed, asked }
    }
}

/// Control goes on for any time up to `brake_by` (A-10, MON-42), in any way that A-08 allows; also braking.
fn goes_on(limits: &Limits, state: State, _: Ahead) -> State {
    let motion = Motion::any(&at_least_zero("dt"));
    if let Some(followed) = &state.followed {
        given(at_most(&motion.dt, &followed.left));
    }
    state.after(limits, motion, Duty::GoesOn)
}

/// From `brake_by` on the CAV brakes, or stands.
fn brakes(limits: &Limits, state: State, _: Ahead) -> State {
    brakes_for(limits, state, &at_least_zero("dt"))
}

fn brakes_for(limits: &Limits, state: State, dt: &Real) -> State {
    let Some(followed) = &state.followed else { return state };
    given(equal(&followed.left, &Real::zero()));
    let motion = Motion::any(dt);
    given(limits.is_braking(&state.v, &motion));
    state.after(limits, motion, Duty::Brakes)
}

/// A cycle that will be safe measures pose and speed.
fn measures(limits: &Limits, state: State, ahead: Ahead) -> State {
    let examined = Examined::any(limits.tau.clone(), ahead);
    given(limits.holds(&state.v, &examined));
    State { asked: Some(examined), ..state }
}

/// Its verdict comes, with a trajectory.
fn passes(_: &Limits, state: State, _: Ahead) -> State {
    match state.asked {
        Some(asked) => State { followed: Some(asked), asked: None, ..state },
        None => state,
    }
}

/// A plan of the CAV's own comes that nothing examines.
fn own_plan(_: &Limits, state: State, _: Ahead) -> State {
    State { followed: None, ..state }
}

/// Whether each transition keeps the invariant, of what is followed and of what will be.
pub fn every_step_keeps(ahead: Ahead) -> Formula {
    forget_of_what_products_are();
    let limits = Limits::any();
    let state = State::any(&limits, ahead);
    let State { v, followed, asked } = STEPS[one_of(STEPS.len())](&limits, state, ahead);
    let examined = [followed, asked].into_iter().nth(one_of(2)).flatten();
    examined.map_or(Formula::Known(true), |examined| limits.holds(&v, &examined))
}

/// What is followed is not reached; and after braking for v / a_b from `brake_by` on the CAV stands and has not reached
/// it.
pub fn stands_before(ahead: Ahead) -> Formula {
    let limits = Limits::any();
    let v = at_least_zero("v");
    let followed = Examined::any(Real::variable("left"), ahead);
    given(limits.holds(&v, &followed));
    let before = less(&Real::zero(), &followed.gap);
    let dt = &v / &limits.a_b;
    let state = State { v, followed: Some(followed), asked: None };
    let after = brakes_for(&limits, state, &dt);
    let gap = after.followed.map(|it| less(&Real::zero(), &it.gap));
    Formula::All([before, equal(&after.v, &Real::zero())].into_iter().chain(gap).collect())
}
