//! The CPM of a station, with tracks, and of a vehicle, with detections (TR 103 562,
//! `spec/6-link.md#cpm`).

use c_its_parser::standards::cam_1_4_1::cam_pdu_descriptions::GenerationDeltaTime;
use c_its_parser::standards::cdd_1_3_1_1::its_container::DriveDirection;
use c_its_parser::standards::cpm_1::cpm_pdu_descriptions::{
    CPM, CollectivePerceptionMessage, CpmManagementContainer, CpmParameters,
    NumberOfPerceivedObjects, OriginatingVehicleContainer, PerceivedObject,
    PerceivedObjectContainer, StationDataContainer,
};

use super::asn1::{CentreOffset, Etsi};
use super::bytes;
use super::error::{DecodeError, EncodeError, Pdu, Place};
use super::frame::Frame;
use super::header::{self, PASSENGER_CAR, ROAD_SIDE_UNIT};
use super::objects::MOST;
use super::vehicle::{Axes, Vehicle, read_position, reference_position};

/// Who says it, and the generation delta time of its message.
#[derive(Clone, Copy, Debug)]
pub(super) struct Origin {
    pub(super) sender: u32,
    pub(super) time: u16,
}

type Objects = Vec<PerceivedObject>;

/// The axes of a station: those of the map, from the reference position.
pub(super) fn station_axes(frame: &Frame) -> Axes {
    Axes { origin: frame.point(), angle: 0 }
}

/// The CPM of a station, with objects along its axes.
pub(super) fn of_station(
    origin: Origin,
    frame: &Frame,
    objects: Objects,
) -> Result<Etsi, EncodeError> {
    let reference = reference_position(frame.reference());
    let management = CpmManagementContainer::new(ROAD_SIDE_UNIT, None, reference);
    write(origin, management, None, objects)
}

/// The objects of a station's CPM, along its axes.
pub(super) fn read_of_station(
    origin: Origin,
    frame: &Frame,
    cpm: &Etsi,
) -> Result<Objects, DecodeError> {
    let (management, data, objects) = read(origin, cpm)?;
    let is_vehicle = matches!(data, Some(StationDataContainer::originatingVehicleContainer(_)));
    // Objects of a vehicle are along other axes.
    if is_vehicle || management.station_type != ROAD_SIDE_UNIT {
        return Err(DecodeError::Unsupported(Place::of("managementContainer", "stationType")));
    }
    let [latitude, longitude] = read_position(&management.reference_position);
    if [latitude, longitude] != frame.reference() {
        return Err(DecodeError::OtherFrame { latitude, longitude });
    }
    Ok(objects)
}

/// The CPM of a vehicle, with objects along its body-fixed axes.
pub(super) fn of_vehicle(
    origin: Origin,
    vehicle: Vehicle,
    objects: Objects,
) -> Result<Etsi, EncodeError> {
    let Vehicle { reference, heading, speed, length, width, centre_offset: _ } = vehicle;
    let management = CpmManagementContainer::new(PASSENGER_CAR, None, reference);
    let data = OriginatingVehicleContainer::new(
        heading,
        speed,
        None,
        DriveDirection::forward,
        None,
        None,
        None,
        None,
        None,
        None,
        Some(length),
        Some(width),
        None,
        None,
    );
    let data = StationDataContainer::originatingVehicleContainer(data);
    write(origin, management, Some(data), objects)
}

/// The vehicle of a vehicle's CPM, and the objects along its body-fixed axes.
pub(super) fn read_of_vehicle(
    origin: Origin,
    centre_offset: CentreOffset,
    cpm: &Etsi,
) -> Result<(Vehicle, Objects), DecodeError> {
    let (management, data, objects) = read(origin, cpm)?;
    let place = |field| Place::of("stationDataContainer", field);
    let Some(StationDataContainer::originatingVehicleContainer(data)) = data else {
        return Err(DecodeError::Missing(place("originatingVehicleContainer")));
    };
    if data.drive_direction == DriveDirection::backward {
        return Err(DecodeError::Unsupported(place("driveDirection")));
    }
    // The body's direction is another one than that of its motion.
    if data.vehicle_orientation_angle.is_some() {
        return Err(DecodeError::Unsupported(place("vehicleOrientationAngle")));
    }
    let missing = |field| move || DecodeError::Missing(place(field));
    let vehicle = Vehicle {
        reference: management.reference_position,
        heading: data.heading,
        speed: data.speed,
        length: data.vehicle_length.ok_or_else(missing("vehicleLength"))?,
        width: data.vehicle_width.ok_or_else(missing("vehicleWidth"))?,
        centre_offset,
    };
    Ok((vehicle, objects))
}

fn write(
    Origin { sender, time }: Origin,
    management: CpmManagementContainer,
    data: Option<StationDataContainer>,
    objects: Objects,
) -> Result<Etsi, EncodeError> {
    let count = u8::try_from(objects.len()).map_err(|_| EncodeError::refused())?;
    let count = NumberOfPerceivedObjects(count);
    // An empty list is one that is not there.
    let objects = (!objects.is_empty()).then_some(PerceivedObjectContainer(objects));
    let parameters = CpmParameters::new(management, data, None, objects, None, count);
    let cpm = CPM {
        header: header::of(Pdu::Cpm, sender),
        cpm: CollectivePerceptionMessage::new(GenerationDeltaTime(time), parameters),
    };
    Ok(Etsi(bytes::encode(&cpm)?.into()))
}

type Parts = (CpmManagementContainer, Option<StationDataContainer>, Objects);

fn read(origin: Origin, Etsi(cpm): &Etsi) -> Result<Parts, DecodeError> {
    let CPM { header, cpm } = bytes::decode(Pdu::Cpm, cpm)?;
    header::check(Pdu::Cpm, origin.sender, &header)?;
    let GenerationDeltaTime(generation_delta_time) = cpm.generation_delta_time;
    if generation_delta_time != origin.time {
        return Err(DecodeError::Clock { generation_delta_time });
    }
    let parameters = cpm.cpm_parameters;
    if parameters.management_container.perceived_object_container_segment_info.is_some() {
        let place = Place::of("managementContainer", "perceivedObjectContainerSegmentInfo");
        return Err(DecodeError::Unsupported(place));
    }
    let objects = parameters.perceived_object_container.map_or_else(Vec::new, |list| list.0);
    let named = usize::from(parameters.number_of_perceived_objects.0);
    if named != objects.len() || named > MOST {
        return Err(DecodeError::Incomplete { named, given: objects.len() });
    }
    Ok((parameters.management_container, parameters.station_data_container, objects))
}
