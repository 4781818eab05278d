//! The header of every ETSI message (`spec/6-link.md#header`).

use c_its_parser::standards::cdd_1_3_1_1::its_container::{ItsPduHeader, StationID, StationType};

use super::error::{DecodeError, Pdu};

pub(super) const PASSENGER_CAR: StationType = StationType(5);
pub(super) const ROAD_SIDE_UNIT: StationType = StationType(15);

/// (version of the protocol, id of the message): of EN 302 637-2 and of TR 103 562.
fn ids(pdu: Pdu) -> (u8, u8) {
    match pdu {
        Pdu::Cpm => (1, 14),
        Pdu::Cam | Pdu::Message => (2, 2),
    }
}

/// The header of a CAM or CPM of this sender.
pub(super) fn of(pdu: Pdu, sender: u32) -> ItsPduHeader {
    let (protocol_version, message_id) = ids(pdu);
    ItsPduHeader { protocol_version, message_id, station_id: StationID(sender) }
}

/// Whether it is one.
pub(super) fn check(pdu: Pdu, sender: u32, header: &ItsPduHeader) -> Result<(), DecodeError> {
    let &ItsPduHeader { protocol_version, message_id, station_id: StationID(station_id) } = header;
    if (protocol_version, message_id) != ids(pdu) {
        return Err(DecodeError::Header { pdu, protocol_version, message_id });
    }
    if station_id != sender {
        return Err(DecodeError::Sender { pdu, station_id });
    }
    Ok(())
}
