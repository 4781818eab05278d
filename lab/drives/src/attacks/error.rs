//! Why an attack changes nothing.

use std::fmt;
use std::path::Path;

use mufasa_model::services::configuration::Configuration;

use crate::attacks::injection::Injection;
use crate::drive::Stream;
use crate::readers::error::ReadError;

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
    /// A cycle cannot be read again.
    Unread(Box<ReadError>),
}

impl From<ReadError> for InjectError {
    fn from(error: ReadError) -> Self {
        Self::Unread(Box::new(error))
    }
}

impl InjectError {
    /// The same as an error of the files of that drive.
    #[must_use]
    pub fn of(&self, drive: &Stream) -> ReadError {
        match self {
            Self::Unread(error) => ReadError::clone(error),
            Self::Outside { .. } | Self::Local { .. } | Self::Unchanged { .. } => {
                ReadError::file(Path::new(&drive.source), self.to_string())
            }
        }
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
            Self::Unread(error) => error.fmt(f),
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
