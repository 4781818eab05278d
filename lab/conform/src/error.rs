//! Why a campaign cannot be run at all; what the program under test does wrong is no error.

use std::fmt;
use std::io;
use std::path::PathBuf;

use mufasa_drives::ReadError;

/// Bad usage of `mufasa conform`.
#[derive(Debug)]
pub enum ConformError {
    /// The program under test cannot be started.
    Start {
        /// The program.
        command: String,
        /// What the system says.
        error: io::Error,
    },
    /// A file or folder cannot be read or written.
    File {
        /// Its path.
        path: PathBuf,
        /// What is wrong and what would be right.
        message: String,
    },
    /// The files hold no cycles.
    NoCycles,
    /// The only thing that could be read is wrong.
    Read(Box<ReadError>),
    /// Summaries that are not shards of one campaign.
    Merge(String),
    /// A vector that cannot be read.
    Vectors(String),
    /// The report cannot be written.
    Output(io::Error),
}

impl ConformError {
    /// A file or folder that cannot be used.
    pub fn file(path: impl Into<PathBuf>, message: impl fmt::Display) -> Self {
        Self::File { path: path.into(), message: message.to_string() }
    }
}

impl fmt::Display for ConformError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Start { command, error } => {
                write!(f, "{command}: cannot be started: {error}")?;
                match error.kind() {
                    io::ErrorKind::NotFound => {
                        f.write_str("; write its path, and the command behind `--`")
                    }
                    io::ErrorKind::PermissionDenied => f.write_str("; is it executable?"),
                    _ => Ok(()),
                }
            }
            Self::File { path, message } => write!(f, "{}: {message}", path.display()),
            Self::NoCycles => f.write_str("the files given with --drives hold no cycles"),
            Self::Read(error) => write!(f, "{error}"),
            Self::Vectors(message) => write!(f, "the vectors are wrong: {message}"),
            Self::Merge(message) => f.write_str(message),
            Self::Output(error) => write!(f, "the report cannot be written: {error}"),
        }
    }
}

impl std::error::Error for ConformError {}

impl From<io::Error> for ConformError {
    fn from(error: io::Error) -> Self {
        Self::Output(error)
    }
}
