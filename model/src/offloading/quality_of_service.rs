//! Quality of service of a remote group (`spec/2-offloading.md#quality-of-service`).
//!
//! Times are ns on the CAV's clock; differences are exact, hence 128 bits.

use crate::offloading::requester::parameters::Parameters;

/// l = arrival time - generation time, ns. `spec/2-offloading.md#quality-of-service`.
pub fn latency_ns(arrival_ns: i64, generated_ns: i64) -> i128 {
    i128::from(arrival_ns) - i128::from(generated_ns)
}

/// dt = arrival time - time of the previous arrival, or of the activation, ns.
/// `spec/2-offloading.md#quality-of-service`.
pub fn inter_arrival_ns(arrival_ns: i64, previous_ns: i64) -> i128 {
    i128::from(arrival_ns) - i128::from(previous_ns)
}

/// Whether an element that arrives is a violation: l > `l_max`, dt > `dt_max`, or generated later
/// than it arrives. `spec/2-offloading.md#quality-of-service`.
pub fn is_violation(
    parameters: &Parameters,
    arrival_ns: i64,
    previous_ns: i64,
    generated_ns: i64,
) -> bool {
    let l = latency_ns(arrival_ns, generated_ns);
    let dt = inter_arrival_ns(arrival_ns, previous_ns);
    l > i128::from(parameters.l_max_ns) || dt > i128::from(parameters.dt_max_ns) || l < 0
}

/// Whether the time without an arrival is a violation: longer than `dt_max`.
/// `spec/2-offloading.md#quality-of-service`.
pub fn is_silent(parameters: &Parameters, now_ns: i64, previous_ns: i64) -> bool {
    inter_arrival_ns(now_ns, previous_ns) > i128::from(parameters.dt_max_ns)
}

/// Whether an element is in order: generated later than the last one used since the activation.
/// `spec/2-offloading.md#quality-of-service`.
pub fn is_in_order(generated_ns: i64, last_used_generated_ns: Option<i64>) -> bool {
    last_used_generated_ns.is_none_or(|last| generated_ns > last)
}
