//! As far as the CAV needs to stop: the gap to the leading vehicle where stage iv did not run, and more
//! places for stage v (H-04 of `spec/hardened/H-04.md`).

pub(crate) mod places;

use crate::hardened::h14_fail_safe::times::{Times, s_tyre};
use crate::input::cycle::{Cycle, Lead};
use crate::numbers::rounding::Real;

/// `s_react` = max(`s_stop` - `s_tyre(v_lead)`, 0), m: what the CAV needs more than a leader that
/// brakes as hard as tyres hold, to stop (H-04.2).
pub(crate) fn s_react(cycle: &Cycle<'_>, lead: &Lead) -> Real {
    let s_stop = Times::<Real>::new(cycle).s_stop;
    //
    (s_stop - s_tyre(&cycle.parameters, Real::new(lead.speed))).max(Real::ZERO)
}
