//! The one list of attacks, on recorded drives (`injection`) and in the closed loop of `lab/sim`.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use strum::IntoStaticStr;

/// What an attacker does. Where both have an attack, "drive" and "loop" say how it is made in each.
#[derive(
    Clone,
    Copy,
    Debug,
    PartialEq,
    Eq,
    PartialOrd,
    Ord,
    Hash,
    IntoStaticStr,
    Serialize,
    Deserialize,
    JsonSchema,
)]
#[strum(serialize_all = "kebab-case")]
#[serde(into = "&'static str", try_from = "String")]
#[schemars(with = "String", extend("enum" = Self::IN_THE_LOOP.map(Self::name)))]
pub enum Attack {
    /// The planner has another map (the paper's first attack). Drive: the trajectory leads off to the left by the width
    /// of the corridor. Loop: it follows another route.
    WrongMap,
    /// Track lists are emptied (the paper's second attack). Drive: and the trajectory, planned without them wherever the
    /// planner is, goes on at speed. Loop: at 100 Hz, to the CAV and to the station's planner.
    EmptyTracks,
    /// Objects that are not there, ahead of the CAV (the paper's third attack). Drive: three, ahead on the path and on
    /// both sides.
    GhostTracks,
    /// One object is left out of the tracks (F-31). Drive: that nearest to the CAV's path. Loop: that which is in its way
    /// first.
    MissingTrack,
    /// Objects that cross the path are said to stand (F-30, F-31).
    CrossingStands,
    /// A ghost that the mean over many tracks hides (F-01).
    GhostInMean,
    /// True positions and false velocities (F-13). Drive: 10 m/s too fast forwards, and a trajectory that believes them.
    /// Loop: turned around.
    FalseVelocities,
    /// Two objects exchange their pasts: each moves as the other (F-30, F-32, F-38). Drive: the one nearest to the CAV's
    /// path and the one nearest to it, as if each had come from where the other was 0.5 s ago. Loop: the fastest and the
    /// slowest.
    ExchangedPasts,
    /// Results of 3 s ago, with new stamps.
    Replay,
    /// All tracks drift aside slowly, by 0.1 m/s.
    Drift,
    /// The trajectory begins 1 s from now.
    StartsLate,
    /// The trajectory ends as soon as the rules let it: behind where the CAV can stop (F-44).
    EndsEarly,
    /// The trajectory runs backwards (F-10).
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
    HeldBack,
    /// True positions, sizes of a hand, and a trajectory that believes them (F-15).
    FalseSizes,
    /// The trajectory of the first attacked cycle again and again, under fresh stamps (F-16).
    Frozen,
    /// Trajectory and tracks, as far as they are remote, arrive 300 ms late, with true stamps.
    Late,
    /// The points of the trajectory come three times too soon (F-22).
    TooFast,
    /// The object nearest to the CAV's path is given a velocity as if it had come from where the one
    /// nearest to it was 0.5 s ago, and that one is left out (F-42).
    TakenPast,
    /// Objects that move are said to be 3 m/s faster, which their pasts allow (F-30).
    VelocityBias,
    /// An object more: it stands where the one nearest to the CAV's path of those that drive was
    /// 0.5 s ago (F-01, F-38).
    PastGhost,
    /// Track lists are emptied, and the CAV's own detectors see nothing any more: the one attack
    /// that needs a defect of the CAV (F-34).
    BlindDetectors,
    /// The trajectory slides to the left, half a width a point, headings as before (F-35).
    Slide,
}

impl Attack {
    /// Those that can be injected into a recorded drive.
    pub const ON_DRIVES: [Self; 17] = [
        Self::WrongMap,
        Self::EmptyTracks,
        Self::GhostTracks,
        Self::FalseVelocities,
        Self::FalseSizes,
        Self::Backwards,
        Self::Frozen,
        Self::Late,
        Self::TooFast,
        Self::MissingTrack,
        Self::CrossingStands,
        Self::ExchangedPasts,
        Self::TakenPast,
        Self::VelocityBias,
        Self::PastGhost,
        Self::BlindDetectors,
        Self::Slide,
    ];

    /// Those of the closed loop.
    pub const IN_THE_LOOP: [Self; 23] = [
        Self::WrongMap,
        Self::EmptyTracks,
        Self::GhostTracks,
        Self::MissingTrack,
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
        Self::HeldBack,
    ];

    /// Those of the paper.
    pub const PAPER: [Self; 3] = [Self::WrongMap, Self::EmptyTracks, Self::GhostTracks];

    /// Its name on the command line, in tables and in files.
    pub fn name(self) -> &'static str {
        self.into()
    }

    /// The one of these with this name.
    pub fn named(name: &str, of: &[Self]) -> Option<Self> {
        of.iter().find(|it| it.name() == name).copied()
    }
}

impl TryFrom<String> for Attack {
    type Error = String;

    fn try_from(name: String) -> Result<Self, String> {
        Self::named(&name, &Self::IN_THE_LOOP).ok_or_else(|| format!("`{name}` is no attack"))
    }
}
