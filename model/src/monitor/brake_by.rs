//! By when control has to brake along the last verified trajectory (`spec/monitor.md`, when to brake).

use crate::input::parameters::Parameters;
use crate::input::profile::{HardenedRule, Profile};
use crate::numbers::real::Real;

/// The time of the cycle plus tau: the double nearest to tau times 10^9, rounded down to ns; saturates.
/// None without H-14. [MON-40] [MON-41]
pub fn brake_by_ns(profile: Profile, parameters: &Parameters, now_ns: i64) -> Option<i64> {
    let tau = Real::from_double(parameters.tau) * Real::from_integer(1_000_000_000);
    let tau_ns = Real::from_double(tau.to_f64()).floor();
    profile.has(HardenedRule::H14).then(|| now_ns.saturating_add(tau_ns))
}
