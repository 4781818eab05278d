//! What decides about the order of the stages (`spec/3-stages.md#schedule`).

use crate::input::profile::Profile;
use crate::numbers::time::elapsed_ns;
use crate::services::configuration::Configuration;

/// What of a cycle decides about the order of its stages. Source: `spec/3-stages.md#schedule`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(clippy::struct_excessive_bools, reason = "five independent facts, each asked for by name")]
pub struct Given {
    /// Profile in force.
    pub profile: Profile,
    /// Which groups are remote.
    pub configuration: Configuration,
    /// There are tracks, whatever their age.
    pub tracks_of_any_age: bool,
    /// The tracks are current.
    pub tracks: bool,
    /// The trajectory is current.
    pub trajectory: bool,
    /// The detections are current.
    pub detections: bool,
    /// The grid is current.
    pub grid: bool,
}

/// Whether data with this stamp are current: 0 <= now - stamp <= `max_age`, all in ns, `max_age` at
/// most 60 s. Source: `spec/3-stages.md#schedule`.
pub fn is_current(stamp_ns: i64, now_ns: i64, max_age_ns: i64) -> bool {
    let age_ns = elapsed_ns(stamp_ns, now_ns);
    0 <= age_ns && age_ns <= max_age_ns
}
