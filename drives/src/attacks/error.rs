//! What can be wrong with an injection.

use std::fmt;
use std::path::Path;

use mufasa_model::services::configuration::Configuration;

use crate::attacks::{Attack, Injection};
use crate::drive::Drive;
use crate::readers::error::ReadError;

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

/// Why an attack leaves a drive as it is.
#[derive(Clone, Debug, PartialEq)]
pub enum InjectError {
    /// No cycle is within its span.
    Outside {
        /// The attack and its span.
        injection: Injection,
        /// Time of the last cycle, s since the first.
        end_s: f64,
    },
    /// The data that it changes are local wherever it would.
    Local {
        /// The attack and its span.
        injection: Injection,
        /// Configuration of the first cycle in the span.
        configuration: Configuration,
    },
    /// There is nothing that it could change: the data are absent, or are as it would make them.
    Unchanged {
        /// The attack and its span.
        injection: Injection,
    },
}

impl InjectError {
    /// The same as an error of the files of that drive.
    #[must_use]
    pub fn of(&self, drive: &Drive) -> ReadError {
        ReadError::file(Path::new(&drive.source), self.to_string())
    }
}

impl fmt::Display for InjectError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Outside { injection, end_s } => {
                write!(f, "attack {injection} s changes no cycle: the drive ends at {end_s} s")
            }
            Self::Local { injection, configuration } => write!(
                f,
                "attack {injection} s changes no cycle: it is on received {}, which are local in \
                 {configuration:?}",
                injection.attack.data()
            ),
            Self::Unchanged { injection } => write!(
                f,
                "attack {injection} s changes no cycle: the received {} are absent, or as it \
                 would make them",
                injection.attack.data()
            ),
        }
    }
}

impl std::error::Error for InjectError {}
