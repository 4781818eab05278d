//! The vehicle in the data elements that CAM and CPM share (`spec/6-link.md#cam`).

use c_its_parser::standards::cdd_1_3_1_1::its_container::{
    Altitude, AltitudeConfidence, AltitudeValue, Heading, HeadingConfidence, HeadingValue,
    Latitude, Longitude, PosConfidenceEllipse, ReferencePosition, SemiAxisLength, Speed,
    SpeedConfidence, SpeedValue, VehicleLength, VehicleLengthConfidenceIndication,
    VehicleLengthValue, VehicleWidth,
};
use mufasa::input::cycle::Ego;

use super::asn1::CentreOffset;
use super::error::{DecodeError, EncodeError};
use super::frame::Frame;
use super::quantity::{Quantity, angle, direction};

/// Counts of a heading and of a yaw angle in a turn.
pub(super) const PER_TURN: i32 = 3600;
/// The heading of a vehicle that looks along the map's x: headings count from north to east.
const EAST: i64 = 900;

const SPEED: Quantity = Quantity::new("ego", "speed", 100.0, [0, 16_382]);
const LENGTH: Quantity = Quantity::new("ego", "length", 10.0, [1, 1021]);
const WIDTH: Quantity = Quantity::new("ego", "width", 10.0, [1, 60]);
const CENTRE_OFFSET: Quantity = Quantity::new("ego", "center_offset", 100.0, [-10_000, 10_000]);
const HEADING: Quantity = Quantity::new("ego", "heading", 10.0, [0, 3600]);

/// A vehicle as it is sent: its reference position is the middle of its front.
#[derive(Clone, Debug)]
pub(super) struct Vehicle {
    pub(super) reference: ReferencePosition,
    pub(super) heading: Heading,
    pub(super) speed: Speed,
    pub(super) length: VehicleLength,
    pub(super) width: VehicleWidth,
    pub(super) centre_offset: CentreOffset,
}

/// Axes in which objects are given.
#[derive(Clone, Copy, Debug)]
pub(super) struct Axes {
    /// Where they start on the map, m.
    pub(super) origin: [f64; 2],
    /// Of the first axis, from the map's x towards its y, in counts of `PER_TURN`.
    pub(super) angle: i64,
}

impl Vehicle {
    /// The reference position is ahead of the vehicle's reference point by the length and along the
    /// heading that are sent, so that the receiver finds the reference point again. The axes are those
    /// that the receiver finds.
    pub(super) fn of(ego: &Ego, frame: &Frame) -> Result<(Self, Axes), EncodeError> {
        let length = VehicleLengthValue(LENGTH.not_below(ego.length)?);
        let centre_offset = CentreOffset(CENTRE_OFFSET.nearest(ego.center_offset)?);
        let angle = angle("ego", [ego.cos, ego.sin], PER_TURN)?;
        let [cos, sin] = direction(angle, PER_TURN);
        let ahead = CENTRE_OFFSET.value(centre_offset.0) + LENGTH.value(length.0) / 2.0;
        let front = [ego.x + ahead * cos, ego.y + ahead * sin];
        let position = frame.position("ego", front)?;
        let vehicle = Self {
            reference: reference_position(position),
            heading: Heading::new(
                HeadingValue(HEADING.count((EAST - angle).rem_euclid(PER_TURN.into()))?),
                HeadingConfidence(127),
            ),
            speed: Speed::new(SpeedValue(SPEED.nearest(ego.speed)?), SpeedConfidence(127)),
            length: VehicleLength::new(length, VehicleLengthConfidenceIndication::unavailable),
            width: VehicleWidth(WIDTH.not_below(ego.width)?),
            centre_offset,
        };
        Ok((vehicle, Axes { origin: frame.place(position), angle }))
    }

    /// The vehicle on the map, and its body-fixed axes: x forward, y to the left, from the middle of the
    /// front.
    pub(super) fn read(&self, frame: &Frame) -> Result<(Ego, Axes), DecodeError> {
        let heading = self.heading.heading_value.0;
        HEADING.read(heading)?;
        let angle = EAST - i64::from(heading);
        let [cos, sin] = direction(angle, PER_TURN);
        let length = LENGTH.read(self.length.vehicle_length_value.0)?;
        let center_offset = CENTRE_OFFSET.read(self.centre_offset.0)?;
        let origin = frame.place(read_position(&self.reference));
        let ahead = center_offset + length / 2.0;
        let ego = Ego {
            x: origin[0] - ahead * cos,
            y: origin[1] - ahead * sin,
            cos,
            sin,
            speed: SPEED.read(self.speed.speed_value.0)?,
            length,
            width: WIDTH.read(self.width.0)?,
            center_offset,
        };
        // What is sent again has to fit: a place that is too far away does not.
        frame.position("ego", origin).map_err(|error| DecodeError::OutOfRange(error.place))?;
        Ok((ego, Axes { origin, angle }))
    }
}

impl Axes {
    /// A place on the map along these axes, m.
    pub(super) fn along(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let [cos, sin] = direction(self.angle, PER_TURN);
        let [dx, dy] = [x - self.origin[0], y - self.origin[1]];
        [dx * cos + dy * sin, dy * cos - dx * sin]
    }

    /// The place on the map of what is given along these axes, m.
    pub(super) fn place(&self, [ahead, left]: [f64; 2]) -> [f64; 2] {
        let [cos, sin] = direction(self.angle, PER_TURN);
        let [x, y] = self.origin;
        [x + (ahead * cos - left * sin), y + (left * cos + ahead * sin)]
    }
}

/// A place of latitude and longitude alone, in 0.1 microdegree.
pub(super) fn reference_position([latitude, longitude]: [i32; 2]) -> ReferencePosition {
    let unknown = SemiAxisLength(4095);
    ReferencePosition {
        latitude: Latitude(latitude),
        longitude: Longitude(longitude),
        position_confidence_ellipse: PosConfidenceEllipse::new(
            unknown.clone(),
            unknown,
            HeadingValue(3601),
        ),
        altitude: Altitude::new(AltitudeValue(800_001), AltitudeConfidence::unavailable),
    }
}

/// Latitude and longitude in 0.1 microdegree; what is unavailable is beyond every frame's reach.
pub(super) fn read_position(position: &ReferencePosition) -> [i32; 2] {
    [position.latitude.0, position.longitude.0]
}
