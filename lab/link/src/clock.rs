//! The clock that vehicle and station share (`docs/link.md`).

use std::time::{Instant, SystemTime, SystemTimeError};

/// The monotonic clock of this computer, in nanoseconds since 1970: its distance to the system's time
/// is taken once, when it is made, so that it never runs backwards, nor jumps when the system's time is
/// set. Two computers whose system times agree when they make theirs share it.
#[derive(Clone, Copy, Debug)]
pub struct SharedClock {
    origin: Instant,
    origin_ns: i64,
}

impl SharedClock {
    /// From now on. Errors: the system's time is before 1970.
    pub fn new() -> Result<Self, SystemTimeError> {
        let since = SystemTime::now().duration_since(SystemTime::UNIX_EPOCH)?;
        Ok(Self { origin: Instant::now(), origin_ns: nanoseconds(since.as_nanos()) })
    }

    /// Nanoseconds since 1970; saturates in the year 2262.
    pub fn now_ns(&self) -> i64 {
        self.origin_ns.saturating_add(nanoseconds(self.origin.elapsed().as_nanos()))
    }
}

fn nanoseconds(ns: u128) -> i64 {
    i64::try_from(ns).unwrap_or(i64::MAX)
}
