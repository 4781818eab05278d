//! Messages as values of `asn1/mufasa-link.asn`, and back (`spec/6-link.md#our-module`).

use mufasa::services::configuration::{Group, Groups};

use super::asn1::{self, Measured, OfSession, Session, Time, VERSION};
use super::clock::{delta_time, measured, pose_time, read_measured, read_pose_time};
use super::cpm::{self, Origin};
use super::error::{DecodeError, EncodeError, Place};
use super::frame::Frame;
use super::quantity::Quantity;
use super::vehicle::Vehicle;
use super::{Message, Payload, cam, objects, trajectory};

const PART: &str = "message";
const SENDER: Quantity = Quantity::new(PART, "sender", 1.0, [1, u32::MAX as i64]);
const RECEIVER: Quantity = Quantity::new(PART, "receiver", 1.0, [0, u32::MAX as i64]);
const SESSION: Quantity = Quantity::new(PART, "session", 1.0, [0, i64::MAX]);

/// What is sent.
pub(super) fn write(message: &Message, frame: &Frame) -> Result<asn1::Message, EncodeError> {
    let &Message { sender, receiver, generated_ns, ref payload } = message;
    let sender = SENDER.count(sender)?;
    let origin = Origin { sender, time: delta_time(generated_ns) };
    Ok(asn1::Message {
        version: VERSION,
        sender,
        receiver: RECEIVER.count(receiver)?,
        generated: Time(generated_ns),
        payload: write_payload(payload, origin, generated_ns, frame)?,
    })
}

fn write_payload(
    payload: &Payload,
    origin: Origin,
    generated_ns: i64,
    frame: &Frame,
) -> Result<asn1::Payload, EncodeError> {
    Ok(match *payload {
        Payload::Offer { groups: Groups { mot, plan } } => {
            asn1::Payload::Offer(asn1::Groups { mot, plan })
        }
        Payload::Withdraw => asn1::Payload::Withdraw(()),
        Payload::Confirm { group, session } => asn1::Payload::Confirm(of_session(group, session)?),
        Payload::Reject { group, session } => asn1::Payload::Reject(of_session(group, session)?),
        Payload::Request { group, session } => asn1::Payload::Request(of_session(group, session)?),
        Payload::Release { group, session } => asn1::Payload::Release(of_session(group, session)?),
        Payload::Alive { group, session } => asn1::Payload::Alive(of_session(group, session)?),
        Payload::Tracks { session, stamp_ns, ref tracks } => {
            let session = Session(SESSION.count(session)?);
            let stamp = Measured(measured(generated_ns, stamp_ns)?);
            let objects = objects::write_tracks(tracks, stamp, &cpm::station_axes(frame))?;
            let cpm = cpm::of_station(origin, frame, objects)?;
            asn1::Payload::Tracks(asn1::Tracks { session, stamp, cpm })
        }
        Payload::Trajectory { session, stamp_ns, ref points } => {
            let session = Session(SESSION.count(session)?);
            asn1::Payload::Trajectory(trajectory::write(session, stamp_ns, points, frame)?)
        }
        Payload::State { stamp_ns, ref ego } => {
            let time = pose_time(generated_ns, stamp_ns)?;
            let (vehicle, _) = Vehicle::of(ego, frame)?;
            asn1::Payload::State(cam::write(origin.sender, time, vehicle)?)
        }
        Payload::Detections { stamp_ns, ref ego, ref detections } => {
            let stamp = Measured(measured(generated_ns, stamp_ns)?);
            let (vehicle, axes) = Vehicle::of(ego, frame)?;
            let centre_offset = vehicle.centre_offset;
            let objects = objects::write_detections(detections, stamp, &axes)?;
            let cpm = cpm::of_vehicle(origin, vehicle, objects)?;
            asn1::Payload::Detections(asn1::Detections { stamp, centre_offset, cpm })
        }
    })
}

fn of_session(group: Group, session: i64) -> Result<OfSession, EncodeError> {
    Ok(OfSession { group: group.into(), session: Session(SESSION.count(session)?) })
}

/// What was received.
pub(super) fn read(message: asn1::Message, frame: &Frame) -> Result<Message, DecodeError> {
    let asn1::Message { version, sender, receiver, generated: Time(generated_ns), payload } =
        message;
    if version != VERSION {
        return Err(DecodeError::Version { version });
    }
    if sender == 0 {
        return Err(DecodeError::OutOfRange(Place::of(PART, "sender")));
    }
    let origin = Origin { sender, time: delta_time(generated_ns) };
    let payload = read_payload(payload, origin, generated_ns, frame)?;
    Ok(Message { sender: sender.into(), receiver: receiver.into(), generated_ns, payload })
}

fn read_payload(
    payload: asn1::Payload,
    origin: Origin,
    generated_ns: i64,
    frame: &Frame,
) -> Result<Payload, DecodeError> {
    Ok(match payload {
        asn1::Payload::Offer(asn1::Groups { mot, plan }) => {
            Payload::Offer { groups: Groups { mot, plan } }
        }
        asn1::Payload::Withdraw(()) => Payload::Withdraw,
        asn1::Payload::Confirm(OfSession { group, session: Session(session) }) => {
            Payload::Confirm { group: group.into(), session }
        }
        asn1::Payload::Reject(OfSession { group, session: Session(session) }) => {
            Payload::Reject { group: group.into(), session }
        }
        asn1::Payload::Request(OfSession { group, session: Session(session) }) => {
            Payload::Request { group: group.into(), session }
        }
        asn1::Payload::Release(OfSession { group, session: Session(session) }) => {
            Payload::Release { group: group.into(), session }
        }
        asn1::Payload::Alive(OfSession { group, session: Session(session) }) => {
            Payload::Alive { group: group.into(), session }
        }
        asn1::Payload::Tracks(asn1::Tracks { session: Session(session), stamp, cpm }) => {
            let objects = cpm::read_of_station(origin, frame, &cpm)?;
            let tracks = objects::read_tracks(&objects, stamp, &cpm::station_axes(frame))?;
            let stamp_ns = read_measured(generated_ns, stamp.0)?;
            Payload::Tracks { session, stamp_ns, tracks }
        }
        asn1::Payload::Trajectory(sent) => {
            let points = trajectory::read(&sent, frame)?;
            let asn1::Trajectory { session: Session(session), stamp: Time(stamp_ns), .. } = sent;
            Payload::Trajectory { session, stamp_ns, points }
        }
        asn1::Payload::State(state) => {
            let (time, vehicle) = cam::read(origin.sender, &state)?;
            let (ego, _) = vehicle.read(frame)?;
            Payload::State { stamp_ns: read_pose_time(generated_ns, time)?, ego }
        }
        asn1::Payload::Detections(asn1::Detections { stamp, centre_offset, cpm }) => {
            let (vehicle, objects) = cpm::read_of_vehicle(origin, centre_offset, &cpm)?;
            let (ego, axes) = vehicle.read(frame)?;
            let detections = objects::read_detections(&objects, stamp, &axes)?;
            Payload::Detections { stamp_ns: read_measured(generated_ns, stamp.0)?, ego, detections }
        }
    })
}

impl From<Group> for asn1::Group {
    fn from(group: Group) -> Self {
        match group {
            Group::Mot => Self::Mot,
            Group::Plan => Self::Plan,
        }
    }
}

impl From<asn1::Group> for Group {
    fn from(group: asn1::Group) -> Self {
        match group {
            asn1::Group::Mot => Self::Mot,
            asn1::Group::Plan => Self::Plan,
        }
    }
}

#[cfg(test)]
mod tests;
