//! H-04: where stage iv did not run, the gap to the leading vehicle is compared with what a stop needs.

use crate::hardened::h14_fail_safe::times::{Driving, a_tyre};
use crate::input::profile::HardenedRule;
use crate::input::scene::Scene;
use crate::numbers::real::Real;
use crate::report::{Rule, Witness};

/// s_react = max(s_stop - s_tyre(v_lead), 0), m.
pub fn s_react(driving: &Driving, v_lead: &Real) -> Real {
    (driving.s_stop() - driving.s_tyre(v_lead)).max(Real::zero())
}

/// s_since = v age + a_tyre age^2 / 2, m: what the CAV has driven at most since the gap was measured.
pub fn s_since(driving: &Driving, age: &Real) -> Real {
    driving.v * age + a_tyre(driving.a_b) * age.square() / Real::from_integer(2)
}

/// In the place of stage iv when that did not run, with a current trajectory: the gap is <= s_react + s_since.
pub fn failure_without_stage_iv(scene: &Scene) -> Option<Witness> {
    let lead = scene.lead.as_ref().filter(|_| scene.profile.has(HardenedRule::H04))?;
    let driving = Driving::of(scene);
    let least = s_react(&driving, &lead.speed) + s_since(&driving, &lead.age);
    Witness::unless(scene.reads.greater(&lead.gap, &least), Rule::Gap, &lead.gap, &least)
}
