//! Why a message could not be written, or bytes could not be read (`spec/6-link.md#limits`).

use std::fmt;

/// What is wrong with a value. Source: `spec/6-link.md#limits`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Problem {
    /// Outside the range of its field, or no number.
    OutOfRange,
    /// More items than the format holds.
    TooMany,
}

/// A message that cannot be written. Source: `spec/6-link.md#limits`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct EncodeError {
    /// The dotted path of the value, without indices.
    pub field: &'static str,
    /// Of an item of a list, which one.
    pub index: Option<usize>,
    /// What is wrong.
    pub problem: Problem,
}

impl fmt::Display for EncodeError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} {:?}: {:?}", self.field, self.index, self.problem)
    }
}

impl std::error::Error for EncodeError {}

/// Bytes that are no message. Source: `spec/6-link.md#limits`.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum DecodeError {
    /// More bytes than any message has.
    TooLong {
        /// How many there are.
        bytes: usize,
    },
}

impl fmt::Display for DecodeError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::TooLong { bytes } => write!(f, "{bytes} bytes are more than any message has"),
        }
    }
}

impl std::error::Error for DecodeError {}
