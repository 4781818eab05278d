//! Times and gaps. A bare number is neither: the header gives the time a first member that no number becomes.

use mufasa::monitor::Time;

use crate::memory::put;
use crate::status::MufasaStatus;

/// A point in time on the CAV's one monotonic clock, that of the remote's stamps after conversion, too. A type
/// of its own, so that microseconds are not taken for nanoseconds: make it with `mufasa_time_from_...`. A bare
/// number assigned, given as an argument or in an initialiser (`{50}`) does not compile.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MufasaTime {
    /// Nanoseconds after the clock's start.
    pub ns: i64,
}

/// A distance between two vehicles, from bumper to bumper: make it with `mufasa_gap_between_bumpers`. A bare
/// number assigned or given as an argument is an error; in an initialiser without inner braces it is none, unless you
/// compile with `-Werror=missing-braces`.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MufasaGap {
    /// m, from the front edge of the CAV's rectangle to the nearest point of the leading vehicle, along
    /// the reference path.
    pub between_bumpers: f64,
}

impl MufasaTime {
    /// When the clock started.
    pub(crate) const EPOCH: Self = Self { ns: 0 };

    /// That of `mufasa`.
    pub(crate) const fn time(self) -> Time {
        Time::from_nanoseconds(self.ns)
    }

    /// One beyond 64 bits of nanoseconds is the earliest time: nothing stamped so is current.
    fn or_earliest<E>(made: Result<Time, E>) -> Self {
        made.map_or(Self { ns: i64::MIN }, |time| Self { ns: time.as_nanoseconds() })
    }
}

/// So many nanoseconds after the clock's start.
#[must_use]
#[unsafe(no_mangle)]
pub const extern "C" fn mufasa_time_from_nanoseconds(nanoseconds: i64) -> MufasaTime {
    MufasaTime { ns: nanoseconds }
}

/// So many microseconds after the clock's start; beyond 2^63 ns (292 years) the earliest time, of which
/// nothing is current.
#[must_use]
#[unsafe(no_mangle)]
pub extern "C" fn mufasa_time_from_microseconds(microseconds: i64) -> MufasaTime {
    MufasaTime::or_earliest(Time::from_microseconds(microseconds))
}

/// As `mufasa_time_from_microseconds`, of milliseconds.
#[must_use]
#[unsafe(no_mangle)]
pub extern "C" fn mufasa_time_from_milliseconds(milliseconds: i64) -> MufasaTime {
    MufasaTime::or_earliest(Time::from_milliseconds(milliseconds))
}

/// Writes the time so many seconds after the clock's start, to about the nearest nanosecond (doubles are coarser
/// than that from 104 days on). UNKNOWN_VALUE: no number, or beyond 2^63 ns; then the earliest time is written.
///
/// # Safety
/// `time` is null or can be written to.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mufasa_time_from_seconds(
    seconds: f64,
    time: *mut MufasaTime,
) -> MufasaStatus {
    let made = Time::from_seconds(seconds);
    let status = if made.is_ok() { MufasaStatus::Ok } else { MufasaStatus::UnknownValue };
    // SAFETY: the caller's duty.
    unsafe { put(time, MufasaTime::or_earliest(made)) }.map_or_else(|fault| fault, |()| status)
}

/// So many metres from bumper to bumper.
#[must_use]
#[unsafe(no_mangle)]
pub const extern "C" fn mufasa_gap_between_bumpers(metres: f64) -> MufasaGap {
    MufasaGap { between_bumpers: metres }
}
