//! Attacks by name, and the time in which they take place.

use std::fmt;
use std::str::FromStr;

use mufasa_model::input::cycle::Cycle;

/// What an attacker does to the received data.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Attack {
    /// The planner is given another map: its trajectory leads off to the left by the width of
    /// the corridor (the paper's first attack).
    WrongMap,
    /// Track lists are emptied, and the trajectory, planned without them wherever the planner is,
    /// goes on at speed (the paper's second attack).
    EmptyTracks,
    /// Three tracks of objects that are not there, ahead on the path and on both sides (the
    /// paper's third attack).
    GhostTracks,
    /// True positions, velocities 10 m/s too fast forwards, and a trajectory that believes them
    /// (F-13).
    FalseVelocities,
    /// True positions, sizes of a hand, and a trajectory that believes them (F-15).
    FalseSizes,
    /// The trajectory leads backwards along the path (F-10).
    Backwards,
    /// The trajectory of the first attacked cycle again and again, under fresh stamps (F-16).
    Frozen,
    /// Trajectory and tracks, as far as they are remote, arrive 300 ms late, with true stamps.
    Late,
    /// The points of the trajectory come three times too soon (F-22).
    TooFast,
    /// The object nearest to the CAV's path is left out of the tracks (F-31).
    MissingTrack,
    /// Objects that cross the reference path are said to stand (F-30).
    CrossingStands,
    /// The object nearest to the CAV's path and the one nearest to it are given velocities as if
    /// each had come from where the other was 0.5 s ago (F-30, F-38).
    ExchangedPasts,
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
    /// All attacks.
    pub const ALL: [Self; 17] = [
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

    /// The name on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Self::WrongMap => "wrong-map",
            Self::EmptyTracks => "empty-tracks",
            Self::GhostTracks => "ghost-tracks",
            Self::FalseVelocities => "false-velocities",
            Self::FalseSizes => "false-sizes",
            Self::Backwards => "backwards",
            Self::Frozen => "frozen",
            Self::Late => "late",
            Self::TooFast => "too-fast",
            Self::MissingTrack => "missing-track",
            Self::CrossingStands => "crossing-stands",
            Self::ExchangedPasts => "exchanged-pasts",
            Self::TakenPast => "taken-past",
            Self::VelocityBias => "velocity-bias",
            Self::PastGhost => "past-ghost",
            Self::BlindDetectors => "blind-detectors",
            Self::Slide => "slide",
        }
    }

    /// What it changes, in words.
    pub fn data(self) -> &'static str {
        match (self.is_on_tracks(), self.is_on_trajectory()) {
            (true, true) => "tracks and trajectories",
            (true, false) => "tracks",
            (false, _) => "trajectories",
        }
    }

    /// Whether it changes received tracks.
    fn is_on_tracks(self) -> bool {
        match self {
            Self::EmptyTracks
            | Self::GhostTracks
            | Self::FalseVelocities
            | Self::FalseSizes
            | Self::Late
            | Self::MissingTrack
            | Self::CrossingStands
            | Self::ExchangedPasts
            | Self::TakenPast
            | Self::VelocityBias
            | Self::PastGhost
            | Self::BlindDetectors => true,
            Self::WrongMap | Self::Backwards | Self::Frozen | Self::TooFast | Self::Slide => false,
        }
    }

    /// Whether it changes received trajectories, other than by way of the tracks.
    fn is_on_trajectory(self) -> bool {
        !self.is_on_tracks() || self == Self::Late
    }

    /// Whether its data are remote in the cycle.
    pub(super) fn is_remote(self, cycle: &Cycle) -> bool {
        let remote = cycle.configuration.remote();
        (self.is_on_tracks() && remote.mot) || (self.is_on_trajectory() && remote.plan)
    }

    /// Whether the cycle has remote data for it to change.
    pub(super) fn reaches(self, cycle: &Cycle) -> bool {
        let remote = cycle.configuration.remote();
        (self.is_on_tracks() && remote.mot && cycle.tracks.is_some())
            || (self.is_on_trajectory() && remote.plan && cycle.trajectory.is_some())
    }

    /// Whether the CAV is shown driving what the attack makes of the trajectory.
    pub(super) fn is_driven(self) -> bool {
        match self {
            Self::EmptyTracks
            | Self::FalseVelocities
            | Self::FalseSizes
            | Self::MissingTrack
            | Self::CrossingStands
            | Self::ExchangedPasts
            | Self::TakenPast
            | Self::VelocityBias
            | Self::BlindDetectors => true,
            Self::WrongMap
            | Self::GhostTracks
            | Self::Backwards
            | Self::Frozen
            | Self::Late
            | Self::TooFast
            | Self::PastGhost
            | Self::Slide => false,
        }
    }
}

impl FromStr for Attack {
    type Err = ParseInjectionError;

    fn from_str(text: &str) -> Result<Self, ParseInjectionError> {
        let unknown = || ParseInjectionError::UnknownAttack(text.to_owned());
        Self::ALL.into_iter().find(|a| a.name() == text).ok_or_else(unknown)
    }
}

/// An attack and its time, in seconds since the first cycle of a drive, both ends included.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Injection {
    /// What is done.
    pub attack: Attack,
    /// First attacked time, s.
    pub from_s: f64,
    /// Last attacked time, s.
    pub to_s: f64,
}

/// `NAME@FROM..TO`, such as `wrong-map@2..3.5`, with FROM < TO; either bound may be left out.
impl FromStr for Injection {
    type Err = ParseInjectionError;

    fn from_str(text: &str) -> Result<Self, ParseInjectionError> {
        let (name, span) = text.split_once('@').unwrap_or((text, ".."));
        let attack = name.parse()?;
        let (from, to) =
            span.split_once("..").ok_or_else(|| ParseInjectionError::Form(span.to_owned()))?;
        let bound = |text: &str, open: f64| {
            if text.is_empty() {
                return Ok(open);
            }
            match text.parse::<f64>() {
                Ok(s) if s >= 0.0 => Ok(s),
                _ => Err(ParseInjectionError::Time(text.to_owned())),
            }
        };
        let (from_s, to_s) = (bound(from, 0.0)?, bound(to, f64::INFINITY)?);
        if from_s >= to_s {
            return Err(ParseInjectionError::EmptySpan { from_s, to_s });
        }
        Ok(Self { attack, from_s, to_s })
    }
}

impl fmt::Display for Injection {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}@{}..", self.attack.name(), self.from_s)?;
        if self.to_s.is_finite() { write!(f, "{}", self.to_s) } else { Ok(()) }
    }
}

/// Why a text is no injection.
#[derive(Clone, Debug, PartialEq)]
pub enum ParseInjectionError {
    /// The name is none of [`Attack::ALL`].
    UnknownAttack(String),
    /// The span is not of the form `FROM..TO`.
    Form(String),
    /// A bound is no time, 0 s or later.
    Time(String),
    /// The span does not begin before it ends.
    EmptySpan {
        /// Its begin, s.
        from_s: f64,
        /// Its end, s.
        to_s: f64,
    },
}

impl fmt::Display for ParseInjectionError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::UnknownAttack(name) => {
                let names = Attack::ALL.map(Attack::name).join(", ");
                write!(f, "`{name}` is no attack; known are {names}")
            }
            Self::Form(span) => write!(f, "`{span}` is not of the form FROM..TO, in seconds"),
            Self::Time(bound) => write!(f, "`{bound}` is no time in seconds"),
            Self::EmptySpan { from_s, to_s } => {
                write!(f, "the span {from_s}..{to_s} is empty: FROM must be less than TO")
            }
        }
    }
}

impl std::error::Error for ParseInjectionError {}
