//! What a vehicle and a station say to each other, and how it is written in bytes
//! (`spec/6-link.md`).

mod asn1;
mod bytes;
mod cam;
mod clock;
mod codec;
mod cpm;
mod error;
mod frame;
mod header;
mod objects;
mod quantity;
mod trajectory;
mod vehicle;

use mufasa::input::cycle::{Detection, Ego, Track, TrajectoryPoint};
use mufasa::services::configuration::{Group, Groups};

pub use self::error::{DecodeError, EncodeError, Pdu, Place, Problem};
pub use self::frame::Frame;

/// One message between a vehicle and a station. Source: `spec/6-link.md#messages`.
#[derive(Clone, Debug, PartialEq)]
pub struct Message {
    /// Who says it: a station's id, 1 to 4294967295.
    pub sender: i64,
    /// Whom it is for: a station's id, or 0 for all.
    pub receiver: i64,
    /// When it was made, on the shared clock, ns.
    pub generated_ns: i64,
    /// What it says.
    pub payload: Payload,
}

/// What a message says. Sessions are at least 0. Source: `spec/6-link.md#messages`.
#[derive(Clone, Debug, PartialEq)]
pub enum Payload {
    /// Station: these groups, and no others, are offered.
    Offer {
        /// What it offers from now on.
        groups: Groups,
    },
    /// Station: nothing is offered any more.
    Withdraw,
    /// Station: the session runs.
    Confirm {
        /// The group.
        group: Group,
        /// The session.
        session: i64,
    },
    /// Station: the session is refused.
    Reject {
        /// The group.
        group: Group,
        /// The session.
        session: i64,
    },
    /// Station: a result of MOT; an ETSI CPM inside.
    Tracks {
        /// The session that it belongs to.
        session: i64,
        /// Time that the positions are valid for, ns.
        stamp_ns: i64,
        /// At most 128; the ids are 0 to 255.
        tracks: Vec<Track>,
    },
    /// Station: a result of PLAN.
    Trajectory {
        /// The session that it belongs to.
        session: i64,
        /// When the trajectory was made, ns.
        stamp_ns: i64,
        /// Points in order of time, at most 1024.
        points: Vec<TrajectoryPoint>,
    },
    /// Vehicle: run this group in this session.
    Request {
        /// The group.
        group: Group,
        /// The session.
        session: i64,
    },
    /// Vehicle: the session has ended.
    Release {
        /// The group.
        group: Group,
        /// The session.
        session: i64,
    },
    /// Vehicle: the session goes on; this renews its lease.
    Alive {
        /// The group.
        group: Group,
        /// The session.
        session: i64,
    },
    /// Vehicle: where it is; an ETSI CAM inside.
    State {
        /// Time that the pose is valid for, ns.
        stamp_ns: i64,
        /// Pose, speed and size.
        ego: Ego,
    },
    /// Vehicle: what its detectors see; an ETSI CPM inside.
    Detections {
        /// Time of measurement, ns.
        stamp_ns: i64,
        /// Pose, speed and size of the vehicle that measured them.
        ego: Ego,
        /// At most 128.
        detections: Vec<Detection>,
    },
}

/// A message as bytes.
///
/// Errors: a value that the formats cannot hold; nothing is clipped. Source: `spec/6-link.md#limits`.
pub fn encode(message: &Message, frame: &Frame) -> Result<Vec<u8>, EncodeError> {
    bytes::encode(&codec::write(message, frame)?)
}

/// The message that these bytes are; whoever sent them, it does not panic and needs bounded memory.
///
/// Errors: bytes that are no message, or one that breaks a rule. Source: `spec/6-link.md#limits`.
pub fn decode(bytes: &[u8], frame: &Frame) -> Result<Message, DecodeError> {
    codec::read(bytes::decode(Pdu::Message, bytes)?, frame)
}
