//! What decides about the order of the stages (`spec/3-stages.md#schedule`).

use crate::input::profile::Profile;
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
