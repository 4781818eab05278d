//! Rectangles as perceived objects of a CPM (`spec/6-link.md#objects`).

use c_its_parser::standards::cdd_1_3_1_1::its_container::SpeedConfidence;
use c_its_parser::standards::cpm_1::cpm_pdu_descriptions::{
    AngleConfidence, CartesianAngle, CartesianAngleValue, DistanceConfidence, DistanceValue,
    Identifier, ObjectConfidence, ObjectDimension, ObjectDimensionConfidence, ObjectDimensionValue,
    ObjectDistanceWithConfidence, ObjectRefPoint, PerceivedObject, SpeedExtended,
    SpeedValueExtended, TimeOfMeasurement,
};
use mufasa::input::cycle::{Detection, Track};

use super::asn1::Measured;
use super::error::{DecodeError, EncodeError, Place, Problem};
use super::quantity::{Quantity, angle, direction};
use super::vehicle::{Axes, PER_TURN};

const PART: &str = "objects";
const ID: Quantity = Quantity::new(PART, "id", 1.0, [0, 255]);
const X: Quantity = Quantity::new(PART, "x", 100.0, [-132_768, 132_767]);
const Y: Quantity = Quantity::new(PART, "y", 100.0, [-132_768, 132_767]);
const VX: Quantity = Quantity::new(PART, "vx", 100.0, [-16_382, 16_382]);
const VY: Quantity = Quantity::new(PART, "vy", 100.0, [-16_382, 16_382]);
const LENGTH: Quantity = Quantity::new(PART, "length", 10.0, [1, 1023]);
const WIDTH: Quantity = Quantity::new(PART, "width", 10.0, [1, 1023]);
const YAW: Quantity = Quantity::new(PART, "yaw angle", 10.0, [0, 3600]);

const SPEED_UNAVAILABLE: SpeedValueExtended = SpeedValueExtended(16_383);
/// The reference point of an object is the middle of its rectangle.
const MIDDLE: ObjectRefPoint = ObjectRefPoint(0);

/// The most objects of a CPM.
pub(super) const MOST: usize = 128;

/// Tracks along axes that are turned as those of the map.
pub(super) fn write_tracks(
    tracks: &[Track],
    measured: Measured,
    axes: &Axes,
) -> Result<Vec<PerceivedObject>, EncodeError> {
    write_all("tracks", tracks, |_, &Track { id, x, y, cos, sin, vx, vy, length, width }| {
        let velocity = [VX.nearest(vx)?, VY.nearest(vy)?].map(SpeedValueExtended);
        let rectangle = Detection { x, y, cos, sin, length, width };
        object(Identifier(ID.count(id)?), &rectangle, velocity, measured, axes)
    })
}

/// Detections: their ids are their places in the list, their velocities unavailable.
pub(super) fn write_detections(
    detections: &[Detection],
    measured: Measured,
    axes: &Axes,
) -> Result<Vec<PerceivedObject>, EncodeError> {
    write_all("detections", detections, |id, detection| {
        object(Identifier(id), detection, [SPEED_UNAVAILABLE; 2], measured, axes)
    })
}

fn write_all<T>(
    part: &'static str,
    items: &[T],
    write: impl Fn(u8, &T) -> Result<PerceivedObject, EncodeError>,
) -> Result<Vec<PerceivedObject>, EncodeError> {
    if items.len() > MOST {
        let place = Place::of("message", part);
        return Err(EncodeError { place, problem: Problem::TooMany { most: MOST } });
    }
    let numbered = (0_u8..).zip(items);
    numbered.map(|(id, item)| write(id, item).map_err(|it| it.at(part, id.into()))).collect()
}

fn object(
    id: Identifier,
    rectangle: &Detection,
    velocity: [SpeedValueExtended; 2],
    measured: Measured,
    axes: &Axes,
) -> Result<PerceivedObject, EncodeError> {
    let Detection { x, y, cos, sin, length, width } = *rectangle;
    let [ahead, left] = axes.along([x, y]);
    let distance = |value| ObjectDistanceWithConfidence::new(value, DistanceConfidence(102));
    let dimension =
        |value| ObjectDimension::new(ObjectDimensionValue(value), ObjectDimensionConfidence(102));
    let yaw = (angle(PART, [cos, sin], PER_TURN)? - axes.angle).rem_euclid(PER_TURN.into());
    let [x_speed, y_speed] = velocity.map(|value| SpeedExtended::new(value, SpeedConfidence(127)));
    Ok(PerceivedObject::new(
        id,
        None,
        TimeOfMeasurement(measured.0),
        None,
        ObjectConfidence(0),
        distance(DistanceValue(X.nearest(ahead)?)),
        distance(DistanceValue(Y.nearest(left)?)),
        None,
        x_speed,
        y_speed,
        None,
        None,
        None,
        None,
        Some(CartesianAngle::new(CartesianAngleValue(YAW.count(yaw)?), AngleConfidence(127))),
        Some(dimension(LENGTH.not_below(length)?)),
        Some(dimension(WIDTH.not_below(width)?)),
        None,
        MIDDLE,
        None,
        None,
        None,
    ))
}

/// Tracks that were received.
pub(super) fn read_tracks(
    objects: &[PerceivedObject],
    measured: Measured,
    axes: &Axes,
) -> Result<Vec<Track>, DecodeError> {
    read_all("tracks", objects, |object| {
        let rectangle = read_rectangle(object, measured, axes)?;
        let Detection { x, y, cos, sin, length, width } = rectangle;
        let (vx, vy) = (VX.read(object.x_speed.value.0)?, VY.read(object.y_speed.value.0)?);
        Ok(Track { id: object.object_id.0.into(), x, y, cos, sin, vx, vy, length, width })
    })
}

/// Detections that were received.
pub(super) fn read_detections(
    objects: &[PerceivedObject],
    measured: Measured,
    axes: &Axes,
) -> Result<Vec<Detection>, DecodeError> {
    read_all("detections", objects, |object| read_rectangle(object, measured, axes))
}

fn read_all<T>(
    part: &'static str,
    objects: &[PerceivedObject],
    read: impl Fn(&PerceivedObject) -> Result<T, DecodeError>,
) -> Result<Vec<T>, DecodeError> {
    let read = |(index, object)| read(object).map_err(|error| error.at(part, index));
    objects.iter().enumerate().map(read).collect()
}

fn read_rectangle(
    object: &PerceivedObject,
    measured: Measured,
    axes: &Axes,
) -> Result<Detection, DecodeError> {
    if object.object_ref_point != MIDDLE {
        return Err(DecodeError::Unsupported(Place::of(PART, "objectRefPoint")));
    }
    if object.time_of_measurement.0 != measured.0 {
        return Err(DecodeError::Unsupported(Place::of(PART, "timeOfMeasurement")));
    }
    let missing = |field| move || DecodeError::Missing(Place::of(PART, field));
    let yaw = object.yaw_angle.as_ref().ok_or_else(missing("yawAngle"))?.value.0;
    YAW.read(yaw)?;
    let length = object.planar_object_dimension1.as_ref();
    let length = length.ok_or_else(missing("planarObjectDimension1"))?;
    let width = object.planar_object_dimension2.as_ref();
    let width = width.ok_or_else(missing("planarObjectDimension2"))?;
    let [x, y] =
        axes.place([X.read(object.x_distance.value.0)?, Y.read(object.y_distance.value.0)?]);
    let [cos, sin] = direction(axes.angle + i64::from(yaw), PER_TURN);
    let (length, width) = (LENGTH.read(length.value.0)?, WIDTH.read(width.value.0)?);
    Ok(Detection { x, y, cos, sin, length, width })
}
