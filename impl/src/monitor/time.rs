//! Points in time (`spec/monitor.md#monitor`).

use core::fmt;
use core::time::Duration;

/// A point in time on the CAV's one monotonic clock. Where the clock starts does not matter; it must
/// be the same for all that reaches one monitor, stamps of the remote included: they are converted to
/// it before (by a synchronised clock, as the paper does). A bare number is not a time, so that nobody
/// passes microseconds for nanoseconds:
///
/// ```compile_fail,E0308
/// let now: mufasa::monitor::Time = 5_000_000_i64;
/// ```
///
/// Source: `spec/monitor.md#monitor`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Time {
    ns: i64,
}

/// A time that does not fit into 64 bits of nanoseconds, or is no number. Source:
/// `spec/monitor.md#monitor`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct TimeError {
    /// The unit in which it was given.
    pub unit: &'static str,
}

impl fmt::Display for TimeError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "the time in {} is no number, or beyond 2^63 ns (292 years); ", self.unit)?;
        f.write_str("give a time on the CAV's monotonic clock")
    }
}

impl core::error::Error for TimeError {}

impl Time {
    /// So many nanoseconds after the clock's start. Source: `spec/monitor.md#monitor`.
    pub const fn from_nanoseconds(ns: i64) -> Self {
        Self { ns }
    }

    /// So many microseconds after the clock's start.
    ///
    /// Errors: beyond 64 bits of nanoseconds. Source: `spec/monitor.md#monitor`.
    pub const fn from_microseconds(us: i64) -> Result<Self, TimeError> {
        match us.checked_mul(1_000) {
            Some(ns) => Ok(Self { ns }),
            None => Err(TimeError { unit: "microseconds" }),
        }
    }

    /// So many milliseconds after the clock's start.
    ///
    /// Errors: beyond 64 bits of nanoseconds. Source: `spec/monitor.md#monitor`.
    pub const fn from_milliseconds(ms: i64) -> Result<Self, TimeError> {
        match ms.checked_mul(1_000_000) {
            Some(ns) => Ok(Self { ns }),
            None => Err(TimeError { unit: "milliseconds" }),
        }
    }

    /// So many seconds after the clock's start, to about the nearest nanosecond; doubles are coarser
    /// than that from 2^53 ns (104 days) on.
    ///
    /// Errors: NaN, infinite, or beyond 64 bits of nanoseconds. Source:
    /// `spec/monitor.md#monitor`.
    pub fn from_seconds(seconds: f64) -> Result<Self, TimeError> {
        const BEYOND: f64 = 9_223_372_036_854_775_808.0;
        let ns = libm::floor(seconds * 1e9 + 0.5);
        if (-BEYOND..BEYOND).contains(&ns) {
            #[allow(clippy::cast_possible_truncation, reason = "a whole number within 64 bits")]
            let ns = ns as i64;
            return Ok(Self { ns });
        }
        Err(TimeError { unit: "seconds" })
    }

    /// Nanoseconds after the clock's start. Source: `spec/monitor.md#monitor`.
    pub const fn as_nanoseconds(self) -> i64 {
        self.ns
    }

    /// The time so much later; `None` beyond 64 bits of nanoseconds. Source:
    /// `spec/monitor.md#monitor`.
    pub fn checked_add(self, span: Duration) -> Option<Self> {
        let span_ns = i64::try_from(span.as_nanos()).ok()?;
        self.ns.checked_add(span_ns).map(Self::from_nanoseconds)
    }
}

#[cfg(test)]
mod tests {
    use core::time::Duration;

    use super::{Time, TimeError};

    #[test]
    fn every_unit_is_the_same_time() {
        let time = Time::from_nanoseconds(5_000_000_000);
        assert_eq!(Time::from_microseconds(5_000_000), Ok(time));
        assert_eq!(Time::from_milliseconds(5_000), Ok(time));
        assert_eq!(Time::from_seconds(5.0), Ok(time));
        assert_eq!(Time::from_seconds(-1e-9), Ok(Time::from_nanoseconds(-1)));
        assert_eq!(Time::from_seconds(0.1).map(Time::as_nanoseconds), Ok(100_000_000));
    }

    #[test]
    fn what_does_not_fit_is_an_error() {
        let largest = i64::MAX / 1_000;
        assert!(Time::from_microseconds(largest).is_ok());
        assert_eq!(Time::from_microseconds(largest + 1), Err(TimeError { unit: "microseconds" }));
        assert_eq!(Time::from_milliseconds(i64::MIN), Err(TimeError { unit: "milliseconds" }));
        for seconds in [f64::NAN, f64::INFINITY, -f64::INFINITY, 9.3e9, -9.3e9] {
            assert_eq!(Time::from_seconds(seconds), Err(TimeError { unit: "seconds" }));
        }
        let last = Time::from_nanoseconds(i64::MAX);
        assert_eq!(last.checked_add(Duration::from_nanos(1)), None);
        let one = Time::from_nanoseconds(1);
        assert_eq!(one.checked_add(Duration::from_nanos(1)), Some(Time::from_nanoseconds(2)));
        assert_eq!(one.checked_add(Duration::MAX), None);
    }
}
