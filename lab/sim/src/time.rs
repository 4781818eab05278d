//! Times, ns, in seconds.

/// A time, ns, in seconds.
#[allow(clippy::cast_precision_loss, reason = "differences of stamps, far below 2^53")]
pub fn seconds(ns: i64) -> f64 {
    ns as f64 / 1e9
}
