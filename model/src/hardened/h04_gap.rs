//! H-04: where stage iv did not run, the gap to the leading vehicle is compared with what a stop needs.

use crate::hardened::h14_fail_safe::times::Driving;
use crate::input::profile::HardenedRule;
use crate::input::scene::Scene;
use crate::numbers::real::Real;
use crate::report::{Rule, Witness};

/// s_react = max(s_stop - s_tyre(v_lead), 0), m.
pub fn s_react(driving: &Driving, v_lead: &Real) -> Real {
    (driving.s_stop() - driving.s_tyre(v_lead)).max(Real::zero())
}

/// In the place of stage iv when that did not run, with a current trajectory: the gap is <= s_react.
pub fn failure_without_stage_iv(scene: &Scene) -> Option<Witness> {
    let lead = scene.lead.as_ref().filter(|_| scene.profile.has(HardenedRule::H04))?;
    let s_react = s_react(&Driving::of(scene), &lead.speed);
    Witness::unless(scene.reads.greater(&lead.gap, &s_react), Rule::Gap, &lead.gap, &s_react)
}
