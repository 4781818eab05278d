//! Who is who in messages.

/// The CAV.
pub const CAV: i64 = 1;

/// The station.
pub const STATION: i64 = 10;
