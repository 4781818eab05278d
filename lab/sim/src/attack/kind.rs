//! Kinds of attacks.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// What an attack does.
#[derive(
    Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize, JsonSchema,
)]
#[serde(rename_all = "kebab-case")]
pub enum Kind {
    /// The planner of the station drives on another route (paper).
    MapReplaced,
    /// Empty track lists at 100 Hz, to the CAV and to the station's planner (paper).
    TracksEmpty,
    /// Objects that are not there, ahead of the CAV (paper).
    Ghosts,
    /// The object that is in the CAV's way first is left out.
    OneRemoved,
    /// Who crosses is said to stand (F-30, F-31).
    CrossingStands,
    /// A ghost that the mean over many tracks hides (F-01).
    GhostInMean,
    /// Velocities turned around.
    FalseVelocities,
    /// Two objects exchange their pasts: each moves as the other (F-32, F-38).
    ExchangedPasts,
    /// Results of 3 s ago, with new stamps.
    Replay,
    /// All tracks drift aside slowly, by 0.1 m/s.
    Drift,
    /// The trajectory begins 1 s from now.
    StartsLate,
    /// The trajectory ends as soon as the rules let it: behind where the CAV can stop (F-44).
    EndsEarly,
    /// The trajectory runs backwards.
    Backwards,
    /// The trajectory goes on at the present speed, whatever is ahead.
    IntoLead,
    /// The trajectory swings aside, within what the corridor allows its points (F-09).
    Swerve,
    /// A standing object 15 m ahead in every list.
    MadeUpLead,
    /// Results are made 30 ms later, and say so: the latency on the link stays what it was, what they are of is older.
    Delay,
    /// Numbers that are no numbers.
    NotFinite,
    /// A thousand messages each second that cannot be read, or are of no session.
    Flood,
    /// Lists as long as the formats allow.
    Slow,
    /// Results are stamped 1 s ahead of what they are of, so that no cycle can use them (F-43).
    StampsAhead,
    /// No results are sent.
    Silent,
    /// Results are made in time, and held back on the link for 100 ms, which is above `l_max`.
    Late,
}

impl Kind {
    /// All.
    pub const ALL: [Self; 23] = [
        Self::MapReplaced,
        Self::TracksEmpty,
        Self::Ghosts,
        Self::OneRemoved,
        Self::CrossingStands,
        Self::GhostInMean,
        Self::FalseVelocities,
        Self::ExchangedPasts,
        Self::Replay,
        Self::Drift,
        Self::StartsLate,
        Self::EndsEarly,
        Self::Backwards,
        Self::IntoLead,
        Self::Swerve,
        Self::MadeUpLead,
        Self::Delay,
        Self::NotFinite,
        Self::Flood,
        Self::Slow,
        Self::StampsAhead,
        Self::Silent,
        Self::Late,
    ];

    /// Those of the paper.
    pub const PAPER: [Self; 3] = [Self::MapReplaced, Self::TracksEmpty, Self::Ghosts];

    /// Its name in tables and files.
    pub fn name(self) -> &'static str {
        match self {
            Self::MapReplaced => "map-replaced",
            Self::TracksEmpty => "tracks-empty",
            Self::Ghosts => "ghosts",
            Self::OneRemoved => "one-removed",
            Self::CrossingStands => "crossing-stands",
            Self::GhostInMean => "ghost-in-mean",
            Self::FalseVelocities => "false-velocities",
            Self::ExchangedPasts => "exchanged-pasts",
            Self::Replay => "replay",
            Self::Drift => "drift",
            Self::StartsLate => "starts-late",
            Self::EndsEarly => "ends-early",
            Self::Backwards => "backwards",
            Self::IntoLead => "into-lead",
            Self::Swerve => "swerve",
            Self::MadeUpLead => "made-up-lead",
            Self::Delay => "delay",
            Self::NotFinite => "not-finite",
            Self::Flood => "flood",
            Self::Slow => "slow",
            Self::StampsAhead => "stamps-ahead",
            Self::Silent => "silent",
            Self::Late => "late",
        }
    }
}
