//! Settings that no road vehicle has, unless they are meant (`spec/4-arithmetic.md#usual-settings`).

use core::fmt;
use core::time::Duration;

use crate::input::parameters::Parameters;
use crate::offloading::requester;

/// A setting outside of its usual range. Times are in the unit of their field, the period in s. Source:
/// `spec/4-arithmetic.md#usual-settings`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Unusual {
    /// The setting.
    pub field: &'static str,
    /// What was given.
    pub value: f64,
    /// The least that is usual.
    pub least: f64,
    /// The most that is usual.
    pub most: f64,
}

impl fmt::Display for Unusual {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { field, value, least, most } = self;
        // IMPL-15
        write!(
            f,
            "settings.{field} = {value} is not from {least} to {most}, as road vehicles have it; "
        )?;
        if *field == "stages.tau" {
            f.write_str("does it last until full braking, after the next cycle and the first plan of local services? ")?;
        }
        f.write_str("Is it in another unit? Where it is meant, name it in Settings::meaning")
    }
}

/// Each setting with its usual range. `least_tau`: what the profile asks for at this period, s. The places are those of
/// `meant`.
#[allow(clippy::cast_precision_loss, reason = "compared with powers of ten")]
pub(super) fn rows(
    stages: &Parameters,
    requester: &requester::Parameters,
    period: Duration,
    step_ps: u64,
    least_tau: f64,
) -> [Unusual; 24] {
    // IMPL-14
    const MS: f64 = 1e6;
    const S: f64 = 1e9;
    let row = |field, value, [least, most]: [f64; 2]| Unusual { field, value, least, most };
    [
        row("stages.theta_tr", stages.theta_tr, [0.01, 2.0]),
        row("stages.theta_map", stages.theta_map, [0.01, 2.0]),
        row("stages.theta_obj", stages.theta_obj, [2.0, 100.0]),
        row("stages.a_b", stages.a_b, [1.0, 12.0]),
        row("stages.safety_time", stages.safety_time, [0.5, 10.0]),
        row("stages.max_age_ns", stages.max_age_ns as f64, [MS, S]),
        row("stages.theta_track_max", stages.theta_track_max, [0.1, 3.0]),
        row("stages.miss_budget", stages.miss_budget as f64, [0.0, 16.0]),
        row("stages.tau", stages.tau, [least_tau.max(0.01), 5.0]),
        row("stages.a_max", stages.a_max, [0.5, 12.0]),
        row("stages.start_tolerance", stages.start_tolerance, [0.1, 10.0]),
        row("stages.v_max", stages.v_max, [5.0, 150.0]),
        row("stages.step_max_ns", stages.step_max_ns as f64, [10.0 * MS, S]),
        row("stages.theta_velocity", stages.theta_velocity, [0.1, 10.0]),
        row("stages.lateral_tolerance", stages.lateral_tolerance, [0.05, 2.0]),
        row("stages.v_object", stages.v_object, [10.0, 150.0]),
        row("stages.t_yield", stages.t_yield, [0.5, 10.0]),
        row("stages.a_yield", stages.a_yield, [0.5, 8.0]),
        row("requester.t_wait_ns", requester.t_wait_ns as f64, [S, 3600.0 * S]),
        row("requester.request_timeout_ns", requester.request_timeout_ns as f64, [MS, 60.0 * S]),
        row("requester.l_max_ns", requester.l_max_ns as f64, [MS, S]),
        row("period", period.as_secs_f64(), [0.001, 1.0]),
        row("step_ps", step_ps as f64, [50.0, f64::INFINITY]),
        row("requester.dt_max_ns", requester.dt_max_ns as f64, [MS, 5.0 * S]),
    ]
}

/// 1, 2, 4, and so on.
pub(super) fn bits() -> impl Iterator<Item = u32> {
    (0..u32::BITS).map(|place| 1_u32.wrapping_shl(place))
}

/// NaN is.
pub(super) fn is_unusual(row: &Unusual) -> bool {
    !(row.least..=row.most).contains(&row.value)
}
