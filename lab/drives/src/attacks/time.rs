//! Times of a drive.

/// Nanoseconds in s.
#[expect(clippy::cast_precision_loss, reason = "drives last minutes")]
pub(super) fn seconds(ns: i64) -> f64 {
    ns as f64 / 1e9
}
