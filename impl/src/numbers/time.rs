//! Times in nanoseconds, and in seconds as plain doubles.

use crate::numbers::rounding::Real;

/// `later - earlier` in ns; saturates only far beyond every limit that it is compared with.
pub(crate) fn elapsed_ns(earlier_ns: i64, later_ns: i64) -> i64 {
    later_ns.saturating_sub(earlier_ns)
}

/// A time in s, with two roundings; times that are compared are below 2^38 ns.
pub(crate) fn seconds(time_ns: i64) -> f64 {
    Real::integer(time_ns).value() * 1e-9
}
