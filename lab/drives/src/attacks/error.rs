//! Why an attack changes nothing.

use std::path::Path;

use mufasa_model::services::configuration::Configuration;
use thiserror::Error;

use crate::attacks::injection::Injection;
use crate::drive::Stream;
use crate::readers::error::ReadError;

/// Why an attack leaves a drive as it is.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum InjectError {
    /// No cycle is within its span.
    #[error("attack {injection} s changes no cycle: the drive ends at {end_s} s")]
    Outside {
        /// The attack and its span.
        injection: Injection,
        /// Time of the last cycle, s since the first.
        end_s: f64,
    },
    /// The data that it changes are local wherever it would.
    #[error(
        "attack {injection} s changes no cycle: it is on received {}, which are local in {configuration:?}",
        .injection.attack.data()
    )]
    Local {
        /// The attack and its span.
        injection: Injection,
        /// Configuration of the first cycle in the span.
        configuration: Configuration,
    },
    /// There is nothing that it could change: the data are absent, or are as it would make them.
    #[error(
        "attack {injection} s changes no cycle: the received {} are absent, or as it would make them",
        .injection.attack.data()
    )]
    Unchanged {
        /// The attack and its span.
        injection: Injection,
    },
    /// A cycle cannot be read again.
    #[error(transparent)]
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
