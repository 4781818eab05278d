//! Whether a call could be carried out at all.

/// What a function says about the call itself, not about the data of a cycle. Most are faults of the
/// calling program. A station can cause `TableFull` and `InvalidStation`: then its message was ignored, and
/// nothing else has changed.
#[repr(u32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MufasaStatus {
    /// Done.
    Ok = 0,
    /// A pointer that must not be null is null.
    NullPointer = 1,
    /// A pointer is not aligned for what it points to.
    Misaligned = 2,
    /// A profile, configuration, group, set of groups or type of an event that does not exist; seconds that are
    /// no time.
    UnknownValue = 3,
    /// The memory is smaller than the function that tells its size says, a number of things that it is
    /// to hold is 0, or what was given is longer than that.
    MemoryTooSmall = 4,
    /// A parameter of the requester, or a number of sessions, is below 0, or the latter 2^63 - 1, after which
    /// there is no session.
    NegativeParameter = 5,
    /// An event names a station below 1.
    InvalidStation = 6,
    /// An offer of a station for which the table has no place.
    TableFull = 7,
    /// A parameter of the stages is outside its domain.
    InvalidParameter = 8,
    /// The nominal period is not above 0.
    InvalidPeriod = 9,
    /// dt_max is not above the nominal period, so that any jitter would end a session.
    DtMaxNotAbovePeriod = 10,
    /// A value of the route is outside its domain.
    InvalidRoute = 11,
    /// A time above 0 and below 1 ms, or t_wait above 0 and below 1 s: it is taken for one in another unit
    /// than nanoseconds.
    TimeTooShort = 12,
    /// max_age is below l_max, so that no cycle could use some of the results that are in time.
    MaxAgeBelowLMax = 13,
    /// tau is not above the nominal period, in the hardened profile: the way to stop would end before the next
    /// cycle, the first that can fail.
    TauNotAbovePeriod = 14,
    /// A cycle with lists as long as they may become could take longer than check_time.
    TooSlow = 15,
    /// A setting that no road vehicle has, and that is not named in `meant`.
    Unusual = 16,
}
