//! Messages of others, right in form, that mean something else: each is told from ours.

use c_its_parser::standards::cam_1_4_1::cam_pdu_descriptions::{
    CAM, HighFrequencyContainer, RSUContainerHighFrequency,
};
use c_its_parser::standards::cdd_1_3_1_1::its_container::{
    DriveDirection, HeadingValue, Latitude, SpeedValue, StationID, StationType, VehicleLengthValue,
    VehicleWidth,
};
use c_its_parser::standards::cpm_1::cpm_pdu_descriptions::{
    AngleConfidence, CPM, CartesianAngleValue, NumberOfPerceivedObjects, ObjectDimensionValue,
    ObjectRefPoint, OriginatingVehicleContainer, PerceivedObject,
    PerceivedObjectContainerSegmentInfo, SegmentCount, SpeedValueExtended, StationDataContainer,
    TimeOfMeasurement, WGS84Angle, WGS84AngleValue,
};
use mufasa::input::cycle::{Detection, Ego, Track, TrajectoryPoint};

use crate::message::asn1::{self, Etsi, Time};
use crate::message::error::{DecodeError, Pdu};
use crate::message::{Frame, Message, Payload, bytes, decode, encode};

fn frame() -> Frame {
    Frame::new(484_223_000, 99_560_000, [1_000.0, -500.0]).unwrap()
}

fn message(payload: Payload) -> asn1::Message {
    let message = Message { sender: 7, receiver: 2, generated_ns: 5_000_000_000, payload };
    let written = encode(&message, &frame()).unwrap();
    bytes::decode(Pdu::Message, &written).unwrap()
}

fn ego() -> Ego {
    let (x, y) = (1_010.0, -490.0);
    Ego { x, y, cos: 1.0, sin: 0.0, speed: 9.0, length: 4.5, width: 1.8, center_offset: 1.4 }
}

fn tracks() -> asn1::Message {
    let (x, y, cos, sin, length, width) = (1_030.0, -500.0, 1.0, 0.0, 4.5, 1.8);
    let track = Track { id: 3, x, y, cos, sin, vx: 9.0, vy: 0.0, length, width };
    message(Payload::Tracks { session: 1, stamp_ns: 4_970_000_000, tracks: vec![track; 2] })
}

fn detections() -> asn1::Message {
    let detection =
        Detection { x: 1_030.0, y: -500.0, cos: 1.0, sin: 0.0, length: 4.5, width: 1.8 };
    let detections = vec![detection; 2];
    message(Payload::Detections { stamp_ns: 4_970_000_000, ego: ego(), detections })
}

/// What becomes of a message whose CAM or CPM is changed.
fn spoil<T: rasn::Decode + rasn::Encode>(
    pdu: Pdu,
    mut message: asn1::Message,
    change: impl FnOnce(&mut T),
) -> Result<Message, DecodeError> {
    let (asn1::Payload::Tracks(asn1::Tracks { cpm: Etsi(inner), .. })
    | asn1::Payload::State(asn1::State { cam: Etsi(inner), .. })
    | asn1::Payload::Detections(asn1::Detections { cpm: Etsi(inner), .. })) = &mut message.payload
    else {
        panic!("{message:?} has nothing inside")
    };
    let mut value = bytes::decode(pdu, inner).unwrap();
    change(&mut value);
    *inner = bytes::encode(&value).unwrap().into();
    decode(&bytes::encode(&message).unwrap(), &frame())
}

fn cam(change: impl FnOnce(&mut CAM)) -> String {
    let state = message(Payload::State { stamp_ns: 4_970_000_000, ego: ego() });
    spoil(Pdu::Cam, state, change).unwrap_err().to_string()
}

fn station(change: impl FnOnce(&mut CPM)) -> String {
    spoil(Pdu::Cpm, tracks(), change).unwrap_err().to_string()
}

fn vehicle(change: impl FnOnce(&mut CPM)) -> String {
    spoil(Pdu::Cpm, detections(), change).unwrap_err().to_string()
}

fn second(cpm: &mut CPM) -> &mut PerceivedObject {
    &mut cpm.cpm.cpm_parameters.perceived_object_container.as_mut().unwrap().0[1]
}

fn originating(cpm: &mut CPM) -> &mut OriginatingVehicleContainer {
    match cpm.cpm.cpm_parameters.station_data_container.as_mut().unwrap() {
        StationDataContainer::originatingVehicleContainer(data) => data,
        other => panic!("{other:?}"),
    }
}

#[test]
fn unchanged_they_are_read() {
    spoil::<CPM>(Pdu::Cpm, tracks(), |_| {}).unwrap();
    spoil::<CPM>(Pdu::Cpm, detections(), |_| {}).unwrap();
}

/// LINK-20
#[test]
fn envelopes() {
    let change = |change: fn(&mut asn1::Message)| {
        let mut message = message(Payload::Withdraw);
        change(&mut message);
        decode(&bytes::encode(&message).unwrap(), &frame()).unwrap_err().to_string()
    };
    assert_eq!(change(|it| it.version = 2), "version 2 of the link is not known");
    assert_eq!(change(|it| it.sender = 0), "message.sender is out of range");
    let mut early = tracks();
    early.generated = Time(i64::MIN);
    let error = spoil::<CPM>(Pdu::Cpm, early, |it| it.cpm.generation_delta_time.0 = 33_567);
    assert!(error.is_err(), "{error:?}");
}

/// LINK-20: a byte too many, after the message and after what is in it.
#[test]
fn trailing_bytes() {
    let mut written = bytes::encode(&tracks()).unwrap();
    written.push(0);
    let error = decode(&written, &frame()).unwrap_err();
    assert_eq!(error, DecodeError::Trailing { pdu: Pdu::Message, bytes: 1 });
    let mut message = tracks();
    let asn1::Payload::Tracks(asn1::Tracks { cpm: Etsi(inner), .. }) = &mut message.payload else {
        panic!("{message:?}")
    };
    *inner = [inner, &[0][..]].concat().into();
    let error = decode(&bytes::encode(&message).unwrap(), &frame()).unwrap_err();
    assert_eq!(error, DecodeError::Trailing { pdu: Pdu::Cpm, bytes: 1 });
}

/// LINK-03
#[test]
fn other_frames() {
    let point = TrajectoryPoint { t_ns: 5_000_000_000, x: 1_010.0, y: -490.0, cos: 1.0, sin: 0.0 };
    let payload =
        Payload::Trajectory { session: 1, stamp_ns: 5_000_000_000, points: vec![point; 2] };
    let written = bytes::encode(&message(payload)).unwrap();
    let other = Frame::new(484_223_000, 99_560_001, [1_000.0, -500.0]).unwrap();
    let wrong = DecodeError::OtherFrame { latitude: 484_223_000, longitude: 99_560_000 };
    assert_eq!(decode(&written, &other), Err(wrong.clone()));
    assert_eq!(decode(&bytes::encode(&tracks()).unwrap(), &other), Err(wrong));
}

/// LINK-08
#[test]
fn headers() {
    assert!(cam(|it| it.header.message_id = 1).starts_with("the header is not that of a CAM"));
    assert!(
        cam(|it| it.header.protocol_version = 1).starts_with("the header is not that of a CAM")
    );
    assert!(station(|it| it.header.message_id = 2).starts_with("the header is not that of a CPM"));
    let other = "the CPM is of station 8, which is not the sender";
    assert_eq!(station(|it| it.header.station_id = StationID(8)), other);
    let late = |it: &mut CPM| it.cpm.generation_delta_time.0 += 1;
    assert_eq!(station(late), "generation delta time 5001 is not that of the message");
}

/// LINK-09
#[test]
fn cams() {
    type Fast = c_its_parser::standards::cam_1_4_1::cam_pdu_descriptions::BasicVehicleContainerHighFrequency;
    let fast = |change: fn(&mut Fast)| {
        cam(|it| match &mut it.cam.cam_parameters.high_frequency_container {
            HighFrequencyContainer::basicVehicleContainerHighFrequency(fast) => change(fast),
            other => panic!("{other:?}"),
        })
    };
    let unsupported = "highFrequencyContainer.driveDirection has a meaning that is not supported";
    assert_eq!(fast(|it| it.drive_direction = DriveDirection::backward), unsupported);
    assert_eq!(fast(|it| it.speed.speed_value = SpeedValue(16_383)), "ego.speed is out of range");
    let heading = "ego.heading is out of range";
    assert_eq!(fast(|it| it.heading.heading_value = HeadingValue(3601)), heading);
    let length = "ego.length is out of range";
    assert_eq!(
        fast(|it| it.vehicle_length.vehicle_length_value = VehicleLengthValue(1023)),
        length
    );
    assert_eq!(fast(|it| it.vehicle_width = VehicleWidth(62)), "ego.width is out of range");
    let position = |it: &mut CAM| {
        let position = &mut it.cam.cam_parameters.basic_container.reference_position;
        position.latitude = Latitude(900_000_001);
    };
    assert_eq!(cam(position), "ego.y is out of range");
    let road_side = |it: &mut CAM| {
        it.cam.cam_parameters.high_frequency_container =
            HighFrequencyContainer::rsuContainerHighFrequency(RSUContainerHighFrequency::new(None));
    };
    let missing = "highFrequencyContainer.basicVehicleContainerHighFrequency is missing";
    assert_eq!(cam(road_side), missing);
}

/// LINK-10 LINK-12
#[test]
fn cpms_of_stations() {
    let car = |it: &mut CPM| {
        it.cpm.cpm_parameters.management_container.station_type = StationType(5);
    };
    let axes = "managementContainer.stationType has a meaning that is not supported";
    assert_eq!(station(car), axes);
    let body = |it: &mut CPM| {
        let mut other = None;
        let keep = |cpm: &mut CPM| {
            other.clone_from(&cpm.cpm.cpm_parameters.station_data_container);
        };
        spoil(Pdu::Cpm, detections(), keep).unwrap();
        it.cpm.cpm_parameters.station_data_container = other;
    };
    assert_eq!(station(body), axes);
    let fewer = |it: &mut CPM| {
        it.cpm.cpm_parameters.number_of_perceived_objects = NumberOfPerceivedObjects(3);
    };
    assert_eq!(station(fewer), "the list has 2 objects where it names 3");
    let segments = |it: &mut CPM| {
        it.cpm.cpm_parameters.management_container.perceived_object_container_segment_info =
            Some(PerceivedObjectContainerSegmentInfo::new(SegmentCount(2), SegmentCount(1)));
    };
    assert!(
        station(segments).starts_with("managementContainer.perceivedObjectContainerSegmentInfo")
    );
}

/// LINK-11
#[test]
fn cpms_of_vehicles() {
    let none = |it: &mut CPM| it.cpm.cpm_parameters.station_data_container = None;
    let missing = "stationDataContainer.originatingVehicleContainer is missing";
    assert_eq!(vehicle(none), missing);
    let backward = |it: &mut CPM| originating(it).drive_direction = DriveDirection::backward;
    assert!(vehicle(backward).starts_with("stationDataContainer.driveDirection has"));
    let drifting = |it: &mut CPM| {
        let angle = WGS84Angle::new(WGS84AngleValue(10), AngleConfidence(127));
        originating(it).vehicle_orientation_angle = Some(angle);
    };
    assert!(vehicle(drifting).starts_with("stationDataContainer.vehicleOrientationAngle has"));
    let length = |it: &mut CPM| originating(it).vehicle_length = None;
    assert_eq!(vehicle(length), "stationDataContainer.vehicleLength is missing");
}

/// LINK-13 LINK-14
#[test]
fn objects() {
    let corner = |it: &mut CPM| second(it).object_ref_point = ObjectRefPoint(1);
    let reference = "tracks[1].objectRefPoint has a meaning that is not supported";
    assert_eq!(station(corner), reference);
    let early = |it: &mut CPM| second(it).time_of_measurement = TimeOfMeasurement(-31);
    let time = "tracks[1].timeOfMeasurement has a meaning that is not supported";
    assert_eq!(station(early), time);
    assert_eq!(station(|it| second(it).yaw_angle = None), "tracks[1].yawAngle is missing");
    let unknown = |it: &mut CPM| {
        second(it).yaw_angle.as_mut().unwrap().value = CartesianAngleValue(3601);
    };
    assert_eq!(station(unknown), "tracks[1].yaw angle is out of range");
    let length = |it: &mut CPM| second(it).planar_object_dimension1 = None;
    assert_eq!(station(length), "tracks[1].planarObjectDimension1 is missing");
    let width = |it: &mut CPM| second(it).planar_object_dimension2 = None;
    assert_eq!(vehicle(width), "detections[1].planarObjectDimension2 is missing");
    let flat = |it: &mut CPM| {
        second(it).planar_object_dimension2.as_mut().unwrap().value = ObjectDimensionValue(0);
    };
    assert_eq!(vehicle(flat), "detections[1].width is out of range");
    let still = |it: &mut CPM| second(it).x_speed.value = SpeedValueExtended(16_383);
    assert_eq!(station(still), "tracks[1].vx is out of range");
}
