//! What is kept of a cycle once it is judged.

use mufasa_model::input::cycle::Profile;
use mufasa_model::services::configuration::Configuration;

use crate::drive::DriveCycle;

/// A cycle without what only its judgement needs.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Step {
    /// Its name.
    pub id: String,
    /// Its time, ns.
    pub now_ns: i64,
    /// Which groups are remote.
    pub configuration: Configuration,
    /// Its profile.
    pub profile: Profile,
    /// When its tracks were generated, ns.
    pub tracks_ns: Option<i64>,
    /// When its trajectory was generated, ns.
    pub trajectory_ns: Option<i64>,
}

impl From<DriveCycle> for Step {
    fn from(DriveCycle { id, cycle }: DriveCycle) -> Self {
        Self {
            id,
            now_ns: cycle.now_ns,
            configuration: cycle.configuration,
            profile: cycle.profile,
            tracks_ns: cycle.tracks.map(|list| list.stamp_ns),
            trajectory_ns: cycle.trajectory.map(|it| it.stamp_ns),
        }
    }
}
