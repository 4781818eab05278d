//! Why a message could not be written, or bytes could not be read (`spec/6-link.md#limits`).

use std::fmt;

use thiserror::Error;

/// Where a value stands: `tracks[3].x`. Source: `spec/6-link.md#limits`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Place {
    /// What it is part of: `message`, `ego`, `tracks`, `detections`, `trajectory`, `frame`; of a CAM or a
    /// CPM its container.
    pub part: &'static str,
    /// Of an item of a list, which one.
    pub index: Option<usize>,
    /// The field.
    pub field: &'static str,
}

impl Place {
    /// A field that is not one of a list's.
    pub(super) const fn of(part: &'static str, field: &'static str) -> Self {
        Self { part, index: None, field }
    }

    fn at(self, part: &'static str, index: usize) -> Self {
        Self { part, index: Some(index), field: self.field }
    }
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.index {
            Some(index) => write!(f, "{}[{index}].{}", self.part, self.field),
            None => write!(f, "{}.{}", self.part, self.field),
        }
    }
}

/// What is wrong with a value. Source: `spec/6-link.md#limits`.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
pub enum Problem {
    /// NaN or infinite.
    #[error(" is not finite; give a number")]
    NotFinite,
    /// Outside what the format holds, in the unit of the value.
    #[error(" does not fit; it can be {least} to {most}")]
    OutOfRange {
        /// The least value.
        least: f64,
        /// The greatest value.
        most: f64,
    },
    /// (cos, sin) of no angle.
    #[error(" is no direction; give cos and sin of an angle")]
    NoDirection,
    /// More items than the format holds.
    #[error(" has too many items; at most {most} fit, send the nearest")]
    TooMany {
        /// How many it holds.
        most: usize,
    },
    /// The encoder refuses what has passed all checks: a fault of this crate.
    #[error(": the encoder refuses this message")]
    Refused,
}

/// A value that cannot be written. Source: `spec/6-link.md#limits`.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
#[error("{place}{problem}")]
pub struct EncodeError {
    /// Which value.
    pub place: Place,
    /// What is wrong with it.
    pub problem: Problem,
}

impl EncodeError {
    pub(super) fn refused() -> Self {
        Self { place: Place::of("message", "bytes"), problem: Problem::Refused }
    }

    /// The same of an item of a list.
    pub(super) fn at(mut self, part: &'static str, index: usize) -> Self {
        self.place = self.place.at(part, index);
        self
    }
}

/// What bytes are, or hold. Source: `spec/6-link.md#our-module`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Pdu {
    /// A message of the link.
    Message,
    /// The CAM in it.
    Cam,
    /// The CPM in it.
    Cpm,
}

impl fmt::Display for Pdu {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Message => "message",
            Self::Cam => "CAM",
            Self::Cpm => "CPM",
        })
    }
}

/// Bytes that are no message: whoever made them follows another text, or means harm. Nothing of them is to
/// be used. Source: `spec/6-link.md#limits`.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
pub enum DecodeError {
    /// More bytes than any message has; they were not looked at.
    #[error("{bytes} bytes are more than any message has")]
    TooLong {
        /// How many there are.
        bytes: usize,
    },
    /// Not the encoding of any value.
    #[error("not the encoding of a {pdu}: {reason}")]
    Malformed {
        /// Of what.
        pdu: Pdu,
        /// What the decoder says.
        reason: String,
    },
    /// Bytes after its end.
    #[error("{bytes} bytes after the end of the {pdu}")]
    Trailing {
        /// After what.
        pdu: Pdu,
        /// How many.
        bytes: usize,
    },
    /// A version of the link that is not known here.
    #[error("version {version} of the link is not known")]
    Version {
        /// The version it names.
        version: u8,
    },
    /// The header of a CAM or CPM is of another kind of message.
    #[error(
        "the header is not that of a {pdu}: protocol version {protocol_version}, message id {message_id}"
    )]
    Header {
        /// Of what.
        pdu: Pdu,
        /// The version of the protocol that it names.
        protocol_version: u8,
        /// The kind of message that it names.
        message_id: u8,
    },
    /// A CAM or CPM of a station that is not the sender.
    #[error("the {pdu} is of station {station_id}, which is not the sender")]
    Sender {
        /// Of what.
        pdu: Pdu,
        /// Whom it names.
        station_id: u32,
    },
    /// The generation delta time of a CPM is not that of the message.
    #[error("generation delta time {generation_delta_time} is not that of the message")]
    Clock {
        /// What it says, ms modulo 65536.
        generation_delta_time: u16,
    },
    /// A reference position that is not that of the frame: the two sides have different maps.
    #[error(
        "the reference position ({latitude}, {longitude}) in 0.1 microdegree is not that of the frame; both sides need \
         the same one"
    )]
    OtherFrame {
        /// Its latitude, 0.1 microdegree.
        latitude: i32,
        /// Its longitude, 0.1 microdegree.
        longitude: i32,
    },
    /// An optional value that is needed is not there, or said to be unavailable.
    #[error("{0} is missing")]
    Missing(Place),
    /// A value that is none of this field.
    #[error("{0} is out of range")]
    OutOfRange(Place),
    /// A value that is allowed, but means what is not understood here.
    #[error("{0} has a meaning that is not supported")]
    Unsupported(Place),
    /// The list is not all there: of several segments, or with another number of objects than it says.
    #[error("the list has {given} objects where it names {named}")]
    Incomplete {
        /// How many objects it names.
        named: usize,
        /// How many it has.
        given: usize,
    },
}

impl DecodeError {
    /// The same of an item of a list.
    pub(super) fn at(self, part: &'static str, index: usize) -> Self {
        match self {
            Self::Missing(place) => Self::Missing(place.at(part, index)),
            Self::OutOfRange(place) => Self::OutOfRange(place.at(part, index)),
            Self::Unsupported(place) => Self::Unsupported(place.at(part, index)),
            other => other,
        }
    }
}
