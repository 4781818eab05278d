//! Attacks on a drive, and the time in which they take place.

use std::fmt;
use std::str::FromStr;

use mufasa_model::input::cycle::Cycle;
use thiserror::Error;

use super::catalogue::Attack;

impl Attack {
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
        self.is_driven() || matches!(self, Self::GhostTracks | Self::Late | Self::PastGhost)
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
        matches!(
            self,
            Self::EmptyTracks
                | Self::FalseVelocities
                | Self::FalseSizes
                | Self::MissingTrack
                | Self::CrossingStands
                | Self::ExchangedPasts
                | Self::TakenPast
                | Self::VelocityBias
                | Self::BlindDetectors
        )
    }
}

impl FromStr for Attack {
    type Err = ParseInjectionError;

    fn from_str(text: &str) -> Result<Self, ParseInjectionError> {
        let unknown = || ParseInjectionError::UnknownAttack(text.to_owned());
        Self::named(text, &Self::ON_DRIVES).ok_or_else(unknown)
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
#[derive(Clone, Debug, Error, PartialEq)]
pub enum ParseInjectionError {
    /// The name is none of [`Attack::ON_DRIVES`].
    #[error("`{}` is no attack; known are {}", .0, Attack::ON_DRIVES.map(Attack::name).join(", "))]
    UnknownAttack(String),
    /// The span is not of the form `FROM..TO`.
    #[error("`{0}` is not of the form FROM..TO, in seconds")]
    Form(String),
    /// A bound is no time, 0 s or later.
    #[error("`{0}` is no time in seconds")]
    Time(String),
    /// The span does not begin before it ends.
    #[error("the span {from_s}..{to_s} is empty: FROM must be less than TO")]
    EmptySpan {
        /// Its begin, s.
        from_s: f64,
        /// Its end, s.
        to_s: f64,
    },
}
