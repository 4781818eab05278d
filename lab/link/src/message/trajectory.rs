//! The trajectory of a station (`spec/6-link.md#trajectory`).

use mufasa::input::cycle::TrajectoryPoint;

use super::asn1::{Point, Session, Time, Trajectory};
use super::clock::{point_time, read_point_time};
use super::error::{DecodeError, EncodeError, Place, Problem};
use super::frame::Frame;
use super::quantity::{Quantity, angle, direction};

const PART: &str = "points";
/// The most points of a trajectory.
const MOST: usize = 1024;
/// Counts of a direction in a turn.
const PER_TURN: i32 = 36_000;
const COUNTS: [i64; 2] = [-(1 << 27), (1 << 27) - 1];
const X: Quantity = Quantity::new(PART, "x", 1000.0, COUNTS);
const Y: Quantity = Quantity::new(PART, "y", 1000.0, COUNTS);
const DIRECTION: Quantity = Quantity::new(PART, "(cos, sin)", 100.0, [0, 35_999]);

/// A trajectory relative to its stamp and to the reference position.
pub(super) fn write(
    session: Session,
    stamp_ns: i64,
    points: &[TrajectoryPoint],
    frame: &Frame,
) -> Result<Trajectory, EncodeError> {
    if points.len() > MOST {
        let place = Place::of("trajectory", PART);
        return Err(EncodeError { place, problem: Problem::TooMany { most: MOST } });
    }
    let [latitude, longitude] = frame.reference();
    let point = |(index, point): (usize, &TrajectoryPoint)| {
        write_point(stamp_ns, point, frame).map_err(|error| error.at(PART, index))
    };
    let points = points.iter().enumerate().map(point).collect::<Result<_, _>>()?;
    Ok(Trajectory { session, stamp: Time(stamp_ns), latitude, longitude, points })
}

fn write_point(
    stamp_ns: i64,
    point: &TrajectoryPoint,
    frame: &Frame,
) -> Result<Point, EncodeError> {
    let [x, y] = frame.point();
    Ok(Point {
        time: point_time(stamp_ns, point.t_ns)?,
        x: X.nearest(point.x - x)?,
        y: Y.nearest(point.y - y)?,
        direction: DIRECTION.count(angle(PART, [point.cos, point.sin], PER_TURN)?)?,
    })
}

/// The points of a trajectory that was received.
pub(super) fn read(
    trajectory: &Trajectory,
    frame: &Frame,
) -> Result<Vec<TrajectoryPoint>, DecodeError> {
    let &Trajectory { latitude, longitude, stamp: Time(stamp_ns), .. } = trajectory;
    if [latitude, longitude] != frame.reference() {
        return Err(DecodeError::OtherFrame { latitude, longitude });
    }
    let point = |(index, point): (usize, &Point)| {
        read_point(stamp_ns, point, frame).map_err(|error| error.at(PART, index))
    };
    trajectory.points.iter().enumerate().map(point).collect()
}

fn read_point(stamp_ns: i64, point: &Point, frame: &Frame) -> Result<TrajectoryPoint, DecodeError> {
    let [x, y] = frame.point();
    let [cos, sin] = direction(point.direction.into(), PER_TURN);
    let t_ns = read_point_time(stamp_ns, point.time)?;
    Ok(TrajectoryPoint { t_ns, x: x + X.read(point.x)?, y: y + Y.read(point.y)?, cos, sin })
}
