//! As far as the CAV needs to stop: the gap to the leading vehicle where stage iv did not run, and more
//! places for stage v (H-04 of `spec/hardened/H-04.md`).

pub(crate) mod places;

use crate::hardened::h14_fail_safe::times::{Times, a_tyre, s_tyre};
use crate::input::cycle::{Cycle, Lead};
use crate::numbers::rounding::Real;
use crate::numbers::time::elapsed_ns;

/// `s_react` = max(`s_stop` - `s_tyre(v_lead)`, 0), m: what the CAV needs more than a leader that
/// brakes as hard as tyres hold, to stop (H-04.2).
pub(crate) fn s_react(cycle: &Cycle<'_>, lead: &Lead) -> Real {
    let s_stop = Times::<Real>::new(cycle).s_stop;
    //
    (s_stop - s_tyre(&cycle.parameters, Real::new(lead.speed))).max(Real::ZERO)
}

/// `s_since` = v age + `a_tyre` age^2/2, m: the greatest way that the CAV has driven since the gap to a
/// current lead was measured (H-04.2).
pub(crate) fn s_since(cycle: &Cycle<'_>, lead: &Lead) -> Real {
    let age = Real::seconds(elapsed_ns(lead.stamp_ns, cycle.now_ns));
    //
    let braked = Real::new(0.5 * a_tyre(&cycle.parameters)) * age;
    (Real::new(cycle.ego.speed) + braked) * age
}
