//! The gap to the leading vehicle, compared whether stage iv runs or not (H-04 of
//! `spec/3-stages.md#hardened-profile`).

use crate::input::cycle::{Cycle, Lead, Trajectory};
use crate::input::profile::Profile;
use crate::report::Witness;
use crate::services::configuration::Configuration;
use crate::stages::iv_detections::gap_failure;

/// Why the cycle fails at the place of stage iv, which did not run. `trajectory` and `lead` are the
/// current ones.
pub(crate) fn failure_without_stage_iv(
    cycle: &Cycle<'_>,
    trajectory: Option<&Trajectory<'_>>,
    lead: Option<&Lead>,
) -> Option<Witness> {
    let compared =
        cycle.profile == Profile::Hardened && cycle.configuration != Configuration::Local;
    trajectory.filter(|_| compared).and_then(|_| gap_failure(cycle, lead))
}
